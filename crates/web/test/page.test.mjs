// The page in a browser, compared with the program.
import assert from 'node:assert/strict';
import { readFileSync, mkdirSync } from 'node:fs';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { gzipSync } from 'node:zlib';
import { fact, file, launch, median, missing, open, settled } from './browser.mjs';
import { document, folder, model, root, run } from './program.mjs';

const skip = missing;
const shots = join(root, 'target/site-shots');
let browser;
before(async () => {
  mkdirSync(shots, { recursive: true });
  if (!skip) browser = await launch();
});
after(() => browser?.close());

const command = (page) => page.locator('#command').innerText();
const close = (a, b, tolerance, what) =>
  assert.ok(Math.abs(a - b) <= tolerance * Math.max(1, Math.abs(b)), `${what}: ${a} in the page, ${b} by the program`);

/** The largest differences between the samples shown and those of the program. */
async function difference(page) {
  const { samples } = document(await command(page));
  const columns = await page.evaluate(() => window.stickslip.columns().map((column) => [...column]));
  const names = ['t', 'l', 'velocity', 'lag', 'x0', ...(samples.y0 ? ['y0'] : [])];
  assert.equal(columns[0].length, samples.t.length);
  const largest = (name, n) => Math.max(...samples[name].map((value, i) => Math.abs(value - columns[n][i])));
  return Object.fromEntries(names.map((name, n) => [name, largest(name, n)]));
}

test('the page is one file of at most 700 kB, compressed', { skip }, () => {
  const size = gzipSync(readFileSync(file)).length;
  assert.ok(size <= 700e3, `${size} bytes gzipped`);
  console.log(`gzipped: ${size} bytes`);
});

test('it is ready within 2.5 s, without messages on the console', { skip }, async () => {
  const { page, noted, took } = await open(browser);
  console.log(`ready after ${took} ms`);
  assert.ok(took <= 2500, `${took} ms`);
  assert.deepEqual(noted, []);
  await page.context().close();
});

test('nothing may be loaded, and a run that takes too long is cut off with a message', { skip }, async () => {
  const context = await browser.newContext();
  const page = await context.newPage();
  await page.goto(`file://${file}#alpha=100&r=20&width=0.1&depth_limit=0.001&until=20000`);
  await page.waitForFunction(() => document.body.dataset.ready, null, { timeout: 20_000 });
  assert.match(await page.locator('#summary').innerText(), /^Cut off at t = [0-9.]+: the page computes for 4 seconds/);
  const policy = await page.locator('meta[http-equiv="Content-Security-Policy"]').getAttribute('content');
  assert.match(policy, /default-src 'none'; script-src 'sha256-[^']+' 'wasm-unsafe-eval'; worker-src blob:/);
  const fetched = await page.evaluate(() => fetch('data:,x').then(() => true, () => false));
  assert.equal(fetched, false);
  // A slow computation does not delay the next request.
  await page.evaluate(() => (location.hash = '#alpha=1.2&r=1'));
  await page.waitForFunction(() => document.body.dataset.ready === String(window.stickslip.latestId()), null, { timeout: 10_000 });
  await context.close();
});

test('samples are those of the program, to the last bit', { skip }, async () => {
  const { page, noted } = await open(browser);
  const presets = page.locator('#presets button');
  for (let n = 0; n < (await presets.count()); n++) {
    await presets.nth(n).click();
    await settled(page);
    const [name, line] = [await presets.nth(n).innerText(), await command(page)];
    const off = await difference(page);
    console.log(name, JSON.stringify(off));
    for (const key of ['t', 'l', 'lag', 'x0']) assert.equal(off[key], 0, `${name}: ${key} differs by ${off[key]}`);
    const theory = document(`stickslip stability ${model(line)} --roots 6`);
    assert.equal(await fact(page, 'critical') === null, theory.critical === null, name);
    if (theory.critical) close(await fact(page, 'critical'), theory.critical.alpha, 1e-9, `${name}: critical α`);
    const roots = (await fact(page, 'roots')) ?? [];
    assert.equal(roots.length, theory.roots.length, name);
    roots.forEach((z, i) => close(z.re, theory.roots[i].re, 1e-9, `${name}: exponent`));
  }
  assert.deepEqual(noted, []);
  await page.context().close();
});

test('cycles and their multipliers are those of the program, to 1e-9', { skip }, async () => {
  for (const hash of ['#alpha=1.2&r=1', '#alpha=1.62&r=1', '#alpha=1.7&r=1.1&beta=0.9']) {
    const { page } = await open(browser, {}, hash);
    const cycle = document(`stickslip cycle ${model(await command(page))}`);
    close(await fact(page, 'cycle'), cycle.period, 1e-9, 'period');
    close(await fact(page, 'cycle-amplitude'), cycle.amplitude_x0, 1e-9, 'amplitude');
    const multipliers = await fact(page, 'multipliers');
    multipliers.forEach((z, i) => close(z.re, cycle.floquet[i].re, 1e-9, 'multiplier'));
    const end = document(await command(page));
    if (end.oscillation) close(await fact(page, 'period'), end.oscillation.period, 1e-9, 'period of the run');
    await page.context().close();
  }
});

test('every slider changes its parameter, by keys too, and takes any number', { skip }, async () => {
  const { page, noted } = await open(browser);
  for (const box of ['depth_limit', 'healing_time', 'inertia', 'stiffness_across']) await page.locator(`#${box}-there`).check();
  await settled(page);
  for (const slider of await page.locator('#sliders input[type=range]').all()) {
    const id = await slider.getAttribute('id');
    const was = await page.evaluate((name) => window.stickslip.state().run[name], id);
    await slider.focus();
    await page.keyboard.press('ArrowRight');
    await page.keyboard.press('ArrowRight');
    await settled(page);
    const is = await page.evaluate((name) => window.stickslip.state().run[name], id);
    assert.ok(is > was, `${id}: ${was} to ${is}`);
    assert.ok((await command(page)).includes(` ${is}`), `${id} in ${await command(page)}`);
    await page.locator(`#${id}-number`).fill(String(was));
    await settled(page);
    assert.equal(await page.evaluate((name) => window.stickslip.state().run[name], id), was);
  }
  await page.locator('#start').selectOption('flat');
  await settled(page);
  const off = await difference(page);
  assert.ok(off.l <= 1e-9, `with b, T, M, κ_y and a flat start l differs by ${off.l}`);
  assert.deepEqual(noted, []);
  await page.context().close();
});

test('wrong input is reported', { skip }, async () => {
  const { page, noted } = await open(browser, {}, '#alpha=1.2&r=1&colour=red&kick=much');
  assert.match(await page.locator('#strange').innerText(), /colour=red, kick=much/);
  const field = page.locator('#alpha-number');
  await field.fill('1.2x');
  assert.equal(await field.getAttribute('aria-invalid'), 'true');
  assert.match(await page.locator('#alpha-why').innerText(), /1\.2x/);
  for (const [name, text, words] of [['alpha', '-1', /alpha .* 0 or above/], ['r', '0', /velocity r .* above 0/], ['until', '1e6', /computes up to t/], ['width', '0', /width/]]) {
    await page.locator(`#${name}-number`).fill(text);
    await page.locator('#error').filter({ hasText: words }).waitFor();
    await page.locator(`#${name}-number`).fill('40');
    await page.locator('#error').waitFor({ state: 'hidden' });
    await page.locator(`#${name}-number`).fill('1');
    if (name === 'until') await page.locator('#until-number').fill('60');
  }
  assert.deepEqual(noted, []);
  await page.context().close();
});

test('a slider redraws within 16 ms, in the median', { skip }, async () => {
  const { page } = await open(browser);
  const times = await page.evaluate(async () => {
    const slider = document.getElementById('alpha');
    const times = [];
    for (let n = 0; n < 101; n++) {
      const before = window.stickslip.redraws.length;
      slider.value = 1.1 + 0.005 * (n % 100);
      slider.dispatchEvent(new Event('input'));
      while (window.stickslip.redraws.length === before) await new Promise((go) => setTimeout(go, 1));
      times.push(window.stickslip.redraws.at(-1));
    }
    return times;
  });
  console.log(`redraw: median ${median(times).toFixed(1)} ms, largest ${Math.max(...times).toFixed(1)} ms`);
  assert.ok(median(times) <= 16, `median ${median(times)} ms`);
  await page.context().close();
});

test('the page responds during a run to t = 2,000', { skip }, async () => {
  const { page, noted } = await open(browser, {}, '#alpha=1.62&r=1&kick=0.1');
  const longest = await page.evaluate(async () => {
    const field = document.getElementById('until-number');
    const before = window.stickslip.redraws.length;
    let [last, longest] = [performance.now(), 0];
    field.value = '2000';
    field.dispatchEvent(new Event('input'));
    while (window.stickslip.redraws.length === before) {
      await new Promise((go) => setTimeout(go, 0));
      longest = Math.max(longest, performance.now() - last);
      last = performance.now();
    }
    return { gap: longest, run: window.stickslip.redraws.at(-1) };
  });
  console.log(`a run to t = 2,000: ${longest.run.toFixed(0)} ms, longest pause of the page ${longest.gap.toFixed(0)} ms`);
  assert.ok(longest.gap <= 100, `${longest.gap} ms`);
  assert.deepEqual(noted, []);
  await page.context().close();
});

test('the map is clicked, walked and zoomed, and has the regimes of a sweep', { skip }, async () => {
  const { page, noted } = await open(browser);
  const map = page.locator('#map');
  await map.click({ position: { x: 200, y: 150 } });
  await settled(page);
  const at = await page.evaluate(() => window.stickslip.state().run);
  assert.ok(at.r > 0.3 && at.r < 1.9 && at.alpha > 1.2 && at.alpha < 3.5, JSON.stringify(at));
  await page.locator('#alpha-number').fill('1.55');
  await page.locator('#r-number').fill('1');
  await map.focus();
  for (const key of ['ArrowUp', 'ArrowRight']) await page.keyboard.press(key);
  await settled(page);
  const moved = await page.evaluate(() => window.stickslip.state().run);
  assert.ok(moved.r > 1 && moved.alpha > 1.55);
  await page.locator('#zoom-in').click();
  await map.focus();
  await page.keyboard.press('+');
  await page.waitForTimeout(200);
  await page.waitForFunction(() => document.getElementById('map').dataset.mapped, null, { timeout: 300_000 });
  const { r, alpha, classes } = await page.evaluate(() => window.stickslip.map());
  for (const [i, j] of [[5, 5], [20, 40], [32, 32], [50, 20], [60, 60]]) {
    const [point] = document(`stickslip sweep --r ${r[i]} --alpha ${alpha[j]}`).points;
    const slips = Math.min(Math.max(point.slips ?? 0, 1), 3);
    const kind = { steady: 0, 'stick-slip': slips, trapped: 4, transient: 5 }[point.regime];
    assert.equal(classes[i][j], kind, `r = ${r[i]}, α = ${alpha[j]}`);
  }
  await page.locator('#map').screenshot({ path: join(shots, 'zoomed.png') });
  await page.keyboard.press('0');
  await page.mouse.wheel(0, -200);
  await page.locator('#zoom-out').click();
  await page.locator('#zoom-whole').click();
  assert.deepEqual(noted, []);
  await page.context().close();
});

test('a raster grows, can be stopped, and ends as the program ends it', { skip }, async () => {
  const { page, noted } = await open(browser, {}, '#alpha=0.5&r=1&beta=0&pitch=0.5&lines=200&length=60');
  await page.locator('#scan').click();
  await page.locator('#raster-status').filter({ hasText: /Line [2-9]/ }).waitFor();
  await page.locator('#scan').click();
  await page.locator('#raster-status').filter({ hasText: /^Stopped\.$/ }).waitFor();
  await page.locator('#lines-number').fill('60');
  for (const name of ['pitch', 'lines', 'length']) {
    await page.locator(`#${name}`).focus();
    await page.keyboard.press('ArrowRight');
  }
  for (const path of ['zigzag', 'one-way']) await page.locator('#path').selectOption(path);
  await page.locator('#scan').click();
  await page.waitForFunction(() => document.getElementById('raster-status').dataset.found, null, { timeout: 120_000 });
  const found = JSON.parse(await page.locator('#raster-status').getAttribute('data-found'));
  const { regime, pattern } = document(found.command);
  assert.equal(found.regime, regime);
  for (const key of ['q', 'kappa', 'wavelength', 'crest_angle', 'coherence', 'amplitude']) {
    if (pattern[key] === null) assert.equal(found.pattern[key], null, key);
    else close(found.pattern[key], pattern[key], 1e-9, key);
  }
  await page.locator('#lines-number').fill('1000');
  await page.locator('#scan').click();
  await page.locator('#raster-status').filter({ hasText: /up to 400 lines/ }).waitFor();
  assert.deepEqual(noted, []);
  await page.context().close();
});

test('a walker has the circle and the orbits of the program', { skip }, async () => {
  const { page, noted } = await open(browser, {}, '#alpha=1.2&r=1&walker_rotation=0.3&show=walkers');
  await page.waitForFunction(() => document.getElementById('walker-status').dataset.found, null, { timeout: 60_000 });
  const found = JSON.parse(await page.locator('#walker-status').getAttribute('data-found'));
  const { regime, circle, orbits } = document(await page.locator('#walker-command').innerText());
  assert.deepEqual([found.regime, regime], ['circling', 'circling']);
  for (const key of ['radius', 'omega']) {
    close(found.circle[key], circle[key], 1e-9, key);
    close(found.orbits[0][key], orbits[0][key], 1e-9, `${key} of theory`);
  }
  await page.locator('#walkers').screenshot({ path: join(shots, 'walker.png') });
  assert.deepEqual(noted, []);
  await page.context().close();
});

test('the five steps of the tour show the motions that they name', { skip }, async () => {
  const { page, noted } = await open(browser);
  const next = page.locator('#tour-next');
  for (const [i, regime] of ['steady', 'steady', 'stick-slip', null, 'snaking'].entries()) {
    await next.click();
    // The address changes after the click: until then the page is settled at the step before.
    await page.locator('#tour-text').filter({ hasText: `${i + 1} of 5` }).waitFor();
    await settled(page);
    if (regime) assert.equal(await fact(page, 'regime'), regime);
    else await page.locator('#raster-status').filter({ hasText: /Line [2-9]|lines\. ripples/ }).waitFor();
  }
  assert.ok(await next.isHidden());
  assert.ok(await page.locator('#chart-y').isVisible());
  await page.screenshot({ path: join(shots, 'tour.png'), fullPage: true });
  assert.deepEqual(noted, []);
  await page.context().close();
});

test('saved documents are read by the program, and a link restores the state', { skip }, async () => {
  const { page } = await open(browser, {}, '#alpha=1.3&r=0.9&beta=0.8&healing_time=40&kick=0.2&until=77');
  for (const [button, kind] of [['#save-run', 'surface'], ['#save-cycle', 'plot']]) {
    const [download] = await Promise.all([page.waitForEvent('download'), page.locator(button).click()]);
    const path = join(folder, `saved-${kind}.json`);
    await download.saveAs(path);
    if (kind === 'surface') run('surface', path, '--at', '70', '--range', '20:60', '--spacing', '0.5', '-o', join(folder, 'u.csv'));
    else run('plot', path, '-o', join(folder, 'cycle.svg'));
  }
  await page.waitForTimeout(300);
  const hash = await page.evaluate(() => location.hash);
  const [mine, line] = [await page.evaluate(() => window.stickslip.state()), await command(page)];
  const again = await open(browser, {}, hash);
  assert.deepEqual(await again.page.evaluate(() => window.stickslip.state()), mine);
  assert.equal(await command(again.page), line);
  await page.context().close();
  await again.page.context().close();
});

test('screen readers get names and results, and the page fits a phone', { skip }, async () => {
  const { page } = await open(browser, { viewport: { width: 390, height: 844 }, isMobile: true, hasTouch: true, deviceScaleFactor: 2 });
  const nameless = await page.evaluate(() => [...document.querySelectorAll('input, select, button, canvas, [role=img]')]
    .filter((e) => !(e.closest('[role=img]:not(canvas)') && e.matches('canvas')))
    .filter((e) => !(e.labels?.length || e.getAttribute('aria-label') || e.textContent.trim())).map((e) => e.outerHTML));
  assert.deepEqual(nameless, []);
  assert.match(await page.locator('#summary').innerText(), /stick-slip, period 7\.06736/);
  assert.match(await page.locator('#chart-l').getAttribute('aria-label'), /from .* to /);
  const [wide, seen] = await page.evaluate(() => [document.documentElement.scrollWidth, document.documentElement.clientWidth]);
  assert.ok(wide <= seen, `${wide} of ${seen} pixels wide`);
  await page.screenshot({ path: join(shots, 'phone.png'), fullPage: true });
  await page.context().close();
});

test('screenshots, light and dark', { skip }, async () => {
  for (const colorScheme of ['light', 'dark']) {
    const { page, noted } = await open(browser, { colorScheme }, '#alpha=0.5&r=1&beta=0&pitch=0.5&lines=60&length=60');
    await page.locator('#scan').click();
    await page.waitForFunction(() => document.getElementById('raster-status').dataset.found, null, { timeout: 120_000 });
    await page.locator('#presets button').nth(5).click();
    await settled(page);
    await page.waitForTimeout(800);
    await page.screenshot({ path: join(shots, `${colorScheme}.png`), fullPage: true });
    assert.deepEqual(noted, []);
    await page.context().close();
  }
});
