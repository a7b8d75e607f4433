// The path of a walker in the plane, with the orbits of theory.
import { colour, sharp } from './theme.js';

const MARGIN = 14;
const digits = (value, n = 7) => String(Number(value.toPrecision(n))).replace('-', '−');

/** The result in one sentence. */
export function sentence({ regime, speed, circle, orbits, interrupted, samples, remarks }) {
  const cut = interrupted ? `Cut off at t = ${digits(samples.t.at(-1), 6)}. ` : '';
  const round = circle ? ` of radius ${digits(circle.radius)} σ, ω = ${digits(circle.omega)} k/Γ` : '';
  const known = orbits?.length ? ` Circular orbits of theory: ${orbits.slice(0, 6).map((o) => `${digits(o.radius, 5)} σ${o.stable ? ' (stable)' : ''}`).join(', ')}.` : '';
  const notes = remarks.length ? ` ${remarks.join('; ')}.` : '';
  return `${cut}${regime}${round}, speed ${digits(speed)} kσ/Γ.${known}${notes}`;
}

export function walker({ canvas, status, code }, crew) {
  let found = null;
  let latestId = 0;
  const hands = crew({
    walked({ id, found: document, why }) {
      if (id !== latestId) return;
      if (why) return (status.textContent = why);
      found = document;
      status.textContent = sentence(found);
      status.dataset.found = JSON.stringify({ ...found, samples: undefined });
      code.textContent = found.command;
      canvas.setAttribute('aria-label', `Path of the walker: ${status.textContent}`);
      draw();
    },
    refused: ({ message }) => (status.textContent = message),
  });

  function draw() {
    const { pen, width, height } = sharp(canvas);
    if (!found) return;
    const { x0: x, y0: y } = found.samples;
    const ends = (list) => list.reduce(([a, b], v) => [Math.min(a, v), Math.max(b, v)], [Infinity, -Infinity]);
    const [[left, right], [low, high]] = [ends(x), ends(y)];
    const scale = Math.min((width - 2 * MARGIN) / Math.max(right - left, 1e-3), (height - 2 * MARGIN) / Math.max(high - low, 1e-3));
    const px = (v) => width / 2 + scale * (v - (left + right) / 2);
    const py = (v) => height / 2 - scale * (v - (low + high) / 2);
    for (const { radius, stable } of found.orbits ?? []) {
      pen.strokeStyle = colour('--faint');
      pen.setLineDash(stable ? [] : [3, 5]);
      pen.lineWidth = 0.8;
      pen.beginPath();
      pen.arc(px(0), py(0), scale * radius, 0, 7);
      pen.stroke();
    }
    pen.setLineDash([]);
    pen.strokeStyle = colour('--line');
    pen.lineWidth = 1.5;
    pen.beginPath();
    x.forEach((v, n) => pen.lineTo(px(v), py(y[n])));
    pen.stroke();
    pen.fillStyle = colour('--now');
    pen.beginPath();
    pen.arc(px(x.at(-1)), py(y.at(-1)), 4, 0, 7);
    pen.fill();
  }
  new ResizeObserver(draw).observe(canvas);
  return {
    draw,
    ask(parameters) {
      delete status.dataset.found;
      hands.ask({ kind: 'walk', id: ++latestId, parameters: JSON.stringify(parameters) });
    },
  };
}
