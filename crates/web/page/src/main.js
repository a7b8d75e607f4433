// The page: its state, its workers, and its pictures and numbers.
import { prepare, hire } from './crew.js';
import { sliders } from './controls.js';
import { charts } from './charts.js';
import { facts } from './facts.js';
import { phase, unpacked } from './phase.js';
import { raster } from './raster.js';
import { scene } from './scene.js';
import { theme } from './theme.js';
import { PRESETS } from './presets.js';
import { tour } from './tour.js';
import { walker } from './walker.js';
import { SLIDERS, SCAN_SLIDERS, WALKER_SLIDERS, address, fromAddress, usual, walkerOf } from './parameters.js';
import precomputed from '../map.json';

const at = (id) => document.getElementById(id);
const embedded = (id) => at(id).textContent;
prepare(embedded('worker-script'), embedded('module'));

let state = usual();
let latestId = 0; // number of the latest request for a run
let since = 0; // its time
let latest = null; // columns of the run that is shown
let isFree = false; // whether its tip can leave the line
let command = '';
let cut; // the time at which the run was cut off, if it was
const cutOff = () => `Cut off at t = ${cut.toPrecision(6)}: the page computes for 4 seconds, the command below goes on.`;
/** For tests: the durations of redraws, and the data shown. */
const seen = (window.stickslip = { redraws: [], latestId: () => latestId, state: () => state, columns: () => latest, map: () => map.seen() });

const table = facts(at('facts'));
const plots = charts((t) => picture.go(t));
const live = hire({
  run: shown,
  frame: (found) => picture.frame(found),
  linear: (found) => found.id === latestId && table.linear(found),
  judged: (found) => found.id === latestId && table.judged(found),
  cycle: (found) => found.id === latestId && table.cycle(found),
  settled({ id }) {
    if (id !== latestId) return;
    at('summary').textContent = cut === undefined ? table.sentence(state.run) : `${cutOff()} ${table.sentence(state.run)}`;
    plots.describe();
    document.body.dataset.settled = id;
  },
  document: saved,
  refused({ id, message }) {
    if (id !== undefined && id !== latestId) return;
    at('error').hidden = false;
    at('error').textContent = message;
  },
});
const picture = scene(
  { canvas: at('scene'), time: at('time'), speed: at('speed'), play: at('play'), clock: at('clock') },
  live.ask,
  (t) => latest && plots.now(t),
  () => isFree,
);
const map = phase(
  { canvas: at('map'), status: at('map-status'), legend: at('legend'), zoomIn: at('zoom-in'), zoomOut: at('zoom-out'), whole: at('zoom-whole') },
  unpacked(precomputed),
  (message) => mapper.ask({ ...message, parameters: JSON.stringify(message.parameters) }),
  ({ r, alpha }) => change({ r, alpha }),
);
const mapper = hire({ boundary: map.boundary, column: map.column, mapped: map.mapped, refused: map.refused });
const rows = sliders(at('sliders'), SLIDERS, (name, value) => set('run', name, value));
const scanRows = sliders(at('scan-sliders'), SCAN_SLIDERS, (name, value) => set('scan', name, value));
const walkRows = sliders(at('walker-sliders'), WALKER_SLIDERS, (name, value) => set('walk', name, value));
const walking = walker({ canvas: at('walk'), status: at('walker-status'), code: at('walker-command') }, hire);
const scanned = raster({ canvas: at('raster'), button: at('scan'), status: at('raster-status'), scale: at('raster-scale') }, hire, () => state);

function set(part, name, value) {
  state[part][name] = value;
  document.querySelectorAll('#presets button').forEach((button) => button.setAttribute('aria-pressed', 'false'));
  if (part === 'run') return ask();
  if (part === 'walk') walk();
  remember();
}
function change(values) {
  Object.assign(state.run, values);
  rows.show(state.run);
  ask();
}
function showAll() {
  rows.show(state.run);
  scanRows.show(state.scan);
  walkRows.show(state.walk);
  at('start').value = state.run.start;
  at('path').value = state.scan.path;
}

function ask() {
  since = performance.now();
  live.ask({ kind: 'run', id: ++latestId, parameters: JSON.stringify(state.run) });
  map.point(state.run);
  remember();
}
let isWalkerSeen = false;
/** The walker is computed only once its picture is visible. */
function walk() {
  if (isWalkerSeen) walking.ask(walkerOf(state.walk));
}
new IntersectionObserver(([{ isIntersecting }], watching) => {
  if (!isIntersecting) return;
  watching.disconnect();
  isWalkerSeen = true;
  walk();
}).observe(at('walkers'));

let due;
/** Delayed while a slider moves, because browsers limit how often an address may change. */
function remember() {
  clearTimeout(due);
  due = setTimeout(() => {
    history.replaceState(null, '', address(state));
    map.follow(state.run);
  }, 150);
}

function shown({ id, samples, command: line, cut: reached }) {
  if (id !== latestId) return;
  cut = reached;
  if (cut !== undefined) at('summary').textContent = cutOff();
  const n = samples.length / 6;
  isFree = state.run.stiffness_across !== null;
  latest = [0, 1, 2, 3, 4, 5].map((column) => samples.subarray(column * n, (column + 1) * n));
  at('error').hidden = true;
  plots.draw(latest, isFree);
  picture.over([latest[0][0], latest[0][n - 1]]);
  command = line;
  at('command').textContent = line;
  // Charts draw in a microtask; after it the picture is complete.
  queueMicrotask(() => {
    seen.redraws.push(performance.now() - since);
    document.body.dataset.ready = id;
  });
}

let name = 'run.json';
function saved({ found, why }) {
  if (why) return (at('error').hidden = false), (at('error').textContent = why);
  const link = document.createElement('a');
  link.href = URL.createObjectURL(new Blob([found], { type: 'application/json' }));
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10_000);
}
function save(kind, as) {
  name = as;
  live.ask({ kind, parameters: JSON.stringify(state.run) });
}
async function copy(text, button) {
  try {
    await navigator.clipboard.writeText(text);
    button.textContent = 'Copied';
  } catch {
    button.textContent = 'Not allowed here';
  }
  setTimeout(() => (button.textContent = button.dataset.label), 1500);
}

for (const preset of PRESETS) {
  const button = document.createElement('button');
  button.textContent = preset.name;
  button.setAttribute('aria-pressed', 'false');
  button.addEventListener('click', () => {
    state = { ...state, run: { ...preset.run }, scan: { ...state.scan, ...preset.scan } };
    showAll();
    ask();
    document.querySelectorAll('#presets button').forEach((other) => other.setAttribute('aria-pressed', String(other === button)));
    if (preset.scan) show('rasters');
  });
  at('presets').append(button);
}
at('start').addEventListener('change', () => set('run', 'start', at('start').value));
at('path').addEventListener('change', () => set('scan', 'path', at('path').value));
at('save-run').addEventListener('click', () => save('document', 'run.json'));
at('save-cycle').addEventListener('click', () => save('cycle-document', 'cycle.json'));
at('copy-command').addEventListener('click', () => copy(command, at('copy-command')));
at('copy-link').addEventListener('click', () => copy(location.href, at('copy-link')));
theme(at('theme'), () => {
  plots.redress();
  picture.draw();
  map.draw();
  scanned.draw();
  walking.draw();
});
const guide = tour({ list: at('tour-steps'), text: at('tour-text'), next: at('tour-next') });
guide.begin();

/** Scrolls to a section, and starts the raster if it is that one. */
function show(place) {
  if (place === 'rasters') scanned.begin();
  at(place).scrollIntoView({ block: 'nearest' });
}

function arrive() {
  const { strange, show: place, ...found } = fromAddress(location.hash);
  guide.at(location.hash);
  state = found;
  showAll();
  ask();
  walk();
  if (place) show(place);
  at('strange').hidden = strange.length === 0;
  at('strange').textContent = strange.length ? `Not understood in the address: ${strange.join(', ')}.` : '';
}
addEventListener('hashchange', arrive);
arrive();
