/** The diagrams of the documents, drawn by Mermaid itself. */

import assert from 'node:assert/strict';
import fs from 'node:fs';
import { createRequire } from 'node:module';
import path from 'node:path';
import { before, describe, it } from 'node:test';

import { launch } from './support/browser.mjs';

const require = createRequire(path.join(process.env.WEB_TEST_MODULES, 'package.json'));
const MERMAID = path.join(path.dirname(require.resolve('mermaid')), 'mermaid.min.js');
const documents = fs.readdirSync('docs', { recursive: true }).filter((name) => name.endsWith('.md')).map((name) => path.join('docs', name));
const diagrams = ['README.md', ...documents].flatMap((name) => [...fs.readFileSync(name, 'utf8').matchAll(/```mermaid\n([^]*?)```/g)].map(([, text]) => ({ name, text })));

describe('diagrams', () => {
  let page;
  before(async () => {
    page = await (await launch()).newPage();
    await page.addScriptTag({ path: MERMAID });
  });

  /** @returns the size of the picture, or the error */
  const draw = (text) => page.evaluate(async (text) => {
    try {
      document.body.innerHTML = (await window.mermaid.render('diagram', text)).svg;
      const { width, height } = document.querySelector('svg').getBBox();
      return Math.min(width, height);
    } catch (error) {
      return String(error);
    }
  }, text);

  it('are there for the parts, the house, a measurement, a verdict and a fail-over', () => {
    assert.deepEqual([...new Set(diagrams.map(({ name }) => name))].sort(), [
      'README.md', 'docs/ARCHITECTURE.md', 'docs/explanation/decision-rules.md', 'docs/guide/postgresql.md']);
  });

  for (const { name, text } of diagrams) {
    it(`of ${name} can be drawn`, async () => assert.ok(await draw(text) > 100, await draw(text)));
  }

  it('with an error are refused', async () => assert.match(await draw('flowchart LR\n  a --> {'), /error/i));
});
