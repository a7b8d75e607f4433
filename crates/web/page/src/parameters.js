// The parameters of the page, their ranges, and the address that contains them.

/* global DECLARED */
/** Name and description of each parameter of the questions; `build.mjs` inserts them. */
const declared = typeof DECLARED === 'undefined' ? globalThis.DECLARED : DECLARED;

/**
 * Sliders. Name, unit and bounds of a parameter come from the description in its question (`of`), and `label` replaces a name of
 * one or two letters. Parameters of the tip's shape have no question and are described here. `optional`: may be absent (null),
 * as in the basic model. `log`: the slider runs over decades.
 */
export const SLIDERS = [
  { name: 'alpha', of: 'run', sign: 'α', label: 'indentation rate', min: 0, max: 4, step: 0.005, usual: 1.2 },
  { name: 'r', of: 'run', sign: 'r', label: 'velocity of the support', min: 0.05, max: 2.5, step: 0.005, usual: 1 },
  { name: 'beta', sign: 'β', label: 'side lobes of the tip', min: 0, max: 1.5, step: 0.01, usual: 1 },
  { name: 'width', sign: 'w', label: 'width of the tip', unit: 'σ', min: 0.4, max: 2, step: 0.01, usual: 1 },
  { name: 'depth_limit', of: 'run', sign: 'b', min: 0.2, max: 50, optional: true, log: true, usual: 5 },
  { name: 'healing_time', of: 'run', sign: 'T', min: 1, max: 1000, optional: true, log: true, usual: 50 },
  { name: 'inertia', of: 'run', sign: 'M', min: 0.01, max: 10, optional: true, log: true, usual: 0.3 },
  { name: 'stiffness_across', of: 'run', sign: 'κ_y', min: 0.1, max: 30, optional: true, log: true, usual: 0.25 },
  { name: 'kick', of: 'run', sign: 'D', min: -1, max: 1, step: 0.01, usual: 0.05 },
  { name: 'kick_across', of: 'run', sign: 'D_y', min: -1, max: 1, step: 0.01, usual: 0.05 },
  { name: 'until', of: 'run', sign: 't', label: 'end of the run', min: 30, max: 2000, log: true, digits: 3, usual: 200 },
].map(spelt);

/** Sliders of the raster. */
export const SCAN_SLIDERS = [
  { name: 'pitch', of: 'raster', sign: 'd', label: 'pitch of the lines', min: 0.1, max: 3, step: 0.05, usual: 1 },
  { name: 'lines', of: 'raster', sign: 'n', min: 4, max: 200, step: 1, usual: 96 },
  { name: 'length', of: 'raster', sign: 'X', label: 'length of a line', min: 10, max: 100, step: 1, usual: 80 },
].map(spelt);

/** Sliders of the walker; in addresses their names begin with `walker_`. */
export const WALKER_SLIDERS = [
  { name: 'alpha', of: 'walker', sign: 'α', label: 'force of the field', min: -10, max: -0.1, step: 0.1, usual: -3 },
  { name: 'healing_time', of: 'walker', sign: 'T', label: 'memory', min: 0.5, max: 30, log: true, usual: 1 },
  { name: 'inertia', of: 'walker', sign: 'M', min: 0.01, max: 10, optional: true, log: true, usual: 0.3 },
  { name: 'rotation', of: 'walker', sign: 'Ω', min: 0.01, max: 2, optional: true, log: true, usual: 0.3 },
  { name: 'trap', of: 'walker', sign: 'K', min: 0.001, max: 1, optional: true, log: true, usual: 0.05 },
  { name: 'start_position', of: 'walker', sign: 'X', min: 0, max: 30, step: 0.1, optional: true, usual: 2.5 },
  { name: 'kick_across', of: 'walker', sign: 'D_y', min: -1, max: 1, step: 0.01, usual: 0.05 },
  { name: 'until', of: 'walker', sign: 't', label: 'end of the run', min: 10, max: 2000, log: true, usual: 200 },
].map((slider) => ({ ...spelt(slider), name: `walker_${slider.name}` }));

/** A slider with the name, unit and description of its parameter. */
function spelt({ label, ...slider }) {
  if (!slider.of) return { ...slider, label };
  const found = declared[slider.of].find(({ name }) => name === slider.name);
  if (!found) throw new Error(`${slider.of} has no parameter ${slider.name}`);
  const { description } = found;
  return { ...slider, label: label ?? slider.name.replaceAll('_', ' '), unit: unitOf(description), least: leastOf(description), description };
}
/** The unit in a description such as “Healing time T: …; in Γ/k, above 0”; undefined for pure numbers. */
export function unitOf(description) {
  return /\b[iI]n (?:units of )?((?:σ|Γ|k)[^\s,;.:]*)/.exec(description)?.[1];
}
/** The lower bound in a description: `{ value, included }`, or null. */
export function leastOf(description) {
  const above = /(?<!or )\babove (-?[\d.]*\d)/.exec(description);
  const orAbove = /(-?[\d.]*\d) or above/.exec(description);
  return orAbove ? { value: Number(orAbove[1]), included: true } : above ? { value: Number(above[1]), included: false } : null;
}

const STARTS = ['steady', 'flat'];
const PATHS = ['one-way', 'zigzag', 'repeat'];
/** Sections that an address can scroll to. */
export const PLACES = ['charts', 'phases', 'rasters', 'walkers'];

const part = (values, sliders) => Object.fromEntries(sliders.map((s) => [s.name, values(s)]));
export function usual() {
  const of = (sliders) => part((s) => (s.optional ? null : s.usual), sliders);
  return { run: { ...of(SLIDERS), start: 'steady' }, scan: { ...of(SCAN_SLIDERS), path: 'one-way' }, walk: of(WALKER_SLIDERS) };
}

/** The walker's parameters by the names of its question. */
export const walkerOf = (walk) => Object.fromEntries(Object.entries(walk).filter(([, value]) => value !== null).map(([name, value]) => [name.slice('walker_'.length), value]));

/** `#alpha=1.2&r=1…`: α, r and all values that differ from the defaults; `show` is a section to scroll to. */
export function address({ run, scan, walk, show }) {
  const plain = usual();
  const all = { ...plain.run, ...plain.scan, ...plain.walk, ...run, ...scan, ...walk };
  const fixed = { ...plain.run, ...plain.scan, ...plain.walk };
  const written = Object.keys(fixed).filter((key) => key === 'alpha' || key === 'r' || all[key] !== fixed[key]);
  return '#' + [...written.map((key) => `${key}=${all[key] ?? 'none'}`), ...(show ? [`show=${show}`] : [])].join('&');
}

/** The state in an address, and the parts of it that are not understood. */
export function fromAddress(hash) {
  const found = usual();
  const strange = [];
  let show = null;
  for (const [key, text] of new URLSearchParams(hash.replace(/^#/, ''))) {
    if (key === 'show' && PLACES.includes(text)) {
      show = text;
      continue;
    }
    const part = [found.run, found.scan, found.walk].find((values) => Object.hasOwn(values, key));
    const value = part && read(key, text);
    if (value === undefined || part === undefined) strange.push(`${key}=${text}`);
    else part[key] = value;
  }
  return { ...found, show, strange };
}

/** The value of a field as typed; undefined if it is not valid. */
export function read(key, text) {
  const word = text.trim();
  if (key === 'start') return STARTS.includes(word) ? word : undefined;
  if (key === 'path') return PATHS.includes(word) ? word : undefined;
  const slider = [...SLIDERS, ...SCAN_SLIDERS, ...WALKER_SLIDERS].find((s) => s.name === key);
  if (!slider) return undefined;
  if (slider.optional && (word === 'none' || word === '')) return null;
  const number = Number(word.replace('−', '-').replace(',', '.'));
  if (word === '' || !Number.isFinite(number)) return undefined;
  return key === 'lines' && !(Number.isInteger(number) && number > 0) ? undefined : number;
}
