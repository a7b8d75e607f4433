// What the page is about: the parameters, their ranges, and the address that tells them.

/** Sliders. `optional`: may be absent (null), which is the paper's law. `log`: the slider runs over decades. */
export const SLIDERS = [
  { name: 'alpha', sign: 'α', says: 'indentation rate', min: 0, max: 4, step: 0.005, usual: 1.2 },
  { name: 'r', sign: 'r', says: 'velocity of the support', min: 0.05, max: 2.5, step: 0.005, usual: 1 },
  { name: 'beta', sign: 'β', says: 'side lobes of the tip', min: 0, max: 1.5, step: 0.01, usual: 1 },
  { name: 'width', sign: 'w', says: 'width of the tip, σ', min: 0.4, max: 2, step: 0.01, usual: 1 },
  { name: 'depth_limit', sign: 'b', says: 'depth limit, kσ²/a', min: 0.2, max: 50, optional: true, log: true, usual: 5 },
  { name: 'healing_time', sign: 'T', says: 'healing time, Γ/k', min: 1, max: 1000, optional: true, log: true, usual: 50 },
  { name: 'kick', sign: 'D', says: 'kick, σ', min: -1, max: 1, step: 0.01, usual: 0.05 },
  { name: 'until', sign: 't', says: 'end of the run, Γ/k', min: 30, max: 2000, log: true, digits: 3, usual: 200 },
];

/** Sliders of the raster. */
export const SCAN_SLIDERS = [
  { name: 'pitch', sign: 'd', says: 'pitch of the lines, σ', min: 0.1, max: 3, step: 0.05, usual: 0.5 },
  { name: 'lines', sign: 'n', says: 'lines', min: 4, max: 200, step: 1, usual: 60 },
  { name: 'length', sign: 'X', says: 'length of a line, σ', min: 10, max: 100, step: 1, usual: 60 },
];

const STARTS = ['steady', 'flat'];
const PATHS = ['one-way', 'zigzag', 'repeat'];

export function usual() {
  const of = (sliders) => Object.fromEntries(sliders.map((s) => [s.name, s.optional ? null : s.usual]));
  return { run: { ...of(SLIDERS), start: 'steady' }, scan: { ...of(SCAN_SLIDERS), path: 'one-way' } };
}

/** `#alpha=1.2&r=1…`: what differs from the usual, and α and r always. */
export function address({ run, scan }) {
  const all = { ...run, ...scan };
  const plain = usual();
  const fixed = { ...plain.run, ...plain.scan };
  const told = Object.keys(fixed).filter((key) => key === 'alpha' || key === 'r' || all[key] !== fixed[key]);
  return '#' + told.map((key) => `${key}=${all[key] ?? 'none'}`).join('&');
}

/** What an address tells, and what in it is not understood. */
export function fromAddress(hash) {
  const found = usual();
  const strange = [];
  for (const [key, text] of new URLSearchParams(hash.replace(/^#/, ''))) {
    const part = key in found.run ? found.run : key in found.scan ? found.scan : null;
    const value = part && read(key, text);
    if (value === undefined || part === null) strange.push(`${key}=${text}`);
    else part[key] = value;
  }
  return { ...found, strange };
}

/** The value of a field as typed; undefined where it is none. */
export function read(key, text) {
  const word = text.trim();
  if (key === 'start') return STARTS.includes(word) ? word : undefined;
  if (key === 'path') return PATHS.includes(word) ? word : undefined;
  const slider = [...SLIDERS, ...SCAN_SLIDERS].find((s) => s.name === key);
  if (!slider) return undefined;
  if (slider.optional && (word === 'none' || word === '')) return null;
  const number = Number(word.replace('−', '-').replace(',', '.'));
  if (word === '' || !Number.isFinite(number)) return undefined;
  return key === 'lines' && !(Number.isInteger(number) && number > 0) ? undefined : number;
}
