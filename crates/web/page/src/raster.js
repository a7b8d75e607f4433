// A raster, growing line by line.
import { colour, sharp } from './theme.js';

/** Dark below, light above. */
const SHADES = [[24, 20, 64], [62, 73, 137], [38, 130, 142], [53, 183, 121], [181, 222, 43], [253, 231, 150]];

function shade(part) {
  const place = Math.min(Math.max(part, 0), 1) * (SHADES.length - 1);
  const n = Math.min(Math.floor(place), SHADES.length - 2);
  return SHADES[n].map((from, c) => from + (SHADES[n + 1][c] - from) * (place - n));
}

export function raster({ canvas, button, status, scale }, crew, state) {
  let rows = [];
  let columns = 0;
  let running = false;
  let total = 1;
  let shown = null; // the scan that is drawn
  const sheet = document.createElement('canvas');
  let late = false;

  function draw() {
    late = false;
    const { pen, width, height } = sharp(canvas);
    if (!rows.length) return hint(pen, width, height);
    const [low, high] = rows.reduce((ends, row) => row.reduce(([a, b], v) => [Math.min(a, v), Math.max(b, v)], ends), [Infinity, -Infinity]);
    const image = new ImageData(columns, rows.length);
    rows.forEach((row, n) => row.forEach((v, i) => {
      const place = 4 * ((rows.length - 1 - n) * columns + i);
      const [red, green, blue] = shade((v - low) / (high - low || 1));
      image.data.set([red, green, blue, 255], place);
    }));
    Object.assign(sheet, { width: columns, height: rows.length });
    sheet.getContext('2d').putImageData(image, 0, 0);
    const area = within(width, height);
    const tall = Math.min(1, rows.length / area.rows) * area.height;
    pen.drawImage(sheet, (width - area.width) / 2, (height + area.height) / 2 - tall, area.width, tall);
    const axis = area.isEqual ? 'both axes to one scale' : 'one row for each time along the same line';
    scale.textContent = `u from ${low.toPrecision(3)} (dark) to ${high.toPrecision(3)} kσ²/a (light); lines from below, ${axis}`;
  }
  /** The size of the picture: one scale along and across, so that angles are true; repeated lines have no axis across. */
  function within(width, height) {
    const { lines, pitch, length, path } = shown;
    if (path === 'repeat') return { width, height, rows: lines, isEqual: false };
    const scale = Math.min(width / length, height / ((lines - 1) * pitch || 1));
    return { width: scale * length, height: Math.max(scale * (lines - 1) * pitch, 1), rows: 2 * lines - 1, isEqual: true };
  }
  function hint(pen, width, height) {
    pen.fillStyle = colour('--faint');
    pen.font = '14px system-ui';
    pen.textAlign = 'center';
    pen.fillText('The surface will grow here, line by line.', width / 2, height / 2);
  }
  /** Draws at the next frame, once. */
  const soon = () => {
    if (!late) requestAnimationFrame(draw);
    late = true;
  };
  function stop(words) {
    running = false;
    button.textContent = 'Scan';
    status.textContent = words;
  }
  const hands = crew({
    line({ line, row, columns: wide, heights }) {
      columns = wide;
      for (let n = 0; n * wide < heights.length; n++) rows[row + n] = heights.subarray(n * wide, (n + 1) * wide);
      status.textContent = `Line ${line} of ${total}`;
      soon();
    },
    scanned({ found, why }) {
      if (why) return stop(why);
      const { regime, pattern: p, remarks, command } = found;
      const of = (name, unit) => p?.[name] == null ? [] : [`${p[name].toPrecision(3)} ± ${p[`${name}_error`].toPrecision(2)}${unit}`];
      const parts = [
        regime,
        ...of('wavelength', ' σ').map((words) => `wavelength ${words}`),
        ...of('crest_angle', '°').map((words) => `crests at ${words} to the lines`),
        ...(p ? [`coherence ${p.coherence.toPrecision(3)}`] : []),
      ];
      const words = [parts.join(', '), ...remarks].join('; ');
      status.dataset.found = JSON.stringify(found);
      stop(`${total} lines. ${words}. `);
      const code = document.createElement('code');
      code.textContent = command;
      status.append(code);
      canvas.setAttribute('aria-label', `Surface after ${total} lines: ${words}`);
    },
    refused: ({ message }) => stop(message),
  });
  const halt = (words) => {
    hands.end();
    stop(words);
  };
  function begin() {
    if (running) hands.end();
    const { run, scan } = state();
    [rows, running, total, shown] = [[], true, scan.lines, { ...scan }];
    delete status.dataset.found;
    button.textContent = 'Stop';
    status.textContent = 'Line 1 …';
    draw();
    hands.ask({ kind: 'scan', parameters: JSON.stringify(run), scan: JSON.stringify(scan) });
  }
  button.addEventListener('click', () => (running ? halt('Stopped.') : begin()));
  new ResizeObserver(draw).observe(canvas);
  return { draw, begin };
}
