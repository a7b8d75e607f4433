// The phase diagram over r and α: precomputed for the default tip, computed for other tips and enlarged parts.
import { colour, sharp } from './theme.js';

/** Classes, in the order of `crates/web/src/map.rs`. */
export const CLASSES = ['steady', 'one slip in a period', 'two slips', 'three slips or more', 'trapped', 'not settled', 'not found'];
const UNKNOWN = 7;
const CELLS = 64;
const WHOLE = { r: [0.05, 2], alpha: [0.05, 4] };
const MARGIN = { left: 46, right: 10, top: 10, bottom: 34 };

const spaced = ([from, to], n) => Array.from({ length: n }, (_, i) => from + ((to - from) * i) / (n - 1));
const clamp = (v, [a, b]) => Math.min(Math.max(v, a), b);

export function phase({ canvas, status, legend, zoomIn, zoomOut, whole }, ready, ask, picked) {
  let window_ = WHOLE;
  let law = null; // parameters beside α and r, as text
  let grid = ready;
  let curve = null;
  let at = { r: 1, alpha: 1 };
  let parameters = null;
  let latestId = 0; // number of the latest request for a map

  legend.innerHTML = CLASSES.map((name, n) => `<li><span style="background:var(--class-${n})"></span>${name}</li>`).join('');

  const isReady = () => law === ready.law && window_ === WHOLE;
  function compute() {
    delete canvas.dataset.mapped;
    const [velocities, alphas] = [spaced(window_.r, CELLS), spaced(window_.alpha, CELLS)];
    if (isReady()) {
      grid = ready;
      curve = null;
      ask({ kind: 'map', id: ++latestId, parameters, velocities: ready.r, alphas: [] });
      status.textContent = 'Precomputed. Zoom in for a finer map.';
      return draw();
    }
    grid = { r: velocities, alpha: alphas, classes: velocities.map(() => new Array(CELLS).fill(UNKNOWN)) };
    curve = null;
    status.textContent = 'Computing …';
    ask({ kind: 'map', id: ++latestId, parameters, velocities, alphas });
    draw();
  }
  const half = (list) => (list[1] - list[0]) / 2;
  const inner = () => ({ w: canvas.clientWidth - MARGIN.left - MARGIN.right, h: canvas.clientHeight - MARGIN.top - MARGIN.bottom });
  const part = (v, [a, b]) => (v - a) / (b - a);
  const x = (r) => MARGIN.left + inner().w * part(r, window_.r);
  const y = (alpha) => MARGIN.top + inner().h * (1 - part(alpha, window_.alpha));
  const place = (event) => {
    const box = canvas.getBoundingClientRect();
    const [px, py] = [event.clientX - box.left - MARGIN.left, event.clientY - box.top - MARGIN.top];
    const value = (p, [a, b]) => clamp(a + (b - a) * p, [a, b]);
    return { r: value(px / inner().w, window_.r), alpha: value(1 - py / inner().h, window_.alpha) };
  };

  function draw() {
    const { pen, width, height } = sharp(canvas);
    const colours = CLASSES.map((_, n) => colour(`--class-${n}`)).concat(colour('--paper'));
    pen.save();
    pen.beginPath();
    pen.rect(MARGIN.left, MARGIN.top, inner().w, inner().h);
    pen.clip();
    const [dr, da] = [half(grid.r), half(grid.alpha)];
    grid.classes.forEach((column, i) => {
      const [left, right] = [x(grid.r[i] - dr), x(grid.r[i] + dr)];
      column.forEach((kind, j) => {
        pen.fillStyle = colours[kind];
        const [top, bottom] = [y(grid.alpha[j] + da), y(grid.alpha[j] - da)];
        pen.fillRect(left, top, right - left + 0.6, bottom - top + 0.6);
      });
    });
    line(pen);
    cross(pen);
    pen.restore();
    axes(pen, width, height);
  }
  function line(pen) {
    if (!curve) return;
    pen.strokeStyle = colour('--ink');
    pen.lineWidth = 1.5;
    pen.beginPath();
    curve.forEach((alpha, i) => Number.isFinite(alpha) && pen.lineTo(x(grid.r[i]), y(alpha)));
    pen.stroke();
  }
  function cross(pen) {
    const [cx, cy] = [x(at.r), y(at.alpha)];
    for (const [style, size] of [['--paper', 4], ['--ink', 2]]) {
      pen.strokeStyle = colour(style);
      pen.lineWidth = size;
      pen.beginPath();
      pen.arc(cx, cy, 7, 0, 7);
      pen.stroke();
    }
  }
  function axes(pen, width, height) {
    pen.fillStyle = colour('--ink');
    pen.font = '12px system-ui';
    const label = (v, [a, b]) => v.toFixed(Math.max(2, Math.ceil(1 - Math.log10(b - a))));
    pen.textAlign = 'center';
    spaced(window_.r, 5).forEach((v) => pen.fillText(label(v, window_.r), clamp(x(v), [MARGIN.left + 8, width - 16]), height - 18));
    pen.fillText('r', MARGIN.left + inner().w / 2, height - 4);
    pen.textAlign = 'right';
    spaced(window_.alpha, 5).forEach((v) => pen.fillText(label(v, window_.alpha), MARGIN.left - 5, y(v) + 4));
    pen.fillText('α', 12, MARGIN.top + inner().h / 2);
  }

  function zoom(factor, { r, alpha } = at) {
    const narrow = ([a, b], v, bounds) => {
      const [from, to] = [v - (v - a) * factor, v + (b - v) * factor];
      return [clamp(from, bounds), clamp(to, bounds)];
    };
    const next = { r: narrow(window_.r, r, [0.02, 3]), alpha: narrow(window_.alpha, alpha, [0, 6]) };
    const wide = next.r[1] - next.r[0] >= WHOLE.r[1] - WHOLE.r[0];
    if (next.r[1] - next.r[0] < 1e-4) return;
    window_ = wide && factor > 1 ? WHOLE : next;
    compute();
  }
  function pick(next) {
    at = next;
    draw();
    picked(at);
  }
  const KEYS = {
    ArrowLeft: () => step(-1, 0), ArrowRight: () => step(1, 0), ArrowUp: () => step(0, 1), ArrowDown: () => step(0, -1),
    '+': () => zoom(0.5), '-': () => zoom(2), 0: () => back(),
  };
  const step = (i, j) => {
    const move = (v, [a, b], n) => Number(clamp(v + (n * (b - a)) / CELLS, [a, b]).toPrecision(6));
    pick({ r: move(at.r, window_.r, i), alpha: move(at.alpha, window_.alpha, j) });
  };
  const back = () => {
    window_ = WHOLE;
    compute();
  };
  canvas.addEventListener('click', (event) => {
    const { r, alpha } = place(event);
    pick({ r: Number(r.toPrecision(5)), alpha: Number(alpha.toPrecision(5)) });
  });
  let later;
  canvas.addEventListener('wheel', (event) => {
    event.preventDefault();
    clearTimeout(later);
    const [where, factor] = [place(event), event.deltaY < 0 ? 0.6 : 1 / 0.6];
    later = setTimeout(() => zoom(factor, where), 60);
  }, { passive: false });
  canvas.addEventListener('keydown', (event) => {
    const act = KEYS[event.key];
    if (!act) return;
    event.preventDefault();
    act();
  });
  zoomIn.addEventListener('click', () => zoom(0.5));
  zoomOut.addEventListener('click', () => zoom(2));
  whole.addEventListener('click', back);
  new ResizeObserver(draw).observe(canvas);

  return {
    draw,
    /** Sets the point that is marked; it is drawn with the next picture. */
    point({ r, alpha }) {
      at = { r, alpha };
    },
    /** Sets the parameters of the run. The map depends on all but α and r. */
    follow(run) {
      at = { r: run.r, alpha: run.alpha };
      const { beta, width, depth_limit, healing_time, inertia } = run;
      const text = JSON.stringify({ beta, width, depth_limit, healing_time, inertia });
      parameters = run;
      if (text === law) return draw();
      law = text;
      compute();
    },
    boundary({ id, curve: found }) {
      if (id !== latestId) return;
      curve = [...found];
      draw();
    },
    column({ id, i, wanted, classes, stride }) {
      if (id !== latestId) return;
      // A coarse point stands for its neighbours until they are computed.
      wanted.forEach((j, n) => {
        for (let p = i; p < Math.min(i + stride, grid.r.length); p++)
          for (let q = j; q < Math.min(j + stride, grid.alpha.length); q++) grid.classes[p][q] = classes[n];
      });
      draw();
    },
    mapped({ id }) {
      if (id !== latestId) return;
      canvas.dataset.mapped = JSON.stringify(window_);
      if (!isReady()) status.textContent = `Computed at ${CELLS} × ${CELLS} points.`;
    },
    refused({ message }) {
      status.textContent = message;
    },
    /** The map shown: ranges, grid and classes. */
    seen: () => ({ window: window_, ...grid }),
  };
}

/** The precomputed map as a grid. */
export function unpacked({ r, alpha, rows }) {
  const span = ([from, to, n]) => spaced([from, to], n);
  const law = JSON.stringify({ beta: 1, width: 1, depth_limit: null, healing_time: null, inertia: null });
  return { r: span(r), alpha: span(alpha), classes: rows.map((row) => [...row].map(Number)), law };
}
