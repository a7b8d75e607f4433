// The program, with which the page is compared.
import { execFileSync } from 'node:child_process';
import { mkdtempSync, readFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join, resolve } from 'node:path';

export const root = resolve(import.meta.dirname, '../../..');
const binary = process.env.STICKSLIP ?? join(root, 'target/release/stickslip');
export const folder = mkdtempSync(join(tmpdir(), 'stickslip-page-'));

/** The document of a command line, `stickslip …`; -o is replaced. */
export function document(line) {
  const words = line.replace(/^stickslip /, '').replace(/ -o \S+$/, '').split(' ');
  const file = join(folder, 'document.json');
  execFileSync(binary, ['-q', ...words, '-o', file]);
  return JSON.parse(readFileSync(file, 'utf8'));
}

export const run = (...words) => execFileSync(binary, words, { encoding: 'utf8' });

/** The options of the model in the command line of a run. */
export function model(line) {
  const options = line.match(/--(tip|beta|width|alpha|r|depth-limit|healing-time|inertia) \S+/g);
  return options.join(' ');
}
