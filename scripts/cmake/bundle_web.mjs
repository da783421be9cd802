/**
 * node bundle_web.mjs PACKAGES PAGE OUT: makes what a browser loads, in OUT, of the modules of PAGE and the libraries
 * of PACKAGES/node_modules. The header and the station are in one file, app.js, with as few pieces beside it as the
 * views that come later allow; index.html names them all, so that none waits for another.
 * The licences of the libraries go to OUT/licences.txt.
 */

import fs from 'node:fs';
import { createRequire } from 'node:module';
import path from 'node:path';

const [packages, page, out] = process.argv.slice(2).map((folder) => path.resolve(folder));
const modules = path.join(packages, 'node_modules');
const { build } = createRequire(path.join(modules, 'esbuild/package.json'))('esbuild');

const ENTRY = 'app.js';
/** Modules that the page imports when it needs them, with names that stay: the views that app.js names, and the scene. */
const views = fs.readFileSync(path.join(page, ENTRY), 'utf8').matchAll(/import\('\.\/(views\/\w+\.js)'\)/g);
const later = ['figures/path_scene.js', ...[...views].map(([, name]) => name)];
const languages = fs.readdirSync(path.join(page, 'lang')).map((name) => `lang/${name}`).filter((name) => name !== 'lang/en.js');
/** What runs beside the page, or before it, has no module in common with it. */
const workers = ['service_worker.js', 'stream_worker.js', 'first_keys.js'];

const bundle = (names, options) => build({
  absWorkingDir: page, entryPoints: names, outbase: page, outdir: out, nodePaths: [modules], bundle: true, minify: true,
  target: 'es2022', legalComments: 'none', write: false, metafile: true, logLevel: 'warning', ...options,
});

/** Whatever else a later module needs, it asks for all that the page begins with: that is one piece then, not one for each set of sharers. */
const first = Object.keys((await bundle([ENTRY], { format: 'esm', external: [...later, ...languages].map((name) => `./${name}`) })).metafile.inputs);
const asksForFirst = first.filter((name) => name !== ENTRY).map((name) => `import ${JSON.stringify(path.join(page, name))};\n`).join('');
const onePiece = {
  name: 'one-piece',
  setup: ({ onLoad }) => onLoad({ filter: /\.js$/ }, ({ path: file }) =>
    (later.includes(path.relative(page, file)) ? { contents: `${fs.readFileSync(file, 'utf8')}\n${asksForFirst}` } : undefined)),
};
/** The style sheet of a library comes with the module that imports it. */
const styleAsText = {
  name: 'style-as-text',
  setup: ({ onLoad }) => onLoad({ filter: /node_modules.*\.css$/ }, ({ path: file }) => ({ contents: fs.readFileSync(file, 'utf8'), loader: 'text' })),
};
const built = [
  await bundle([ENTRY, ...later, ...languages, 'style/page.css', 'style/later.css'], { format: 'esm', splitting: true, plugins: [onePiece, styleAsText] }),
  await bundle(workers, { format: 'iife' }),
];
const files = built.flatMap(({ outputFiles }) => outputFiles);
const metafile = {
  inputs: Object.assign({}, ...built.map((each) => each.metafile.inputs)),
  outputs: Object.fromEntries(built.flatMap((each) => Object.entries(each.metafile.outputs))
    .map(([name, output]) => [path.relative(out, path.resolve(page, name)), output])),
};
const packageOf = (input) => /node_modules\/((?:@[^/]+\/)?[^/]+)\//.exec(input)?.[1];
const targetOf = (imported) => path.relative(out, path.resolve(page, imported));

/** An output and what it imports before it begins. */
function withImports(name, found = new Set()) {
  if (found.has(name)) return found;
  found.add(name);
  for (const each of metafile.outputs[name].imports) if (each.kind === 'import-statement') withImports(targetOf(each.path), found);
  return found;
}

function write(name, content) {
  const file = path.join(out, name);
  fs.mkdirSync(path.dirname(file), { recursive: true });
  fs.writeFileSync(file, content);
}

function licenceOf(name) {
  const folder = path.join(modules, name);
  const file = fs.readdirSync(folder).find((each) => /^licen[cs]e/i.test(each));
  if (!file) throw new Error(`bundle_web: the package ${name} has no licence file`);
  const { version, license } = JSON.parse(fs.readFileSync(path.join(folder, 'package.json'), 'utf8'));
  return `${name} ${version} (${license})\n\n${fs.readFileSync(path.join(folder, file), 'utf8').trim()}\n`;
}

fs.rmSync(out, { recursive: true, force: true });
for (const file of files) {
  const name = path.relative(out, file.path);
  const libraries = Object.keys(metafile.outputs[name].inputs).some(packageOf);
  write(name, libraries ? `// Libraries with their own licences: /web/licences.txt.\n${file.text}` : file.text);
}
write('icon.svg', fs.readFileSync(path.join(page, 'icon.svg')));
const script = `<script type="module" src="/web/${ENTRY}"></script>`;
const preloads = [...withImports(ENTRY)].filter((name) => name !== ENTRY).map((name) => `<link rel="modulepreload" href="/web/${name}">\n`);
write('index.html', fs.readFileSync(path.join(page, 'index.html'), 'utf8').replace(script, preloads.join('') + script));
const used = [...new Set(Object.keys(metafile.inputs).map(packageOf).filter(Boolean))].sort();
write('licences.txt', used.map(licenceOf).join(`\n${'-'.repeat(80)}\n\n`));
