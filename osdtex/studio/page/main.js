// main.js -- the page: what the program tells, and what the person does.
import { View, VIEWS } from './view.js';
import { readSurface, readMapping, readSeams, readTexture } from './wire.js';
import { TOOLS, combed, brushed, erased, gestures } from './tools.js';

const $ = id => document.getElementById(id);
const stage = $('stage');
const view = new View($('canvas'), stage);

// What is chosen on the page, as opposed to what is asked of the program.
const page = {
  tool: 'look', radius: 0.07, reach: 2.5, size: 1.5, slice: 1, mask: 2,
  at: [0.5, 0.5], angle: 0, combAngle: 0, stroke: null, asked: 0, took: null,
  places: [], placesOf: null, place: -1, local: true,
};
let state = null, texture = null, loads = Promise.resolve(), seenError = '';

const constraints = () => state.recipe.constraints.constraints ?? [];
const radius = () => page.radius * view.radius;

// ---- the program ----

async function post(path, body) {
  try {
    const answer = await fetch(path, { method: 'POST', body });
    const said = await answer.text();
    complain(answer.ok ? '' : said);
    return answer.ok;
  } catch { away(); return false; }
}

// A change of the recipe. The next change builds on it at once, before the
// program has answered.
async function change(edit) {
  const recipe = structuredClone(state.recipe);
  edit(recipe);
  page.asked = performance.now();
  await post(`recipe?revision=${state.revision}`, JSON.stringify(recipe));
}

// Whether gestures can change the texture around themselves alone: as edits of
// what is there. Some methods lay nothing that could be edited.
const canEdit = () => ['hierarchical', 'material'].includes(state?.snapshot?.facts.method);
const isLocal = () => page.tool === 'redo' || (page.local && canEdit());

// The same constraints as the next edit, which reaches so far and no farther.
function asEdit(list) {
  if (!isLocal()) return list;
  const edit = 1 + Math.max(0, ...constraints().map(c => c.edit ?? 0));
  const reach = Number((radius() * (page.reach - 1)).toPrecision(6));
  return list.map(c => ({ ...c, edit, reach }));
}

const changeList = list => change(r => { r.constraints.constraints = list; });
const addToList = more => more.length ? changeList(constraints().concat(more)) : undefined;

async function step(path) { page.asked = performance.now(); await post(path); }

async function listen() {
  for (let after = 0;;) {
    try {
      const answer = await fetch(`state?after=${after}`);
      if (!answer.ok) throw new Error(await answer.text());
      state = await answer.json();
      after = state.serial;
      $('away').hidden = true;
      loads = loads.then(load).catch(e => complain(e.message));
      told();
    } catch {
      away();
      after = 0;
      await new Promise(done => setTimeout(done, 1500));
    }
  }
}

// Gets what has changed on the program's side.
async function load() {
  const s = state.snapshot;
  if (!s || view.mapping?.serial === s.serial) return;
  if (view.surface?.serial !== s.surface) view.setSurface(await readSurface());
  const mapping = await readMapping();
  if (mapping.surface !== view.surface.serial || mapping.serial !== s.serial) return; // a newer one comes
  if (view.exemplar !== s.exemplar) {
    const all = [];
    for (let k = 0; k < mapping.exemplars; ++k) all.push(await readTexture(k));
    view.setTextures(all);
    view.exemplar = s.exemplar;
    texture = all[0];
    drawPicture();
  }
  view.setMapping(mapping);
  await loadSeams();
  if (page.asked) {
    page.took = (performance.now() - page.asked) / 1000;
    page.asked = 0;
  }
  document.body.dataset.shown = s.revision;
  told();
}

function away() {
  $('away').hidden = false;
  $('away').textContent = 'The program has ended. Everything that you did is saved; start ' +
    'osdtex studio again with the same words, and it goes on from here.';
}

function complain(sentence) { $('error').textContent = sentence; }

// ---- what is told ----

const row = (name, value, title = '') =>
  `<dt title="${escape(title)}">${escape(name)}</dt><dd>${escape(value)}</dd>`;
function escape(text) {
  const span = document.createElement('span');
  span.textContent = text;
  return span.innerHTML.replaceAll('"', '&quot;');
}
const short = x => Math.abs(x) >= 1000 ? Math.round(x).toLocaleString('en') : String(Number(x.toPrecision(3)));

const NAMES = {
  'seams.visible_share': ['Seams that show', v => `${short(100 * v)} %`],
  'seams.energy': ['Seam energy', short],
  'seams.delta_e_p50': ['Difference at seams', short],
  'seams.length_texels': ['Length of seams', v => `${short(v)} px`],
  'distortion.stretch_ratio_p95': ['Stretch (95 %)', v => `${short(v)} ×`],
};

function told() {
  const s = state, shown = s.snapshot;
  $('undo').disabled = !s.can_undo;
  $('redo').disabled = !s.can_redo;
  $('progress').hidden = !s.busy;
  $('progress').children[0].value = s.fraction;
  $('progress').children[1].textContent = shown ? 'Texturing' : 'Texturing for the first time';
  if (s.error !== seenError) { seenError = s.error; complain(s.error); }
  $('saved').textContent = s.cancelled ? 'Stopped: the picture is older than what is asked for. Any gesture goes on.'
    : !s.busy && page.took ? `${page.took.toFixed(page.took < 1 ? 2 : 1)} s from gesture to picture` : 'All is saved';
  $('told').textContent = s.told;
  $('command').textContent = s.command;
  $('stage').dataset.busy = s.busy;
  // Tools for which there is nothing to choose are not in the way.
  tool('material').hidden = !(shown?.facts.slices > 0);
  tool('mask').hidden = !(shown?.exemplars > 1);
  tool('redo').hidden = !canEdit();
  if (page.couldEdit !== canEdit()) { page.couldEdit = canEdit(); showOptions(); }
  fillChoices(s);
  tellNumbers(shown);
  tellPlaces(shown);
  tellGestures();
  drawMarks();
}

function fillChoices(s) {
  const choose = $('choose');
  if (choose.options.length !== s.exemplars.length)
    choose.replaceChildren(...s.exemplars.map((name, i) => new Option(name, i)));
  choose.value = s.recipe.exemplar;
  choose.hidden = s.exemplars.length < 2;
  if (document.activeElement !== $('width'))
    $('width').value = s.recipe.scale || (s.snapshot ? Number(s.snapshot.facts.scale.toPrecision(4)) : '');
}

function tellNumbers(shown) {
  if (!shown) return;
  const f = shown.figures, { faces, patches, method } = shown.facts;
  const rows = [row('Faces', short(faces)), row('Patches', short(patches)), row('Method', method)];
  if (f) {
    for (const r of f.rows)
      rows.push(row(NAMES[r.key][0], NAMES[r.key][1](r.value), r.sentence));
    const none = f.class === 'isotropic';
    $('kind').textContent = none ? 'Looks alike in all directions: combing does not change it.'
      : { directional: 'Has a direction.', lattice: 'Repeats on a lattice.', 'weak-lattice': 'Repeats, more or less.' }[f.class];
  }
  rows.push(row('Time', `${shown.seconds.toFixed(1)} s`));
  $('numbers').innerHTML = rows.join('');
}

function tellGestures() {
  const list = constraints(), kinds = { comb: 'Comb', size: 'Size', material: 'Slice', mask: 'Exemplar', redo: 'Other' };
  $('gestures').replaceChildren(...gestures(list).map(g => {
    const item = document.createElement('li');
    const go = document.createElement('button'), drop = document.createElement('button');
    go.textContent = kinds[g.kind] + (g.value === undefined ? '' : ` ${short(g.value)}`);
    go.title = 'Look there';
    go.onclick = () => visitGesture(list[g.begin]);
    drop.textContent = '×';
    drop.title = drop.ariaLabel = 'Take this back';
    drop.onclick = () => changeList(list.toSpliced(g.begin, g.end - g.begin));
    item.append(go, drop);
    return item;
  }));
}

// Only where they have changed, so that the list is not scrolled away.
function tellPlaces(shown) {
  const places = shown?.facts.places ?? [];
  if (page.placesOf === shown?.serial) return;
  page.places = places;
  page.placesOf = shown?.serial;
  page.place = Math.min(page.place, places.length - 1);
  $('places').replaceChildren(...places.map((p, i) => {
    const item = document.createElement('li'), go = document.createElement('button');
    go.textContent = `${i + 1}. ${short(p.length)} units, ${short(100 * p.difference)} %`;
    go.title = 'Length of the seams there, and how much their sides differ (100 %: black beside white)';
    go.onclick = () => visitPlace(i);
    item.append(go);
    return item;
  }));
  markPlace();
}

function markPlace() {
  [...$('places').children].forEach((item, i) => item.setAttribute('aria-current', i === page.place));
  $('place').textContent = page.places.length
    ? (page.place < 0 ? `${page.places.length} places` : `${page.place + 1} of ${page.places.length}`) : 'None';
}

function visitPlace(i) {
  const p = page.places[i];
  if (!p) return;
  page.place = i;
  view.visit(p.point.map((x, k) => x - view.surface.origin[k]), p.normal, view.radius * 0.9);
  markPlace();
  // The list alone, not the panel, whose options stay in sight.
  const list = $('places'), item = list.children[i];
  list.scrollTop = item.offsetTop - list.offsetTop - (list.clientHeight - item.clientHeight) / 2;
}

const stepPlace = by => page.places.length &&
  visitPlace((page.place + by + page.places.length) % page.places.length);

// What only the view of seams needs.
async function loadSeams() {
  if (view.show === 'seams' && view.mapping && !view.seams) view.setSeams(await readSeams());
}

function visitGesture(c) {
  if (!c.point || !view.surface) return;
  const at = c.point.map((x, k) => x - view.surface.origin[k]);
  const out = at.map((x, k) => x - view.centre.getComponent(k));
  const l = Math.hypot(...out) || 1;
  view.visit(at, out.map(x => x / l), view.radius * 1.6);
}

// ---- marks on the model ----

function drawMarks() {
  if (!view.surface) return;
  view.clear(view.marks);
  const combs = [], places = [], kept = [], o = view.surface.origin;
  for (const c of constraints()) {
    if (!c.point) continue;
    const p = c.point.map((x, k) => x - o[k]);
    if (c.direction) {
      const l = (c.radius || radius()) * 0.8;
      combs.push(...p.map((x, k) => x - l * c.direction[k]), ...p.map((x, k) => x + l * c.direction[k]));
    } else (c.radius ? places : kept).push(...p);
  }
  if (page.tool !== 'look') {
    if (combs.length) {
      const line = view.line(combs, 0xffc15a, 0.9, view.field.constructor);
      view.marks.add(line);
    }
    if (places.length) view.marks.add(view.dots(places, 0x6fd3ff, 7));
    if (kept.length) view.marks.add(view.dots(kept, 0xffffff, 3));
  }
  view.draw();
}

function drawCursor(hit) {
  view.clear(view.cursor);
  if (hit && page.tool !== 'look') {
    view.cursor.add(view.ring(hit.point, hit.normal, radius(), 0xffffff, 0.9));
    if (['size', 'material', 'mask'].includes(page.tool) || (isLocal() && BRUSHES.includes(page.tool)))
      view.cursor.add(view.ring(hit.point, hit.normal, radius() * page.reach, 0x6fd3ff, 0.6));
    if (page.stroke?.path.length > 1)
      view.cursor.add(view.line(page.stroke.path.flatMap(p => p.point), 0xffc15a));
  }
  view.draw();
}

// ---- gestures ----

const near3 = (a, b) => Math.hypot(...a.map((x, k) => x - b[k]));

function apply(path) {
  const s = view.surface, r = radius(), near = p => view.picker.near(p);
  const brush = (value, neutral) => addToList(asEdit(
    brushed(path, r, r * page.reach, value, isLocal() ? null : neutral, s.origin, near)));
  switch (page.tool) {
    case 'comb': return addToList(asEdit(combed(path, r, s.origin)));
    case 'redo': {
      const at = brushed(path, r, r, {}, null, s.origin, near);
      const tries = constraints().filter(c => c.redo && near3(c.point, at[0].point) < r + c.radius);
      const redo = 1 + Math.max(0, ...tries.map(c => c.redo));
      return addToList(asEdit(at.map(c => ({ ...c, redo }))));
    }
    case 'size': return brush({ scale: page.size }, { scale: 1 });
    case 'material': return brush({ material: page.slice }, { material: 0 });
    case 'mask': return brush({ exemplar: page.mask }, { exemplar: 1 });
    case 'erase': {
      const left = erased(constraints(), path, r, s.origin);
      return left.length < constraints().length ? changeList(left) : undefined;
    }
    case 'first':
      return change(x => { x['first-patch'] = [s.cage[path[0].face], ...page.at, page.angle]; });
  }
}

const place = e => {
  const box = stage.getBoundingClientRect();
  return [e.clientX - box.left, e.clientY - box.top];
};
const fingers = new Set();
const BRUSHES = ['comb', 'size', 'material', 'mask', 'redo'];

stage.addEventListener('pointerdown', e => {
  fingers.add(e.pointerId);
  stage.focus({ preventScroll: true });
  if (fingers.size > 1) { page.stroke = null; drawCursor(null); return; }
  const hit = page.tool !== 'look' && e.button === 0 && !e.shiftKey && view.hit(...place(e));
  if (!hit) return;
  e.stopPropagation();
  stage.setPointerCapture(e.pointerId);
  page.stroke = { id: e.pointerId, path: [hit] };
  drawCursor(hit);
}, true);

stage.addEventListener('pointermove', e => {
  if (!page.stroke) {
    if (page.tool !== 'look' && !e.buttons) drawCursor(view.hit(...place(e)));
    return;
  }
  if (e.pointerId !== page.stroke.id) return;
  e.stopPropagation();
  const hit = view.hit(...place(e));
  if (hit) page.stroke.path.push(hit);
  drawCursor(hit ?? page.stroke.path.at(-1));
}, true);

for (const kind of ['pointerup', 'pointercancel'])
  stage.addEventListener(kind, e => {
    fingers.delete(e.pointerId);
    if (!page.stroke || e.pointerId !== page.stroke.id) return;
    const path = page.stroke.path;
    page.stroke = null;
    if (kind === 'pointerup') apply(path);
    drawCursor(path.at(-1));
  }, true);
stage.addEventListener('pointerleave', () => { if (!page.stroke) drawCursor(null); });

// The tool at the middle of the picture, for hands on the keyboard.
function applyAtMiddle() {
  const x = stage.clientWidth / 2, y = stage.clientHeight / 2;
  const hit = view.hit(x, y);
  if (!hit || page.tool === 'look') return;
  if (page.tool !== 'comb') { apply([hit]); return; }
  const turn = page.combAngle * Math.PI / 180, path = [];
  const away = view.camera.position.distanceTo(view.controls.target);
  const pixels = 2.2 * radius() / (2 * away * Math.tan(view.camera.fov * Math.PI / 360)) * stage.clientHeight;
  for (let i = -6; i <= 6; ++i) {
    const p = view.hit(x + Math.cos(turn) * pixels * i / 6, y - Math.sin(turn) * pixels * i / 6);
    if (p) path.push(p);
  }
  if (path.length > 1) apply(path);
}

// ---- tools and options ----

function button(parent, text, key, press) {
  const b = document.createElement('button');
  b.textContent = text;
  if (key) {
    const kbd = document.createElement('kbd');
    kbd.textContent = key;
    b.append(kbd);
  }
  b.onclick = press;
  parent.append(b);
  return b;
}

const toolButtons = TOOLS.map(t => {
  const b = button($('tools'), t.name, t.key, () => chooseTool(t.id));
  b.title = t.hint;
  return b;
});
const tool = id => toolButtons[TOOLS.findIndex(t => t.id === id)];
const viewButtons = VIEWS.map((name, i) =>
  button($('views'), name[0].toUpperCase() + name.slice(1), String(i + 1), () => chooseView(name)));

const LEGENDS = {
  texture: '', patches: 'Each piece of the exemplar in a colour of its own.',
  stretch: 'Red: larger than asked for. Blue: smaller. White: as it should be.',
  seams: 'The redder, the more the two sides differ.',
  field: 'Which way the texture is to run.',
  scale: 'Red: larger asked for. Blue: smaller.',
};

function chooseView(name) {
  $('legend').textContent = LEGENDS[name];
  view.choose(name);
  loads = loads.then(loadSeams).catch(e => complain(e.message));
  viewButtons.forEach((b, i) => b.setAttribute('aria-pressed', VIEWS[i] === name));
}

function chooseTool(id) {
  page.tool = id;
  toolButtons.forEach((b, i) => b.setAttribute('aria-pressed', TOOLS[i].id === id));
  $('hint').textContent = TOOLS.find(t => t.id === id).hint;
  stage.style.cursor = id === 'look' ? 'grab' : 'crosshair';
  showOptions();
  drawCursor(null);
  if (state) drawMarks();
}

function slider(name, low, high, at, say, take) {
  const label = document.createElement('label');
  const range = Object.assign(document.createElement('input'), { type: 'range', min: low, max: high, step: 'any', value: at });
  const out = document.createElement('output');
  const tell = () => { out.textContent = say(Number(range.value)); };
  range.oninput = () => { take(Number(range.value)); tell(); };
  tell();
  label.append(name, out, range);
  return label;
}

function showOptions() {
  const list = [], t = page.tool;
  if (t === 'look') {
    list.push(slider('Light', -180, 180, view.lightTurn, v => `${Math.round(v)}°`, v => { view.lightTurn = v; view.draw(); }));
    const lit = slider('Shade', 0, 1, view.material.uniforms.lit.value, v => `${Math.round(100 * v)} %`, v => { view.material.uniforms.lit.value = v; view.draw(); });
    list.push(lit);
  } else if (t !== 'first')
    list.push(slider('Radius', -5, -0.7, Math.log2(page.radius), v => `${short(2 ** v * view.radius || 0)} units`, v => { page.radius = 2 ** v; }));
  if (BRUSHES.includes(t) && t !== 'redo' && canEdit()) {
    const label = document.createElement('label');
    const box = Object.assign(document.createElement('input'), { type: 'checkbox', checked: page.local });
    box.onchange = () => { page.local = box.checked; showOptions(); };
    label.append(box, ' Change only what is near');
    list.push(label);
  }
  if (['size', 'material', 'mask'].includes(t) || (isLocal() && BRUSHES.includes(t)))
    list.push(slider(isLocal() ? 'Changes within' : 'Goes over within', 1.3, 6, page.reach, v => `${short(v)} radii`, v => { page.reach = v; }));
  if (t === 'comb')
    list.push(slider('Direction of Enter', -90, 90, page.combAngle, v => `${Math.round(v)}°`, v => { page.combAngle = v; }));
  if (t === 'size')
    list.push(slider('Size', -2, 2, Math.log2(page.size), v => `${short(2 ** v)} ×`, v => { page.size = 2 ** v; }));
  if (t === 'material')
    list.push(slider('Slice', 0, 1, page.slice, short, v => { page.slice = Number(v.toFixed(3)); }));
  if (t === 'mask')
    list.push(slider('Exemplar', 1, state?.snapshot?.exemplars ?? 2, page.mask, v => String(Math.round(v)), v => { page.mask = Math.round(v); }));
  if (t === 'first')
    list.push(slider('Turned by', -180, 180, page.angle, v => `${Math.round(v)}°`, v => { page.angle = Math.round(v); drawPicture(); }));
  $('options').replaceChildren(...list);
  $('panel').scrollTop = 0;
}

// ---- the exemplar ----

function drawPicture() {
  if (!texture) return;
  const canvas = $('picture'), { width, height, texels } = texture;
  canvas.width = width;
  canvas.height = height;
  const c = canvas.getContext('2d'), image = c.createImageData(width, height);
  for (let y = 0; y < height; ++y)
    image.data.set(texels.subarray(4 * width * (height - 1 - y), 4 * width * (height - y)), 4 * width * y);
  c.putImageData(image, 0, 0);
  if (page.tool !== 'first') return;
  const x = page.at[0] * width, y = (1 - page.at[1]) * height, r = width / 9;
  const turn = page.angle * Math.PI / 180;
  for (const [color, thick] of [['#000', width / 60], ['#ffc15a', width / 120]]) {
    c.strokeStyle = color;
    c.lineWidth = thick;
    c.beginPath();
    c.arc(x, y, r, 0, 7);
    c.moveTo(x, y);
    c.lineTo(x + r * Math.cos(turn), y - r * Math.sin(turn));
    c.stroke();
  }
}

$('picture').addEventListener('pointerdown', e => {
  const box = $('picture').getBoundingClientRect();
  chooseTool('first');
  page.at = [(e.clientX - box.left) / box.width, 1 - (e.clientY - box.top) / box.height].map(x => Number(x.toFixed(4)));
  drawPicture();
});
$('choose').onchange = () => change(r => { r.exemplar = Number($('choose').value); });
$('width').onchange = () => change(r => { r.scale = Math.max(0, Number($('width').value) || 0); });

// ---- the bar, and keys ----

const again = () => change(r => { r.seed += 1; });
$('before').onclick = () => stepPlace(page.place < 0 ? 0 : -1);
$('after').onclick = () => stepPlace(1);
$('undo').onclick = () => step('undo');
$('redo').onclick = () => step('redo');
$('again').onclick = again;
$('cancel').onclick = () => post('cancel');
$('export').onclick = () => post('export');
$('copy').onclick = () => navigator.clipboard.writeText(state.command);
$('help').onclick = () => $('keys').showModal();

const KEYS = [
  ...TOOLS.map(t => [t.key, `${t.name}. ${t.hint}`]),
  ['1 to 6', 'What is shown: ' + VIEWS.join(', ')],
  ['[ ]', 'Smaller or larger radius'],
  ['Arrows, + −', 'Turn the model, come near'],
  ['Enter', 'The tool at the middle of the picture'],
  ['Home', 'All of the model'],
  ['Ctrl Z, Ctrl Shift Z', 'Undo, redo'],
  ['N, Shift N', 'To where seams show most, one after the other'],
  ['R', 'Another seed'],
  ['Esc', 'Stop the work'],
  ['Shift drag, two fingers', 'Turn the model, whatever the tool'],
];
$('keys').innerHTML = '<table>' + KEYS.map(([k, t]) => `<tr><td>${escape(k)}<td>${escape(t)}`).join('') +
  '</table><form method="dialog"><button>Close</button></form>';

const TURN = 0.15;
const ACTIONS = {
  ArrowLeft: () => view.turn(-TURN, 0), ArrowRight: () => view.turn(TURN, 0),
  ArrowUp: () => view.turn(0, TURN), ArrowDown: () => view.turn(0, -TURN),
  '+': () => view.zoom(0.85), '=': () => view.zoom(0.85), '-': () => view.zoom(1 / 0.85),
  Home: () => view.home(), Escape: () => state?.busy && post('cancel'), r: again,
  n: e => stepPlace(e.shiftKey ? (page.place < 0 ? 0 : -1) : 1),
  '[': () => { page.radius /= 1.15; showOptions(); }, ']': () => { page.radius *= 1.15; showOptions(); },
  '?': () => $('keys').showModal(), Enter: () => applyAtMiddle(),
};

addEventListener('keydown', e => {
  if (e.target.matches?.('input, select, dialog, dialog *')) return;
  if (e.key === 'Enter' && e.target.matches?.('button')) return;
  const key = e.key.length === 1 ? e.key.toLowerCase() : e.key;
  if ((e.ctrlKey || e.metaKey) && (key === 'z' || key === 'y')) {
    e.preventDefault();
    step(key === 'y' || e.shiftKey ? 'redo' : 'undo');
    return;
  }
  if (e.ctrlKey || e.metaKey || e.altKey) return;
  const chosen = TOOLS.find(t => t.key.toLowerCase() === key);
  const shown = VIEWS[Number(key) - 1];
  if (chosen) { if (!tool(chosen.id).hidden) chooseTool(chosen.id); }
  else if (shown) chooseView(shown);
  else if (ACTIONS[key]) { e.preventDefault(); ACTIONS[key](e); }
});

chooseView('texture');
chooseTool('look');
listen();
