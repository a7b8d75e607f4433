// In a worker: calls the module. Of several requests that wait only the last is computed.
import { initSync, Tip, linear, cycle, command, settled, boundary, raster, raster_command, walker, walker_command } from '../../../../target/site-build/web/stickslip_web.js';

let tip = null; // the latest run
let waiting = null; // request for a run
let busy = false;
let mapping = 0; // number of the latest request for a map

const say = (message, transfer = []) => self.postMessage(message, transfer);
let wake = () => {};
/** Receives messages for some time; a request for a run ends it at once. */
const pause = (time = 0) => new Promise((go) => {
  wake = go;
  setTimeout(go, time);
});
/** While a slider moves, requests follow faster than this: nothing is begun that would delay the next run. */
const PATIENCE = 40; // ms

/** The result, or the reason why there is none. */
function tried(make) {
  try {
    return { found: make() };
  } catch (error) {
    return { why: String(error.message ?? error) };
  }
}

async function follow() {
  busy = true;
  while (waiting) {
    const { id, parameters } = waiting;
    waiting = null;
    await judge(id, parameters);
  }
  busy = false;
}

/** The run first, because the page shows it; then the slower parts, unless another run is requested meanwhile. */
async function judge(id, parameters) {
  say({ kind: 'begun', id });
  const made = tried(() => new Tip(parameters));
  if (made.why) return say({ kind: 'refused', id, message: made.why });
  tip?.free();
  tip = made.found;
  const samples = tip.samples();
  say({ kind: 'run', id, samples, command: command(parameters), cut: tip.cut_off() }, [samples.buffer]);
  const parts = {
    linear: () => JSON.parse(linear(parameters)),
    judged: () => JSON.parse(tip.summary()),
    cycle: () => without(JSON.parse(cycle(held(parameters)))),
  };
  await pause(PATIENCE);
  if (waiting) return;
  for (const [kind, make] of Object.entries(parts)) {
    await pause();
    if (waiting) return;
    say({ kind, id, ...tried(make) });
  }
  say({ kind: 'settled', id });
}

/** The document of a cycle without its profile and history, which the page does not show. */
function without(document) {
  const { profile, history, ...rest } = document;
  return rest;
}

/** The parameters, if the tip is held on its line: only then cycles can be computed. */
function held(parameters) {
  const { stiffness_across: free } = JSON.parse(parameters);
  if (free !== null && free !== undefined) throw new Error('cycles are available for a tip that is held on its line');
  return parameters;
}

function frame({ t, behind, ahead, count, isFree }) {
  if (!tip) return;
  const [x0, support, y0] = tip.positions(t);
  const u = tip.heights(t, x0 - behind, x0 + ahead, count);
  say({ kind: 'frame', t, x0, y0: isFree ? y0 : null, support, from: x0 - behind, to: x0 + ahead, u }, [u.buffer]);
}

/** Row by row of r, coarse first; a later request ends it. */
async function map({ id, parameters, velocities, alphas }) {
  mapping = id;
  say({ kind: 'begun', id });
  const curve = boundary(parameters, Float64Array.from(velocities));
  say({ kind: 'boundary', id, curve });
  for (let stride = 8, first = true; stride >= 1; stride /= 2, first = false) {
    for (let i = 0; i < velocities.length; i += stride) {
      const old = !first && i % (2 * stride) === 0;
      const wanted = alphas.map((_, j) => j).filter((j) => j % stride === 0 && !(old && j % (2 * stride) === 0));
      if (!wanted.length) continue;
      const classes = settled(parameters, velocities[i], Float64Array.from(wanted, (j) => alphas[j]));
      say({ kind: 'column', id, i, wanted, classes, stride });
      await pause();
      if (id !== mapping) return;
    }
  }
  say({ kind: 'mapped', id });
}

function scan({ parameters, scan: path }) {
  const done = tried(() => {
    const written = raster(parameters, path, (line, row, columns, heights) => {
      say({ kind: 'line', line, row, columns, heights }, [heights.buffer]);
    });
    return { ...JSON.parse(written), command: raster_command(parameters, path) };
  });
  say({ kind: 'scanned', ...done });
}

let walk = null; // the latest request for a walker
/** Computes the newest of the requests that wait. */
async function step(request) {
  walk = request;
  await pause(PATIENCE);
  if (request !== walk) return;
  say({ kind: 'begun', id: request.id });
  const made = tried(() => ({ ...JSON.parse(walker(request.parameters)), command: walker_command(request.parameters) }));
  say({ kind: 'walked', id: request.id, ...made });
}

self.onmessage = ({ data }) => {
  if (data.kind === 'begin') initSync({ module: data.bytes });
  else if (data.kind === 'run') {
    waiting = data;
    if (busy) wake();
    else follow();
  } else if (data.kind === 'frame') tried(() => frame(data));
  else if (data.kind === 'document') say({ kind: 'document', ...tried(() => tip.document()) });
  else if (data.kind === 'cycle-document') say({ kind: 'document', ...tried(() => cycle(data.parameters)) });
  else if (data.kind === 'map') map(data).catch((error) => say({ kind: 'refused', message: String(error.message ?? error) }));
  else if (data.kind === 'scan') scan(data);
  else if (data.kind === 'walk') step(data);
};
