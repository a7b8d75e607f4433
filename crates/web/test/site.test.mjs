// The book: no dead link, no missing picture, no request to another server.
import assert from 'node:assert/strict';
import { existsSync, readFileSync, readdirSync } from 'node:fs';
import { dirname, join, relative } from 'node:path';
import { test } from 'node:test';
import { launch, missing } from './browser.mjs';
import { root } from './program.mjs';

const site = join(root, 'target/site');
const skip = !existsSync(join(site, 'index.html')) && 'no book here: make site';
const pages = skip ? [] : readdirSync(site, { recursive: true }).filter((name) => name.endsWith('.html')).map((name) => join(site, name));
const kept = new Map();
const text = (file) => kept.get(file) ?? kept.set(file, readFileSync(file, 'utf8')).get(file);
/** Without the page, which is one file without links. */
const chapters = pages.filter((file) => !file.endsWith('/play.html') && !file.includes('/api/'));
/** Front pages of rustdoc, which checks its own links. Here they must need no network; our links to them are checked too. */
const fronts = pages.filter((file) => /\/api\/stickslip_[a-z]+\/index\.html$/.test(file));

const targets = (file) => [...text(file).matchAll(/\s(href|src)="([^"]*)"/g)].map(([, kind, target]) => ({ kind, target: target.replaceAll('&amp;', '&') }));
const isOutside = (target) => /^(https?:)?\/\//.test(target);

test('no link is dead and no picture missing', { skip }, () => {
  assert.ok(chapters.length > 20, `${chapters.length} pages`);
  const dead = [];
  for (const file of chapters) {
    for (const { target } of targets(file)) {
      if (isOutside(target) || /^(mailto|data|javascript):/.test(target)) continue;
      const [path, anchor] = target.split('#');
      let there = path ? join(dirname(file), decodeURIComponent(path.split('?')[0])) : file;
      if (there.endsWith('/')) there += 'index.html';
      // The page for missing addresses refers to the root of a server.
      if (file.endsWith('/404.html') && path.startsWith('/')) continue;
      if (!existsSync(there)) dead.push(`${relative(site, file)}: ${target}`);
      // In the page the part after # is a state, tested in parameters.test.mjs.
      else if (anchor && !there.endsWith('/play.html') && there.endsWith('.html') && !text(there).includes(`id="${decodeURIComponent(anchor)}"`)) dead.push(`${relative(site, file)}: ${target}`);
    }
  }
  assert.deepEqual(dead, []);
});

test('all equations are typeset', { skip }, () => {
  const left = chapters.filter((file) => /katex-error|\\frac|\\int(?!_)/.test(text(file).replaceAll(/<annotation[\s\S]*?<\/annotation>/g, '').replaceAll(/<code[\s\S]*?<\/code>/g, '')));
  assert.deepEqual(left.filter((file) => !file.endsWith('print.html')), []);
  // Markdown must not take a tilde over a letter for its own.
  for (const name of ['explanation/linear-theory', 'findings/corrections']) assert.ok(!/<del>/.test(text(join(site, `${name}.html`))), name);
  assert.ok(text(join(site, 'explanation/linear-theory.html')).match(/class="katex"/g).length > 100);
});

test('a browser makes no request for any page, and reports no error', { skip: skip || missing }, async () => {
  const browser = await launch();
  const page = await browser.newPage();
  const noted = [];
  page.on('request', (request) => /^(file|blob|data):/.test(request.url()) || noted.push(request.url()));
  // A request that the next page aborts has not failed.
  page.on('requestfailed', (request) => request.failure().errorText === 'net::ERR_ABORTED' || noted.push(`${request.url()} failed`));
  page.on('pageerror', (error) => noted.push(error.stack));
  assert.ok(fronts.length >= 10, `${fronts.length} libraries`);
  for (const file of [...chapters.filter((name) => !/404|print|toc/.test(name)), ...fronts]) await page.goto(`file://${file}`);
  await browser.close();
  assert.deepEqual(noted, []);
});

test('no code is cut off on the right', { skip: skip || missing }, async () => {
  const browser = await launch();
  const page = await browser.newPage();
  const cut = [];
  for (const width of [1400, 500]) {
    await page.setViewportSize({ width, height: 900 });
    for (const name of ['reference/commands', 'start', 'explanation/rasters', 'explanation/linear-theory']) {
      await page.goto(`file://${join(site, `${name}.html`)}`);
      const found = await page.evaluate(() => {
        const scrolls = (element) => /auto|scroll/.test(getComputedStyle(element).overflowX);
        const right = document.querySelector('main').getBoundingClientRect().right + 1;
        const blocks = [...document.querySelectorAll('main pre')];
        const isCut = (block) => block.getBoundingClientRect().right > right || ![block, ...block.querySelectorAll('code')].some((part) => scrolls(part) || part.scrollWidth <= part.clientWidth);
        const wide = blocks.filter((block) => block.scrollWidth > block.clientWidth || [...block.children].some((part) => part.scrollWidth > part.clientWidth));
        return { cut: blocks.filter(isCut).length, wide: wide.length };
      });
      // On a wide screen all of the help is visible.
      if (found.cut || (width === 1400 && name === 'reference/commands' && found.wide)) cut.push({ width, name, ...found });
    }
  }
  await browser.close();
  assert.deepEqual(cut, []);
});

test('the notices name the parts of the page and of the book', { skip }, () => {
  const notices = text(join(site, 'THIRD-PARTY-NOTICES.txt'));
  const locked = JSON.parse(readFileSync(join(root, 'crates/web/package-lock.json'), 'utf8')).packages;
  for (const name of ['katex', 'uplot', 'js-lzma']) assert.match(notices, new RegExp(`^${name} ${locked[`node_modules/${name}`].version}: `, 'm'));
  const crates = readFileSync(join(root, 'crates/web/Cargo.lock'), 'utf8');
  for (const name of ['wasm-bindgen', 'rustfft', 'serde_json']) {
    const version = new RegExp(`name = "${name}"\\nversion = "(.*)"`).exec(crates)[1];
    assert.ok(notices.includes(`\n${name} ${version}: `), name);
  }
});
