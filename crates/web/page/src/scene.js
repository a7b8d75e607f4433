// The animation of the tip on the surface that it carves.
import { colour, sharp } from './theme.js';

const BEHIND = 32; // σ of surface shown behind the tip
const AHEAD = 10;
const POINTS = 421;

/** `isFree`: whether the tip can leave its line. */
export function scene({ canvas, time, speed, play, clock }, ask, moved, isFree) {
  let span = [0, 1];
  let t = 0;
  let playing = !matchMedia('(prefers-reduced-motion: reduce)').matches;
  let pending = false; // a frame is being computed
  let last = null; // the latest frame
  let before = null;
  let [low, high] = [-1, 1]; // range of the heights, changed gradually so that the picture does not jump

  const rate = () => Number(speed.value);
  const label = () => (play.textContent = playing ? 'Pause' : 'Play');
  const request = () => {
    pending = true;
    ask({ kind: 'frame', t, behind: BEHIND, ahead: AHEAD, count: POINTS, isFree: isFree() });
  };
  function go(to) {
    t = Math.min(Math.max(to, span[0]), span[1]);
    time.value = t;
    clock.textContent = `t = ${t.toFixed(1)}`;
    time.setAttribute('aria-valuetext', clock.textContent);
    moved(t);
  }
  function tick(now) {
    requestAnimationFrame(tick);
    const passed = before === null ? 0 : Math.min((now - before) / 1000, 0.1);
    before = now;
    if (!playing || pending || document.hidden) return;
    const next = t + rate() * passed;
    go(next >= span[1] ? span[0] : next);
    request();
  }
  play.addEventListener('click', () => {
    playing = !playing;
    label();
  });
  time.addEventListener('input', () => {
    playing = false;
    label();
    go(Number(time.value));
    request();
  });
  label();
  requestAnimationFrame(tick);

  function draw() {
    if (!last) return;
    const { pen, width, height } = sharp(canvas);
    const { x0, y0, support, from, to, u } = last;
    const x = (v) => ((v - from) / (to - from)) * width;
    const y = (v) => height * (0.9 - (0.55 * (v - low)) / (high - low));
    ground(pen, u, x, y, { from, to, width, height });
    const under = y(u[Math.round(((x0 - from) / (to - from)) * (u.length - 1))]);
    probe(pen, x(x0), under);
    spring(pen, x(x0), x(support), 26);
    ruler(pen, x, { from, to, height });
    if (y0 !== null) aside(pen, y0, width);
  }

  return {
    frame(found) {
      pending = false;
      last = found;
      const [a, b] = found.u.reduce(([p, q], v) => [Math.min(p, v), Math.max(q, v)], [Infinity, -Infinity]);
      const room = 0.1 * Math.max(b - a, 1e-3);
      const ease = b - a > high - low ? 1 : 0.1;
      low += ease * (a - room - low);
      high += ease * (b + room - high);
      draw();
    },
    /** Another run, with first and last time. */
    over(times) {
      const whole = span[1] - span[0];
      const part = whole > 1 ? (t - span[0]) / whole : 0;
      span = times;
      [time.min, time.max, time.step] = [span[0], span[1], (span[1] - span[0]) / 2000];
      go(span[0] + part * (span[1] - span[0]));
      request();
    },
    go(to) {
      go(to);
      request();
    },
    draw,
  };
}

function ground(pen, u, x, y, { from, to, width, height }) {
  pen.beginPath();
  u.forEach((v, n) => pen.lineTo(x(from + ((to - from) * n) / (u.length - 1)), y(v)));
  pen.strokeStyle = colour('--line');
  pen.lineWidth = 2;
  pen.stroke();
  pen.lineTo(width, height);
  pen.lineTo(0, height);
  pen.fillStyle = colour('--ground');
  pen.fill();
}

function probe(pen, x, y) {
  pen.fillStyle = colour('--tip');
  pen.beginPath();
  pen.moveTo(x - 13, y - 46);
  pen.lineTo(x + 13, y - 46);
  pen.quadraticCurveTo(x + 5, y - 2, x, y - 1);
  pen.quadraticCurveTo(x - 5, y - 2, x - 13, y - 46);
  pen.fill();
  pen.strokeStyle = colour('--tip');
  pen.lineWidth = 2;
  pen.beginPath();
  pen.moveTo(x, y - 46);
  pen.lineTo(x, 26);
  pen.stroke();
}

function spring(pen, from, to, y) {
  const turns = 12;
  pen.strokeStyle = colour('--ink');
  pen.lineWidth = 1.5;
  pen.beginPath();
  pen.moveTo(from, y);
  for (let n = 1; n < 2 * turns; n++) pen.lineTo(from + ((to - from) * n) / (2 * turns), y + (n % 2 ? -7 : 7));
  pen.lineTo(to, y);
  pen.stroke();
  pen.fillStyle = colour('--ink');
  pen.fillRect(to - 2, y - 14, 5, 28);
}

/** Distance of the tip from its line. */
function aside(pen, y0, width) {
  pen.fillStyle = colour('--ink');
  pen.font = '13px system-ui';
  pen.textAlign = 'right';
  pen.fillText(`y0 = ${y0.toFixed(2)} σ`.replace('-', '−'), width - 10, 18);
}

function ruler(pen, x, { from, to, height }) {
  pen.fillStyle = colour('--ink');
  pen.font = '11px system-ui';
  pen.textAlign = 'center';
  for (let v = Math.ceil(from / 5) * 5; v <= to; v += 5) {
    pen.fillRect(x(v), height - 18, 1, 5);
    if (v % 10 === 0) pen.fillText(`${v} σ`, x(v), height - 3);
  }
}
