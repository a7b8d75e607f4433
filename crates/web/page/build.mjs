// Builds the page as one file: `node build.mjs OUT.html`. `wasm-bindgen` has written the module and its JavaScript to
// target/site-build/web; declared.json beside them is the output of examples/declared.rs.
import { build } from 'esbuild';
import { mkdir, readFile, writeFile } from 'node:fs/promises';
import { dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { createHash } from 'node:crypto';
import { pack } from './pack.mjs';

const here = dirname(fileURLToPath(import.meta.url));
const made = join(here, '../../../target/site-build/web');
const [out] = process.argv.slice(2);

async function script(entry) {
  const { outputFiles } = await build({
    entryPoints: [join(here, 'src', entry)],
    bundle: true,
    minify: true,
    write: false,
    format: 'iife',
    target: 'es2022',
    // The module is passed as bytes, not loaded from beside the script.
    define: { 'import.meta.url': '""', DECLARED: questions },
  });
  return outputFiles[0].text;
}

/** Escapes the end tag in a text within <script>. */
const within = (text) => text.replaceAll('</script', '<\\/script');

const bytes = await readFile(join(made, 'stickslip_web_bg.wasm'));
const questions = await readFile(join(made, 'declared.json'), 'utf8');

const style = await readFile(join(here, '../node_modules/uplot/dist/uPlot.min.css'), 'utf8');
const parts = {
  css: style + (await readFile(join(here, 'page.css'), 'utf8')),
  module: pack(bytes).toString('base64'),
  worker: within(await script('worker.js')),
  main: within(await script('main.js')),
};
/** Nothing is loaded, and only this script, its workers and the module run. */
const main = createHash('sha256').update(parts.main).digest('base64');
parts.policy = [
  "default-src 'none'",
  `script-src 'sha256-${main}' 'wasm-unsafe-eval'`,
  'worker-src blob:',
  "style-src 'unsafe-inline'",
  'img-src data: blob:',
  "base-uri 'none'",
  "form-action 'none'",
].join('; ');
let page = await readFile(join(here, 'index.html'), 'utf8');
for (const [name, text] of Object.entries(parts)) page = page.replace(`/*{${name}}*/`, () => text);
await mkdir(dirname(out), { recursive: true });
await writeFile(out, page);
console.log(`${out}: ${(page.length / 1e3).toFixed(0)} kB`);
