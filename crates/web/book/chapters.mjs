// Makes the chapters of the book from docs: `node chapters.mjs TARGET`. Equations become HTML here, so that the book needs no
// network; links to files outside of the book become file names.
import { cpSync, existsSync, mkdirSync, readFileSync, readdirSync, rmSync, writeFileSync } from 'node:fs';
import { basename, dirname, join, normalize, relative, resolve } from 'node:path';
import katex from 'katex';
import { STATES } from './states.mjs';

const here = import.meta.dirname;
const root = resolve(here, '../../..');
const book = resolve(process.argv[2]);
const src = join(book, 'src');

rmSync(src, { recursive: true, force: true });
mkdirSync(src, { recursive: true });

/** File of the project to chapter of the book. */
const chapters = new Map([
  ['README.md', 'start.md'], ['docs/findings/README.md', 'findings/findings.md'], ['docs/figures/paper/reproduction.md', 'findings/numbers.md'],
  ['CHANGELOG.md', 'changelog.md'], ['CONTRIBUTING.md', 'contributing.md'],
]);
for (const folder of ['tutorials', 'how-to', 'reference', 'explanation', 'findings']) {
  for (const name of readdirSync(join(root, 'docs', folder)).filter((n) => n.endsWith('.md') && n !== 'README.md')) chapters.set(`docs/${folder}/${name}`, `${folder}/${name}`);
}

const listed = readFileSync(join(here, 'SUMMARY.md'), 'utf8');
for (const name of chapters.values()) if (!listed.includes(`(${name})`)) throw new Error(`${name} has no place in SUMMARY.md`);

function equation(tex, displayMode) {
  const html = katex.renderToString(tex.replaceAll('\\|', '|').trim(), { displayMode, strict: false, output: 'htmlAndMathml' });
  // Characters that Markdown would interpret.
  return html.replaceAll(/\s*\n\s*/g, ' ').replaceAll('|', '&#124;').replaceAll('*', '&#42;').replaceAll('_', '&#95;').replaceAll('\\', '&#92;').replaceAll('`', '&#96;').replaceAll('~', '&#126;');
}

/** Typesets equations of a text without code. `$$` may span lines, `$` one line break. */
function typeset(text) {
  return text
    .replaceAll(/\$\$([\s\S]+?)\$\$/g, (_, tex) => `<div>${equation(tex, true)}</div>`)
    .replaceAll(/(?<![\\$])\$(?!\s)((?:[^$\n]|\n(?!\n))+?)(?<!\s)\$/g, (_, tex) => equation(tex, false));
}

/** Path in the book of a picture that a file of the project shows. */
function place(file, picture) {
  const there = normalize(join(dirname(file), picture));
  return relative(dirname(chapters.get(file)), there.slice('docs/'.length));
}

/** The link of a file of the project, as a link of the book. */
function link(file, [whole, mark, label, target]) {
  if (/^(https?:|mailto:|#)/.test(target)) return whole;
  const [path, anchor] = target.split('#');
  const there = normalize(join(dirname(file), path));
  if (there === 'docs/README.md' || there === 'docs') return label;
  const from = (place) => relative(dirname(chapters.get(file)), place);
  if (chapters.has(there)) return `${mark}[${label}](${from(chapters.get(there))}${anchor ? `#${anchor}` : ''})`;
  if (there.startsWith('docs/figures/')) return `${mark}[${label}](${place(file, path)})`;
  if (!existsSync(join(root, there))) throw new Error(`${file}: ${target} is not there`);
  return label.includes(basename(there)) ? `\`${there}\`` : `${label} (\`${there}\`)`;
}

function chapter(file) {
  const text = readFileSync(join(root, file), 'utf8');
  const code = /(^```[\s\S]*?^```$|^(?: {4}.*\n)+|`[^`\n]+`)/m;
  const parts = text.split(new RegExp(code.source, 'gm'));
  // Parts with odd numbers are code.
  return parts.map((part, n) => (n % 2 ? part : typeset(part))).join('')
    .replaceAll(/(<img src=")([^"]+)/g, (_, tag, picture) => tag + place(file, picture))
    .replaceAll(/(!?)\[((?:[^\[\]]|\[[^\]]*\])*)\]\(([^()\s]+)\)/g, (...found) => link(file, found));
}

for (const file of Object.keys(STATES)) if (!chapters.has(file)) throw new Error(`${file} is no chapter`);
/** Adds below the title a link to the state of the page that shows the chapter in motion. */
function moving(file, text) {
  if (!STATES[file]) return text;
  const [words, state] = STATES[file];
  const page = relative(dirname(chapters.get(file)), 'play.html');
  return text.replace(/^# .*\n/, (title) => `${title}\n*In motion: [${words}](${page}${state}).*\n`);
}

for (const [file, name] of chapters) {
  mkdirSync(dirname(join(src, name)), { recursive: true });
  writeFileSync(join(src, name), moving(file, chapter(file)));
}

/** The libraries with the descriptions in their manifests. */
function libraries() {
  const rows = readdirSync(join(root, 'crates')).sort().flatMap((name) => {
    const manifest = join(root, 'crates', name, 'Cargo.toml');
    if (!existsSync(manifest) || ['cli', 'web', 'python'].includes(name)) return [];
    const of = (key) => readFileSync(manifest, 'utf8').match(new RegExp(`^${key} = "(.*)"`, 'm'))[1];
    return [`| [\`${of('name')}\`](api/${of('name').replaceAll('-', '_')}/index.html) | ${of('description')} |`];
  });
  return `# Libraries\n\nEach name leads to its documentation, equation by equation, which \`make doc\` writes into \`target/doc\` too.\n\n| crate | |\n|---|---|\n${rows.join('\n')}\n`;
}
writeFileSync(join(src, 'libraries.md'), libraries());

for (const name of ['SUMMARY.md', 'play.md']) cpSync(join(here, name), join(src, name));
cpSync(join(root, 'docs/figures'), join(src, 'figures'), { recursive: true });
const style = join(here, '../node_modules/katex/dist');
mkdirSync(join(src, 'katex'), { recursive: true });
const fonts = readdirSync(join(style, 'fonts')).filter((name) => name.endsWith('.woff2'));
for (const name of fonts) cpSync(join(style, 'fonts', name), join(src, 'katex/fonts', name));
// Only the newest format of each font, which every browser reads.
const css = readFileSync(join(style, 'katex.min.css'), 'utf8').replaceAll(/,url\([^)]*\.(?:woff|ttf)\) format\("[a-z]*"\)/g, '');
writeFileSync(join(src, 'katex/katex.min.css'), css);
mkdirSync(join(book, 'theme'), { recursive: true });
writeFileSync(join(book, 'theme/head.hbs'), '<link rel="stylesheet" href="{{ path_to_root }}katex/katex.min.css">\n');
for (const name of ['book.toml', 'stickslip.css']) cpSync(join(here, name), join(book, name));
