// view.js -- the model as three.js shows it.
import * as T from './three.js';
import { Picker } from './pick.js';

export const VIEWS = ['texture', 'patches', 'stretch', 'seams', 'field', 'scale'];

const VERTEX = `
attribute vec3 tint; attribute float octaves, which;
varying vec3 vNormal, vTint, vPoint; varying vec2 vUv; varying float vOctaves, vWhich;
void main() {
  vNormal = normalMatrix * normal; vTint = tint; vUv = uv;
  vOctaves = octaves; vWhich = which;
  vec4 p = modelViewMatrix * vec4(position, 1.);
  vPoint = p.xyz;
  gl_Position = projectionMatrix * p;
}`;

const FRAGMENT = `
uniform sampler2D maps[4]; uniform int show; uniform vec3 light; uniform float lit;
varying vec3 vNormal, vTint, vPoint; varying vec2 vUv; varying float vOctaves, vWhich;
vec3 texel() {
  // All are sampled, so that each has its derivatives.
  vec3 a = texture2D(maps[0], vUv).rgb, b = texture2D(maps[1], vUv).rgb;
  vec3 c = texture2D(maps[2], vUv).rgb, d = texture2D(maps[3], vUv).rgb;
  return vWhich < .5 ? a : vWhich < 1.5 ? b : vWhich < 2.5 ? c : d;
}
vec3 diverge(float x) {
  vec3 mid = vec3(.72), hot = vec3(.85, .16, .08), cold = vec3(.06, .22, .75);
  return mix(mid, x > 0. ? hot : cold, min(1., abs(x)));
}
void main() {
  vec3 n = normalize(vNormal) * (gl_FrontFacing ? 1. : -1.);
  vec3 color = texel();
  if (show == 1) color = vTint;
  if (show == 2) color = diverge(vOctaves * 2.);
  if (show == 3) color = mix(vec3(dot(color, vec3(.2126, .7152, .0722))), vec3(.5), .45);
  if (show == 4) color = mix(color, vec3(.35), .5);
  if (show == 5) color = diverge(vOctaves);
  float key = max(0., dot(n, normalize(light)));
  float fill = .5 + .5 * n.y, head = max(0., dot(n, normalize(-vPoint)));
  float shade = mix(1., .95 * key + .2 * fill + .18 * head, lit);
  gl_FragColor = vec4(color * shade, 1.);
  #include <colorspace_fragment>
}`;

// A colour that neighbours do not have, by a number.
function tintOf(patch, out, at) {
  if (patch < 0) { out.fill(70, at, at + 3); return; }
  const hue = (patch * 0.618034) % 1, value = 0.55 + 0.4 * ((patch * 0.7548777) % 1);
  for (let k = 0; k < 3; ++k) {
    const x = Math.abs(((hue + [0, 2 / 3, 1 / 3][k]) % 1) * 6 - 3) - 1;
    out[at + k] = 255 * value * (0.3 + 0.7 * Math.min(1, Math.max(0, x)));
  }
}

export class View {
  constructor(canvas, stage) {
    this.stage = stage;
    this.renderer = new T.WebGLRenderer({ canvas, antialias: true, preserveDrawingBuffer: true });
    this.renderer.setClearColor(0x1d1f21);
    this.scene = new T.Scene();
    this.camera = new T.PerspectiveCamera(32, 1, 0.01, 100);
    this.controls = new T.OrbitControls(this.camera, canvas);
    this.controls.addEventListener('change', () => this.draw());
    const grey = this.texture({ width: 1, height: 1, wrapX: 1, wrapY: 1, texels: new Uint8Array([128, 128, 128, 255]) });
    this.material = new T.ShaderMaterial({
      vertexShader: VERTEX, fragmentShader: FRAGMENT, side: T.DoubleSide,
      uniforms: {
        maps: { value: [grey, grey, grey, grey] }, show: { value: 0 },
        light: { value: new T.Vector3(0.5, 0.7, 0.6) }, lit: { value: 1 },
      },
    });
    this.marks = new T.Group();
    this.cursor = new T.Group();
    this.scene.add(this.marks, this.cursor);
    this.show = 'texture';
    this.lightTurn = 40;
    new ResizeObserver(() => this.resize()).observe(stage);
    this.resize();
  }

  resize() {
    const { clientWidth: w, clientHeight: h } = this.stage;
    if (!w || !h) return;
    this.renderer.setPixelRatio(Math.min(2, devicePixelRatio));
    this.renderer.setSize(w, h, false);
    this.camera.aspect = w / h;
    this.camera.updateProjectionMatrix();
    this.draw();
  }

  // Once for each frame, however often it is asked for.
  draw() {
    if (this.waits) return;
    this.waits = true;
    requestAnimationFrame(() => {
      this.waits = false;
      const turn = this.lightTurn * Math.PI / 180;
      this.material.uniforms.light.value.set(Math.sin(turn), 0.75, Math.cos(turn) * 0.9);
      this.renderer.render(this.scene, this.camera);
    });
  }

  texture({ width, height, wrapX, wrapY, texels }) {
    const t = new T.DataTexture(texels, width, height, T.RGBAFormat, T.UnsignedByteType);
    t.colorSpace = T.SRGBColorSpace;
    t.wrapS = wrapX ? T.RepeatWrapping : T.ClampToEdgeWrapping;
    t.wrapT = wrapY ? T.RepeatWrapping : T.ClampToEdgeWrapping;
    t.magFilter = T.LinearFilter;
    t.minFilter = T.LinearMipmapLinearFilter;
    t.generateMipmaps = true;
    t.anisotropy = 8;
    t.needsUpdate = true;
    return t;
  }

  setTextures(list) {
    const maps = this.material.uniforms.maps.value;
    new Set(maps).forEach(t => t.dispose());
    const made = list.map(t => this.texture(t));
    this.material.uniforms.maps.value = [0, 1, 2, 3].map(k => made[k] || made[0]);
  }

  // Corners are the vertices of the geometry: each has its own UV.
  setSurface(s) {
    const { corners, faces, first, corner, points, normals } = s;
    const isFirst = !this.surface;
    this.surface = s;
    this.picker = new Picker(s);
    const position = new Float32Array(corners * 3), normal = new Float32Array(corners * 3);
    for (let c = 0; c < corners; ++c)
      for (let k = 0; k < 3; ++k) {
        position[3 * c + k] = points[3 * corner[c] + k];
        normal[3 * c + k] = normals[3 * corner[c] + k];
      }
    const index = new Uint32Array(3 * (corners - 2 * faces));
    for (let f = 0, i = 0; f < faces; ++f)
      for (let c = first[f] + 1; c + 1 < first[f + 1]; ++c) {
        index[i++] = first[f]; index[i++] = c; index[i++] = c + 1;
      }
    const g = new T.BufferGeometry();
    g.setAttribute('position', new T.BufferAttribute(position, 3));
    g.setAttribute('normal', new T.BufferAttribute(normal, 3));
    g.setIndex(new T.BufferAttribute(index, 1));
    g.computeBoundingSphere();
    if (this.mesh) { this.scene.remove(this.mesh); this.mesh.geometry.dispose(); }
    this.mesh = new T.Mesh(g, this.material);
    this.scene.add(this.mesh);
    this.radius = g.boundingSphere.radius || 1;
    this.centre = g.boundingSphere.center;
    if (isFirst) this.home();
  }

  setMapping(m) {
    const { first, faces, corners } = this.surface, g = this.mesh.geometry;
    const tint = new Uint8Array(corners * 3), octaves = new Float32Array(corners), which = new Uint8Array(corners);
    for (let f = 0; f < faces; ++f)
      for (let c = first[f]; c < first[f + 1]; ++c) {
        tintOf(m.patch[f], tint, 3 * c);
        octaves[c] = m.stretch[f];
        which[c] = m.which[f];
      }
    this.mapping = m;
    this.dropSeams();
    this.octaves = octaves;
    g.setAttribute('uv', new T.BufferAttribute(m.uvs, 2));
    g.setAttribute('tint', new T.BufferAttribute(tint, 3, true));
    g.setAttribute('octaves', new T.BufferAttribute(octaves, 1));
    g.setAttribute('which', new T.BufferAttribute(which, 1));
    this.drawField();
    this.choose(this.show);
  }

  choose(show) {
    this.show = show;
    this.material.uniforms.show.value = VIEWS.indexOf(show);
    if (this.mesh?.geometry.attributes.octaves) {
      const values = this.mesh.geometry.attributes.octaves;
      const { scales } = this.mapping, { corner } = this.surface;
      if (show === 'scale' && scales.length)
        values.array = Float32Array.from(corner, v => Math.log2(scales[v] || 1));
      else values.array = this.octaves;
      values.needsUpdate = true;
    }
    if (this.field) this.field.visible = show === 'field';
    if (this.seams) this.seams.visible = show === 'seams';
    this.draw();
  }

  // Short lines along the directions, spread evenly over the faces.
  drawField() {
    const { first, corner, points, normals, faces } = this.surface, { directions, symmetry } = this.mapping;
    if (this.field) { this.scene.remove(this.field); this.field.geometry.dispose(); }
    const step = Math.max(1, Math.round(faces / 9000)), ends = [];
    const half = this.radius / 55;
    for (let f = 0; f < faces; f += step) {
      const d = directions.subarray(3 * f, 3 * f + 3);
      if (!(d[0] || d[1] || d[2])) continue;
      const mid = [0, 0, 0], n = [0, 0, 0], size = first[f + 1] - first[f];
      for (let c = first[f]; c < first[f + 1]; ++c)
        for (let k = 0; k < 3; ++k) {
          mid[k] += points[3 * corner[c] + k] / size;
          n[k] += normals[3 * corner[c] + k] / size;
        }
      const across = [n[1] * d[2] - n[2] * d[1], n[2] * d[0] - n[0] * d[2], n[0] * d[1] - n[1] * d[0]];
      for (const way of symmetry === 4 ? [d, across] : [d])
        for (const sign of [-1, 1])
          for (let k = 0; k < 3; ++k)
            ends.push(mid[k] + n[k] * half * 0.25 + sign * half * way[k] * (symmetry === 4 ? 0.6 : 1));
    }
    const g = new T.BufferGeometry();
    g.setAttribute('position', new T.BufferAttribute(new Float32Array(ends), 3));
    this.field = new T.LineSegments(g, new T.LineBasicMaterial({ color: 0xffd27a }));
    this.scene.add(this.field);
  }

  // The edges where patches meet, the redder the more they differ.
  setSeams({ serial, count, words, floats }) {
    this.dropSeams();
    if (serial !== this.mapping.serial) return;
    const { first, corner, points, normals, faces } = this.surface;
    const ends = new Float32Array(6 * count), colors = new Float32Array(6 * count);
    const lift = this.radius * 0.0015;
    let f = 0;
    for (let i = 0; i < count; ++i) {
      const c = words[2 * i], bad = Math.min(1, floats[2 * i + 1] * 5);
      while (f < faces && first[f + 1] <= c) ++f;
      const d = c + 1 < first[f + 1] ? c + 1 : first[f];
      [c, d].forEach((x, e) => {
        for (let k = 0; k < 3; ++k) {
          const at = 3 * corner[x] + k;
          ends[6 * i + 3 * e + k] = points[at] + lift * normals[at];
        }
        colors.set([0.25 + 0.75 * bad, 0.3 * (1 - bad) + 0.05, 0.35 * (1 - bad)], 6 * i + 3 * e);
      });
    }
    const g = new T.BufferGeometry();
    g.setAttribute('position', new T.BufferAttribute(ends, 3));
    g.setAttribute('color', new T.BufferAttribute(colors, 3));
    this.seams = new T.LineSegments(g, new T.LineBasicMaterial({ vertexColors: true }));
    this.seams.visible = this.show === 'seams';
    this.scene.add(this.seams);
    this.draw();
  }

  dropSeams() {
    if (!this.seams) return;
    this.scene.remove(this.seams);
    this.seams.geometry.dispose();
    this.seams = null;
  }

  // ---- the camera ----

  home() {
    const away = this.radius * 3.9;
    this.controls.target.copy(this.centre);
    this.camera.position.copy(this.centre).add(new T.Vector3(0.62, 0.42, 1).normalize().multiplyScalar(away));
    this.camera.near = this.radius / 100;
    this.camera.far = this.radius * 40;
    this.camera.updateProjectionMatrix();
    this.controls.minDistance = this.radius * 0.05;
    this.controls.maxDistance = this.radius * 20;
    this.controls.update();
    this.draw();
  }

  turn(aside, up) {
    const v = this.camera.position.clone().sub(this.controls.target), r = v.length();
    const a = Math.atan2(v.x, v.z) + aside;
    const b = Math.min(1.5, Math.max(-1.5, Math.asin(v.y / r) + up));
    v.set(Math.sin(a) * Math.cos(b), Math.sin(b), Math.cos(a) * Math.cos(b)).multiplyScalar(r);
    this.camera.position.copy(this.controls.target).add(v);
    this.controls.update();
    this.draw();
  }

  zoom(factor) {
    const v = this.camera.position.clone().sub(this.controls.target).multiplyScalar(factor);
    this.camera.position.copy(this.controls.target).add(v);
    this.controls.update();
    this.draw();
  }

  // Near to a place, along its normal.
  visit(point, normal, distance) {
    this.controls.target.set(...point);
    this.camera.position.set(...point.map((x, k) => x + normal[k] * distance));
    this.controls.update();
    this.draw();
  }

  // ---- places ----

  // What lies under a place of the stage, in pixels.
  hit(x, y) {
    if (!this.picker) return null;
    const { clientWidth: w, clientHeight: h } = this.stage;
    const far = new T.Vector3(2 * x / w - 1, 1 - 2 * y / h, 0.5).unproject(this.camera);
    const from = this.camera.position, way = far.sub(from).normalize();
    const hit = this.picker.along(from.toArray(), way.toArray());
    if (!hit) return null;
    if (hit.normal[0] * way.x + hit.normal[1] * way.y + hit.normal[2] * way.z > 0)
      hit.normal = hit.normal.map(n => -n);
    return hit;
  }

  // Where a point is seen, in pixels of the stage.
  seen(point) {
    const p = new T.Vector3(...point).project(this.camera);
    return [(p.x + 1) / 2 * this.stage.clientWidth, (1 - p.y) / 2 * this.stage.clientHeight];
  }

  // A circle on the tangent plane.
  ring(point, normal, radius, color, opacity) {
    const n = new T.Vector3(...normal).normalize();
    const a = new T.Vector3(Math.abs(n.x) < 0.7 ? 1 : 0, Math.abs(n.x) < 0.7 ? 0 : 1, 0).cross(n).normalize();
    const b = n.clone().cross(a), lift = this.radius * 0.004, ends = [];
    for (let i = 0; i < 64; ++i) {
      const t = i / 32 * Math.PI;
      for (const k of ['x', 'y', 'z'])
        ends.push({ x: point[0], y: point[1], z: point[2] }[k] + lift * n[k] + radius * (Math.cos(t) * a[k] + Math.sin(t) * b[k]));
    }
    return this.line(ends, color, opacity, T.LineLoop);
  }

  line(ends, color, opacity = 1, Kind = T.Line) {
    const g = new T.BufferGeometry();
    g.setAttribute('position', new T.BufferAttribute(new Float32Array(ends), 3));
    const line = new Kind(g, new T.LineBasicMaterial({ color, opacity, transparent: true, depthTest: false }));
    line.renderOrder = 2;
    return line;
  }

  dots(points, color, size) {
    const g = new T.BufferGeometry();
    g.setAttribute('position', new T.BufferAttribute(new Float32Array(points), 3));
    const dots = new T.Points(g, new T.PointsMaterial({ color, size, sizeAttenuation: false, depthTest: false, transparent: true }));
    dots.renderOrder = 2;
    return dots;
  }

  clear(group) {
    for (const child of [...group.children]) { group.remove(child); child.geometry.dispose(); child.material.dispose(); }
  }
}
