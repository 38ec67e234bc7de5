// tools.js -- gestures on the model, and the constraints that they are.
//
// Each tool turns where the pointer went into entries of the documented file of
// constraints (docs/formats-constraints.md); what the program makes of them is
// its own business.

export const TOOLS = [
  { id: 'look', name: 'Look', key: 'V', hint: 'Drag to turn, wheel to come near, right drag to shift.' },
  { id: 'comb', name: 'Comb', key: 'C', hint: 'Drag along the model: the texture will run that way.' },
  { id: 'size', name: 'Size', key: 'S', hint: 'Brush where the texture is to be larger or smaller.' },
  { id: 'material', name: 'Slice', key: 'M', hint: 'Brush which slice of the stack shows.' },
  { id: 'mask', name: 'Mask', key: 'X', hint: 'Brush which exemplar shows.' },
  { id: 'redo', name: 'Other', key: 'O', hint: 'Click a spot: it gets another piece of the exemplar.' },
  { id: 'first', name: 'Start', key: 'P', hint: 'Choose a place in the exemplar, then click where it goes on the model.' },
  { id: 'erase', name: 'Erase', key: 'E', hint: 'Brush over gestures to take them back.' },
];

const sub = (a, b) => a.map((x, k) => x - b[k]);
const length = a => Math.hypot(...a);
const distance = (a, b) => length(sub(a, b));
const number = (x, digits = 6) => Number(x.toPrecision(digits));

// Numbers with as many digits as the model's size has use for.
export function rounded(v) { return v.map(x => number(x)); }

// Points along a path, so far apart.
export function resample(path, step) {
  const out = [path[0]];
  let last = path[0], left = step;
  for (const p of path.slice(1)) {
    let d = distance(p.point, last.point);
    while (d >= left && d > 0) {
      const t = left / d;
      const point = last.point.map((x, k) => x + t * (p.point[k] - x));
      last = { ...p, point };
      out.push(last);
      d = distance(p.point, point);
      left = step;
    }
    left -= d;
    last = p;
  }
  return out;
}

// A comb: at each place the way that the stroke takes there.
export function combed(path, radius, origin) {
  const places = resample(path, radius);
  if (places.length < 2) {
    const end = path[path.length - 1];
    if (distance(end.point, path[0].point) < radius * 0.2) return [];
    places.push(end);
  }
  return places.map((p, i) => {
    const way = sub(places[Math.min(i + 1, places.length - 1)].point, places[Math.max(i - 1, 0)].point);
    const n = length(way) || 1;
    return {
      point: rounded(p.point.map((x, k) => x + origin[k])), radius: number(radius),
      direction: rounded(way.map(x => x / n)),
    };
  });
}

// A brush of a value, and around it places that keep what they have: values
// are interpolated between what is asked for, so that a brush alone would
// change all of the model.
export function brushed(path, radius, reach, value, neutral, origin, near) {
  const places = resample(path, radius);
  const out = places.map(p => ({
    point: rounded(p.point.map((x, k) => x + origin[k])), radius: number(radius), ...value,
  }));
  const kept = [];
  if (!neutral) return out;
  for (const p of places)
    for (let i = 0; i < 10; ++i) {
      const [a, b] = frame(p.normal), t = i / 5 * Math.PI;
      const at = near(p.point.map((x, k) => x + reach * (Math.cos(t) * a[k] + Math.sin(t) * b[k])));
      const apart = Math.min(...places.map(q => distance(q.point, at)));
      if (apart < 0.75 * reach || apart > 1.6 * reach) continue;
      if (kept.some(q => distance(q, at) < 0.35 * reach)) continue;
      kept.push(at);
    }
  return out.concat(kept.map(p => ({
    point: rounded(p.map((x, k) => x + origin[k])), ...neutral,
  })));
}

function frame(n) {
  const pole = Math.abs(n[0]) < 0.7 ? [1, 0, 0] : [0, 1, 0];
  const a = [pole[1] * n[2] - pole[2] * n[1], pole[2] * n[0] - pole[0] * n[2], pole[0] * n[1] - pole[1] * n[0]];
  const l = length(a), u = a.map(x => x / l);
  return [u, [n[1] * u[2] - n[2] * u[1], n[2] * u[0] - n[0] * u[2], n[0] * u[1] - n[1] * u[0]]];
}

// What is left when a path with this radius has been wiped.
export function erased(list, path, radius, origin) {
  return list.filter(c => !c.point || !path.some(
    p => distance(p.point.map((x, k) => x + origin[k]), c.point) < radius));
}

// Entries that were made by one gesture follow one another: runs of the same
// kind and size that hang together.
export function gestures(list) {
  const out = [];
  list.forEach((c, i) => {
    const kind = c.redo ? 'redo' : c.direction ? 'comb' : c.scale !== undefined ? 'size'
      : c.material !== undefined ? 'material' : 'mask';
    const last = out[out.length - 1], before = list[i - 1];
    const keeps = c.radius === undefined;
    const joins = last && last.kind === kind && before.edit === c.edit && before.point && c.point &&
      (keeps || (before.radius === c.radius && distance(before.point, c.point) < 2.5 * c.radius &&
        before.scale === c.scale && before.material === c.material && before.exemplar === c.exemplar));
    if (joins) last.end = i + 1;
    else out.push({ kind, begin: i, end: i + 1, value: c.redo ? undefined : c.scale ?? c.material ?? c.exemplar });
  });
  return out;
}
