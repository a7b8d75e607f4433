// In a worker: asks the module. Of several wishes that wait, only the last is done.
import { initSync, Tip, linear, cycle, command, settled, boundary, raster, raster_command, walker, walker_command } from '../../../../target/site-build/web/stickslip_web.js';

let tip = null; // the latest run
let waiting = null;
let busy = false;
let mapping = 0; // number of the latest map asked for

const say = (message, transfer = []) => self.postMessage(message, transfer);
let wake = () => {};
/** Receives messages for some time; a request for a run ends it at once. */
const pause = (time = 0) => new Promise((go) => {
  wake = go;
  setTimeout(go, time);
});
/** While a slider moves, wishes come faster than this: nothing is begun then that the next would wait for. */
const PATIENCE = 40; // ms

/** The result, or why there is none. */
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
    const { id, asked } = waiting;
    waiting = null;
    await judge(id, asked);
  }
  busy = false;
}

/** A run first, as it is waited for; then what takes longer, unless another is asked for meanwhile. */
async function judge(id, asked) {
  say({ kind: 'begun', id });
  const made = tried(() => new Tip(asked));
  if (made.why) return say({ kind: 'refused', id, message: made.why });
  tip?.free();
  tip = made.found;
  const samples = tip.samples();
  say({ kind: 'run', id, samples, command: command(asked), cut: tip.cut_off() }, [samples.buffer]);
  const parts = {
    linear: () => JSON.parse(linear(asked)),
    judged: () => JSON.parse(tip.judged()),
    cycle: () => without(JSON.parse(cycle(held(asked)))),
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

/** Profile and history stay here. */
function without(document) {
  const { profile, history, ...rest } = document;
  return rest;
}

/** The parameters of a tip that is held on its line; cycles are known of no other. */
function held(asked) {
  const { stiffness_across: free } = JSON.parse(asked);
  if (free !== null && free !== undefined) throw new Error('cycles are computed of a tip that is held on its line');
  return asked;
}

function frame({ t, behind, ahead, count, isFree }) {
  if (!tip) return;
  const [x0, support, y0] = tip.positions(t);
  const u = tip.heights(t, x0 - behind, x0 + ahead, count);
  say({ kind: 'frame', t, x0, y0: isFree ? y0 : null, support, from: x0 - behind, to: x0 + ahead, u }, [u.buffer]);
}

/** Row by row of r, coarse first; a later wish ends it. */
async function map({ id, asked, velocities, alphas }) {
  mapping = id;
  say({ kind: 'begun', id });
  const curve = boundary(asked, Float64Array.from(velocities));
  say({ kind: 'boundary', id, curve });
  for (let stride = 8, first = true; stride >= 1; stride /= 2, first = false) {
    for (let i = 0; i < velocities.length; i += stride) {
      const old = !first && i % (2 * stride) === 0;
      const wanted = alphas.map((_, j) => j).filter((j) => j % stride === 0 && !(old && j % (2 * stride) === 0));
      if (!wanted.length) continue;
      const classes = settled(asked, velocities[i], Float64Array.from(wanted, (j) => alphas[j]));
      say({ kind: 'column', id, i, wanted, classes, stride });
      await pause();
      if (id !== mapping) return;
    }
  }
  say({ kind: 'mapped', id });
}

function scan({ asked, scan: wish }) {
  const done = tried(() => {
    const written = raster(asked, wish, (line, row, columns, heights) => {
      say({ kind: 'line', line, row, columns, heights }, [heights.buffer]);
    });
    return { ...JSON.parse(written), command: raster_command(asked, wish) };
  });
  say({ kind: 'scanned', ...done });
}

let walk = null; // the latest walker asked for
/** The newest of those that wait. */
async function step(wish) {
  walk = wish;
  await pause(PATIENCE);
  if (wish !== walk) return;
  say({ kind: 'begun', id: wish.id });
  const made = tried(() => ({ ...JSON.parse(walker(wish.asked)), command: walker_command(wish.asked) }));
  say({ kind: 'walked', id: wish.id, ...made });
}

self.onmessage = ({ data }) => {
  if (data.kind === 'begin') initSync({ module: data.bytes });
  else if (data.kind === 'run') {
    waiting = data;
    if (busy) wake();
    else follow();
  } else if (data.kind === 'frame') tried(() => frame(data));
  else if (data.kind === 'document') say({ kind: 'document', ...tried(() => tip.document()) });
  else if (data.kind === 'cycle-document') say({ kind: 'document', ...tried(() => cycle(data.asked)) });
  else if (data.kind === 'map') map(data).catch((error) => say({ kind: 'refused', message: String(error.message ?? error) }));
  else if (data.kind === 'scan') scan(data);
  else if (data.kind === 'walk') step(data);
};
