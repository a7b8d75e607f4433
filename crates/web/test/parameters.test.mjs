// Sliders, addresses, the tour and the links of chapters, without a browser.
import assert from 'node:assert/strict';
import { test } from 'node:test';

/** Descriptions of every parameter with a slider, as in its question; tests in a browser use those of the module. */
const of = (texts) => Object.entries(texts).map(([name, description]) => ({ name, description }));
globalThis.DECLARED = {
  run: of({
    alpha: 'Dimensionless indentation rate α = Γ N a/(σ² k²), (13); 0 or above with a spring.',
    r: 'Dimensionless support velocity r = Γ v0/(k σ), (12); above 0, and 0 without a spring.',
    depth_limit: 'Depth limit b of (61), in kσ²/a; above 0: the tip indents at the rate α exp(-|u|/b).',
    healing_time: 'Healing time T: the surface relaxes as exp(-t/T); in Γ/k, above 0.',
    inertia: 'Inertia M of the tip, in Γ²/k; above 0.',
    stiffness_across: 'κ_y, the spring constant across the scan over that along it; above 0.',
    kick: 'D: the tip starts at X - D, in σ, which increases l by D.',
    kick_across: 'Initial distance of the tip from its line, in σ, if it is free to move across the scan; 0 by default.',
    until: 'Time at which the run ends, in Γ/k.',
  }),
  raster: of({ pitch: 'Distance of the lines, in σ; null if all lines coincide.', lines: 'Number of lines.', length: 'X: distance that the support moves along each line, in σ.' }),
  walker: of({
    alpha: 'α, below 0 for a particle that its field drives.',
    healing_time: 'T, the time in which the field decays by a factor e, in Γ/k; above 0.',
    inertia: 'Inertia M of the particle, in Γ²/k; above 0.',
    rotation: 'Ω of a walker in a rotating frame: the Coriolis force -Ω ẑ × x\' acts on it. In units of Γ.',
    trap: 'K of a walker in a harmonic trap about the origin, in units of k; 0 or above.',
    start_position: 'X: the particle starts at (X, 0), in σ.',
    kick_across: 'Displacement of the particle, but not of its field, along y, in σ.',
    until: 'Time at which the run ends, in Γ/k; it starts at 0.',
  }),
};
const { SLIDERS, SCAN_SLIDERS, WALKER_SLIDERS, address, fromAddress, leastOf, unitOf, usual, walkerOf } = await import('../page/src/parameters.js');
const { PRESETS, TOUR } = await import('../page/src/presets.js');
const { STATES } = await import('../book/states.mjs');

test('units and bounds are those of the questions', () => {
  const unit = (sliders, name) => sliders.find((slider) => slider.name === name).unit;
  assert.deepEqual(['alpha', 'depth_limit', 'healing_time', 'inertia', 'stiffness_across', 'kick'].map((name) => unit(SLIDERS, name)), [undefined, 'kσ²/a', 'Γ/k', 'Γ²/k', undefined, 'σ']);
  assert.equal(unit(WALKER_SLIDERS, 'walker_trap'), 'k');
  assert.equal(unitOf('Number of lines.'), undefined);
  assert.deepEqual(leastOf('in Γ/k, above 0.'), { value: 0, included: false });
  assert.deepEqual(leastOf('in units of k; 0 or above.'), { value: 0, included: true });
  for (const { name, min, least } of [...SLIDERS, ...SCAN_SLIDERS, ...WALKER_SLIDERS]) {
    if (least) assert.ok(least.included ? min >= least.value : min > least.value, `${name} from ${min}`);
  }
});

test('an address restores its state', () => {
  for (const { run, scan } of PRESETS) {
    const state = { ...usual(), run, scan: { ...usual().scan, ...scan } };
    const { strange, show, ...found } = fromAddress(address(state));
    assert.deepEqual([found, strange, show], [state, [], null]);
  }
  const { walk } = fromAddress('#walker_trap=0.05&walker_alpha=-4');
  assert.deepEqual([walkerOf(walk).trap, walkerOf(walk).alpha, 'rotation' in walkerOf(walk)], [0.05, -4, false]);
  assert.deepEqual(fromAddress('#colour=red&kick=much&show=nothing').strange, ['colour=red', 'kick=much', 'show=nothing']);
});

test('the tour has five steps of one sentence, and chapters lead to states that are understood', () => {
  assert.equal(TOUR.length, 5);
  for (const { text, state } of TOUR) {
    assert.match(text, /^[A-Z][^.]*(\.\d[^.]*)*\.$/, text);
    assert.deepEqual(fromAddress(address(state)).strange, []);
  }
  for (const [file, [, state]] of Object.entries(STATES)) assert.deepEqual(fromAddress(state).strange, [], file);
});
