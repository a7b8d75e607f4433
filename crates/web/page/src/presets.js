// Examples of motions. Values of α at onset are αc(r) as the program prints them.
import { usual } from './parameters.js';

const plain = { ...usual().run, r: 1, beta: 1, width: 1, start: 'steady' };
const AT_ONSET = 1.069036175; // αc(1), β = 1
const ROUND_AT_ONSET = 1.608057105; // the same for exp(−x²), the paper's round tip
/** Just above the threshold of this pitch, 0.80517; with this number of lines only ripples appear. */
const RIPPLES = { run: { ...plain, alpha: 0.9, beta: 0, kick: 0.1, until: 200 }, scan: { pitch: 1, lines: 96, length: 80, path: 'one-way' } };
/** Above α_y = 0.8305, where the line snakes, and below the onset of stick-slip. */
const SNAKE = { ...plain, alpha: 0.9, stiffness_across: 0.25, kick_across: 0.05, kick: 0, until: 600 };

export const PRESETS = [
  { name: 'Just above onset (Fig. 1)', run: { ...plain, alpha: AT_ONSET + 0.01, kick: 0.05, until: 457 } },
  { name: 'Just below onset (Fig. 1)', run: { ...plain, alpha: AT_ONSET - 0.01, kick: 0.5, until: 457 } },
  { name: 'Stick-slip', run: { ...plain, alpha: 1.2, kick: 0.05, until: 200 } },
  { name: 'A round tip (Fig. 4)', run: { ...plain, alpha: ROUND_AT_ONSET + 0.03, beta: 0, width: Math.SQRT1_2, kick: 0.1, until: 460 } },
  { name: 'Slow support (Fig. 5)', run: { ...plain, alpha: 1, r: 0.86, kick: 0.1, until: 300 } },
  { name: 'Period doubling', run: { ...plain, alpha: 1.62, kick: 0.1, until: 400 } },
  { name: 'Four slips', run: { ...plain, alpha: 2.35, r: 1.2, kick: 0.1, until: 300 } },
  { name: 'Trapped', run: { ...plain, alpha: 3.5, kick: 0.1, until: 400 } },
  { name: 'A surface that heals', run: { ...plain, alpha: 1.8, healing_time: 8, kick: 0.2, until: 200 } },
  { name: 'A depth limit', run: { ...plain, alpha: 2, depth_limit: 5, kick: 0.2, until: 200 } },
  { name: 'A heavy tip', run: { ...plain, alpha: 1.2, inertia: 0.3, kick: 0.05, until: 200 } },
  { name: 'A line that snakes', run: SNAKE },
  { name: 'Oblique ripples (raster)', ...RIPPLES },
];

/** The steps of the tour: a state of the page and one sentence each. */
export const TOUR = [
  {
    name: 'Steady sliding',
    text: 'Below the critical indentation rate αc the tip slides steadily in the groove that it makes.',
    state: { run: { ...plain, alpha: 0.9, kick: 0, until: 100 } },
  },
  {
    name: 'A kick below αc',
    text: 'A kick below αc = 1.069 makes the tip swing about its steady place, and the swing dies out.',
    state: { run: { ...plain, alpha: 0.9, kick: 0.5, until: 300 } },
  },
  {
    name: 'Stick-slip',
    text: 'Above αc the smallest kick grows until the tip sticks and slips, and its groove becomes a row of ripples.',
    state: { run: { ...plain, alpha: 1.2, kick: 0.05, until: 200 } },
  },
  {
    name: 'Ripples of a raster',
    text: 'Neighbouring scan lines act on each other: far below αc of a single line, oblique ripples grow from line to line.',
    state: { ...RIPPLES, show: 'rasters' },
  },
  {
    name: 'Across the scan',
    text: 'A tip on a spring that is soft across the scan leaves its line and snakes, before it would stick and slip.',
    state: { run: SNAKE, show: 'charts' },
  },
];
