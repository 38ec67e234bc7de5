// wire.js -- blocks of arrays as osdtex/studio/wire.h describes them.

const MAGIC = 0x4f544558;

async function block(path) {
  const answer = await fetch(path);
  if (!answer.ok) throw new Error(await answer.text());
  const buffer = await answer.arrayBuffer();
  const head = new Int32Array(buffer, 0, 16);
  if (head[0] !== MAGIC) throw new Error('what the program sent cannot be read');
  let at = 64;
  const next = (Type, count) => {
    const array = new Type(buffer, at, count);
    at += (array.byteLength + 3) & ~3;
    return array;
  };
  return [head, next];
}

export async function readSurface() {
  const [h, next] = await block('surface');
  const [, serial, verts, faces, corners, level] = h;
  return {
    serial, verts, faces, corners, level,
    origin: next(Float64Array, 3), points: next(Float32Array, verts * 3),
    normals: next(Float32Array, verts * 3), first: next(Int32Array, faces + 1),
    corner: next(Int32Array, corners), cage: next(Int32Array, faces),
  };
}

export async function readMapping() {
  const [h, next] = await block('mapping');
  const [, serial, surface, faces, corners, patches, exemplars, symmetry, verts] = h;
  return {
    serial, surface, faces, patches, exemplars, symmetry,
    uvs: next(Float32Array, corners * 2), patch: next(Int32Array, faces),
    stretch: next(Float32Array, faces), directions: next(Float32Array, faces * 3),
    scales: next(Float32Array, verts), which: next(Uint8Array, faces),
  };
}

export async function readSeams() {
  const [h, next] = await block('seams');
  const words = next(Int32Array, 2 * h[2]);
  return { serial: h[1], count: h[2], words, floats: new Float32Array(words.buffer, words.byteOffset, words.length) };
}

export async function readTexture(index) {
  const [h, next] = await block(`texture?index=${index}`);
  const [, width, height, wrapX, wrapY] = h;
  return { width, height, wrapX, wrapY, texels: next(Uint8Array, width * height * 4) };
}
