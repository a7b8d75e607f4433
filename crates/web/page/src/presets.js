// Motions worth seeing. Values of α at onset are αc(r) as the program prints them.

const plain = { r: 1, beta: 1, width: 1, depth_limit: null, healing_time: null, start: 'steady' };
const AT_ONSET = 1.069036175; // αc(1), β = 1
const ROUND_AT_ONSET = 1.608057105; // the same for exp(−x²), the paper's round tip

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
  {
    name: 'Oblique ripples (raster)',
    run: { ...plain, alpha: 0.9, beta: 0, kick: 0.1, until: 200 },
    scan: { pitch: 1, lines: 80, length: 60, path: 'one-way' },
  },
];
