/**
 * node bundle_web.mjs PACKAGES OUT ENTRY...: bundles each module of clients/web/bundled with the libraries it names,
 * from PACKAGES/node_modules, and writes their licences to OUT/licences.txt.
 */

import fs from 'node:fs';
import { createRequire } from 'node:module';
import path from 'node:path';

const [packages, out, ...entries] = process.argv.slice(2);
const modules = path.join(packages, 'node_modules');
const { build } = createRequire(path.join(modules, 'esbuild/package.json'))('esbuild');

const { metafile } = await build({
  entryPoints: entries,
  outdir: out,
  nodePaths: [modules],
  bundle: true,
  minify: true,
  format: 'esm',
  target: 'es2022',
  legalComments: 'none',
  loader: { '.css': 'text' },
  banner: { js: '// Libraries with their own licences: licences.txt beside this file.' },
  metafile: true,
  logLevel: 'warning',
});

function licenceOf(name) {
  const folder = path.join(modules, name);
  const file = fs.readdirSync(folder).find((each) => /^licen[cs]e/i.test(each));
  if (!file) throw new Error(`bundle_web: the package ${name} has no licence file`);
  const { version, license } = JSON.parse(fs.readFileSync(path.join(folder, 'package.json'), 'utf8'));
  return `${name} ${version} (${license})\n\n${fs.readFileSync(path.join(folder, file), 'utf8').trim()}\n`;
}

const used = Object.keys(metafile.inputs).map((input) => /node_modules\/((?:@[^/]+\/)?[^/]+)\//.exec(input)?.[1]).filter(Boolean);
fs.writeFileSync(path.join(out, 'licences.txt'), [...new Set(used)].sort().map(licenceOf).join(`\n${'-'.repeat(80)}\n\n`));
