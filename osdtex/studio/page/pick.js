// pick.js -- what lies under the pointer.
//
// Leaves of a face of the cage follow one another, so boxes around runs of faces
// are tight, and only few runs are looked into.

const RUN = 96;

export class Picker {
  constructor(surface) {
    this.s = surface;
    const { points, first, corner, faces } = surface;
    const runs = Math.ceil(faces / RUN);
    this.boxes = new Float32Array(runs * 6);
    for (let r = 0; r < runs; ++r) {
      const box = [1e30, 1e30, 1e30, -1e30, -1e30, -1e30];
      const end = first[Math.min(faces, (r + 1) * RUN)];
      for (let c = first[r * RUN]; c < end; ++c)
        for (let k = 0; k < 3; ++k) {
          const x = points[3 * corner[c] + k];
          if (x < box[k]) box[k] = x;
          if (x > box[k + 3]) box[k + 3] = x;
        }
      this.boxes.set(box, 6 * r);
    }
  }

  // The first face along a ray, as {face, distance, point, normal}, or null.
  along(from, way) {
    const { faces, first } = this.s;
    const best = { distance: Infinity, face: -1 };
    for (let r = 0; r * RUN < faces; ++r) {
      if (!this.meets(r, from, way, best.distance)) continue;
      const end = Math.min(faces, (r + 1) * RUN);
      for (let f = r * RUN; f < end; ++f)
        for (let c = first[f] + 1; c + 1 < first[f + 1]; ++c)
          this.triangle(f, first[f], c, from, way, best);
    }
    if (best.face < 0) return null;
    best.point = from.map((x, k) => x + best.distance * way[k]);
    return best;
  }

  meets(r, from, way, far) {
    let near = 0;
    for (let k = 0; k < 3; ++k) {
      const a = (this.boxes[6 * r + k] - from[k]) / way[k];
      const b = (this.boxes[6 * r + 3 + k] - from[k]) / way[k];
      near = Math.max(near, Math.min(a, b));
      far = Math.min(far, Math.max(a, b));
    }
    return !(near > far);
  }

  triangle(face, c0, c1, from, way, best) {
    const { points, corner } = this.s;
    const i = 3 * corner[c0], j = 3 * corner[c1], l = 3 * corner[c1 + 1];
    const ax = points[j] - points[i], ay = points[j + 1] - points[i + 1], az = points[j + 2] - points[i + 2];
    const bx = points[l] - points[i], by = points[l + 1] - points[i + 1], bz = points[l + 2] - points[i + 2];
    const nx = ay * bz - az * by, ny = az * bx - ax * bz, nz = ax * by - ay * bx;
    const d = nx * way[0] + ny * way[1] + nz * way[2];
    if (Math.abs(d) < 1e-30) return;
    const ox = points[i] - from[0], oy = points[i + 1] - from[1], oz = points[i + 2] - from[2];
    const t = (nx * ox + ny * oy + nz * oz) / d;
    if (t <= 0 || t >= best.distance) return;
    // Twice the areas of the parts, over the whole: barycentric.
    const px = t * way[0] - ox, py = t * way[1] - oy, pz = t * way[2] - oz;
    const nn = nx * nx + ny * ny + nz * nz;
    const u = ((py * bz - pz * by) * nx + (pz * bx - px * bz) * ny + (px * by - py * bx) * nz) / nn;
    const v = ((ay * pz - az * py) * nx + (az * px - ax * pz) * ny + (ax * py - ay * px) * nz) / nn;
    if (u < 0 || v < 0 || u + v > 1) return;
    const length = Math.sqrt(nn) || 1;
    best.distance = t;
    best.face = face;
    best.normal = [nx / length, ny / length, nz / length];
  }

  // The vertex nearest to a point.
  near(point) {
    const { points, verts } = this.s;
    let best = Infinity, at = 0;
    for (let v = 0; v < verts; ++v) {
      const x = points[3 * v] - point[0], y = points[3 * v + 1] - point[1], z = points[3 * v + 2] - point[2];
      const d = x * x + y * y + z * z;
      if (d < best) { best = d; at = v; }
    }
    return [points[3 * at], points[3 * at + 1], points[3 * at + 2]];
  }
}
