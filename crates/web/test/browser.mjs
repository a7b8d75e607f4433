// A browser with the page.
import { existsSync } from 'node:fs';
import { join } from 'node:path';
import { chromium } from 'playwright-core';
import { root } from './program.mjs';

export const file = join(root, 'target/site/play.html');
const executablePath = [process.env.CHROMIUM, '/usr/bin/chromium', '/usr/bin/chromium-browser', '/usr/bin/google-chrome']
  .find((path) => path && existsSync(path));

/** The reason to skip tests in a browser; false if there is one. */
export const missing = !executablePath && 'no Chromium here: apt-get install chromium, or CHROMIUM=path';

export const launch = () => chromium.launch({ executablePath, args: ['--no-sandbox'] });

/** Opens the page at an address; errors, warnings and requests to others are collected in `noted`. */
export async function open(browser, options = {}, hash = '') {
  const context = await browser.newContext({ viewport: { width: 1400, height: 900 }, acceptDownloads: true, ...options });
  const page = await context.newPage();
  const noted = [];
  page.on('console', (message) => ['error', 'warning'].includes(message.type()) && noted.push(message.text()));
  page.on('pageerror', (error) => noted.push(error.stack));
  page.on('request', (request) => /^(file|blob|data):/.test(request.url()) || noted.push(request.url()));
  const began = Date.now();
  await page.goto(`file://${file}${hash}`);
  await page.waitForFunction(() => document.body.dataset.ready);
  const took = Date.now() - began;
  await settled(page);
  return { page, noted, took };
}

/** Waits until all numbers belong to the latest parameters. */
export async function settled(page) {
  await page.waitForFunction(() => window.stickslip.latestId() === Number(document.body.dataset.settled), null, { timeout: 120_000 });
}

export const fact = (page, name) => page.locator(`#fact-${name}`).evaluate((cell) => JSON.parse(cell.dataset.value ?? 'null'));
export const median = (list) => [...list].sort((a, b) => a - b)[Math.floor(list.length / 2)];
