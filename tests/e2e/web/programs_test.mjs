/**
 * NC programs: stored, checked, run.
 *
 * Tried, and held here:
 * - *Delete*; upload over a program of the same name: asked first
 * - Upload 9 MiB with no program open: the reason in sight
 * - Press *Run* twice: one
 * - Type while another program is being opened; store twice: to the program that is shown; stored
 * - Open another program while one runs: nothing of it: the run is in its own list
 */

import assert from 'node:assert/strict';
import fs from 'node:fs';
import { afterEach, before, describe, it } from 'node:test';

import { sphereCentre, touchedSpheres } from '../../../clients/web/figures/touched_sphere.js';
import { drawnFeatures, outlines } from '../../../clients/web/figures/workpiece_outline.js';
import { KINDS, Trace } from '../../../clients/web/figures/trace.js';
import { close, drawn, hashOf, open, openIn, picture } from './support/browser.mjs';
import { eventually } from './support/eventually.mjs';
import { browser, daemon } from './support/stage.mjs';

const EXAMPLE = 'clients/nc/8255';
const PROGRAM = 'nc_prog/8255/8255.h';
const LOGGING = `BEGIN PGM LOG MM
TOOL CALL 30 Z
TCH PROBE 444 PROBING IN 3-D ~
    Q263=+50 ~
    Q264=+40 ~
    Q294=+0 ~
    Q581=+0 ~
    Q582=+0 ~
    Q583=+1 ~
    Q320=+0 ~
    Q260=+50 ~
    QS400="0.1-0.1" ~
    Q309=+0
END PGM LOG MM
`;
const PLATE = { workpiece: { features: [{ type: 'block', min_mm: [0, 0, -40], max_mm: [100, 80, 0.02] }] } };

let page;

afterEach(() => close(page));

const hash = () => hashOf(page);

/** The drawing, where the path is shown in space. */
async function showDrawing() {
  await page.waitForSelector('.path');
  if (await page.$('.path .switch')) await page.click('.path .switch button:last-child');
}

describe('the programs', () => {
  before(() => daemon.send('PUT', '/v1/setups/hole-good', fs.readFileSync(`${EXAMPLE}/setups/hole-good.json`, 'utf8')));

  it('are uploaded, checked and run, and show what they did', async () => {
    page = await open(browser, daemon, '#/programs');
    await page.waitForSelector('.files .aside');
    await page.fill('.upload input[type="text"]', 'nc_prog/8255');
    await page.setInputFiles('.upload input[type="file"]', ['8255.h', '82551.h', '82552.a'].map((name) => `${EXAMPLE}/${name}`));
    await page.waitForSelector('.cm-line >> nth=10');
    const stored = await (await fetch(`${daemon.url}/v1/files/${PROGRAM}`)).text();
    assert.equal(stored, fs.readFileSync(`${EXAMPLE}/8255.h`, 'utf8'));
    await page.click('.program .actions button:has-text("Check")');
    await page.waitForFunction(() => (document.querySelector('.program .note')?.textContent ?? '') !== '');
    assert.equal((await page.$$('.finding')).length, 0);
    await page.selectOption('.run select', 'hole-good');
    await page.fill('.run .pair textarea', 'Q1 = 25\nQS1 = H7');
    await page.click('.run button[type="submit"]');
    await showDrawing();
    await page.waitForSelector('.path-view .contact');
    assert.match(await page.textContent('.screen'), /STATUS OF THE FIT: GOOD/);
    assert.equal(await page.textContent('.report .mark-of'), 'Good');
    assert.equal((await page.$$('.path-view:first-of-type .contact')).length, 8); // four touches, in two views
    assert.match(hash(), /run=r\d+/);
    // The slider goes through the moves, a line of the program goes to its move, and an earlier run comes back.
    const { moves } = await daemon.json(`/v1/runs/${/run=([^&]+)/.exec(hash())[1]}/trace`);
    const first = moves.findIndex((move) => move.contact_mm);
    await page.$eval('.moves input', (slider, at) => { slider.value = at; slider.dispatchEvent(new Event('input')); }, first);
    const said = () => page.textContent('.moves output');
    assert.match(await said(), new RegExp(`^${first + 1} of ${moves.length} · .*block ${moves[first].block} · Probing · X .*F .*Contact X`));
    assert.equal((await page.$$('.path-view .here circle')).length, 2);
    // The text of the program that is called stands at its line, one number a row; a touch of it goes to its move.
    await page.waitForSelector('.called .cm-line.cm-here');
    assert.match(await page.textContent('.called h3'), /82551\.h, called by 8255\.h/i);
    assert.match(await page.textContent('.called .cm-here'), new RegExp(`^\\s*${moves[first].block} `));
    assert.equal((await page.$$('.cm-lineNumbers')).length, 0);
    assert.ok((await page.$$('.moves output strong')).length > 0, 'what the move changes is not marked');
    const before = moves.findLastIndex((move, i) => i < first && move.block !== moves[first].block && move.program === moves[first].program);
    await page.$$eval('.called .cm-line', (rows, start) => rows.find((row) => row.textContent.trimStart().startsWith(start)).scrollIntoView(), `${moves[before].block} `);
    await drawn(page);
    await page.click(`.called .cm-line:text-matches("^\\\\s*${moves[before].block} ")`);
    assert.match(await said(), new RegExp(`82551\\.h block ${moves[before].block} `, 'i'));
    const own = moves.findIndex((move) => /8255\.h$/i.test(move.program));
    if (own >= 0) {
      await page.click(`.cm-line >> nth=${moves[own].line - 1}`);
      assert.match(await said(), new RegExp(`8255\\.h block ${moves[own].block} `, 'i'));
      assert.equal(await page.$eval('.cm-line.cm-here', (row) => [...row.parentNode.querySelectorAll('.cm-line')].indexOf(row) + 1), moves[own].line);
    }
    const ran = hash();
    await page.click('.run button[type="submit"]');
    await page.waitForFunction(() => document.querySelectorAll('.earlier button').length === 2);
    assert.notEqual(hash(), ran);
    await page.click('.earlier li:last-child button');
    await page.waitForSelector('.earlier li:last-child [aria-current]');
    assert.equal(hash(), ran);
    const again = await openIn(page.context(), daemon, new URL(page.url()).hash);
    await again.waitForSelector('.moves output');
    await picture(again, 'programs', { fullPage: true });
    await again.close();
  });

  it('are not deleted or replaced without a question, and say why an upload is refused', async () => {
    const text = 'BEGIN PGM KEEP MM\nEND PGM KEEP MM\n';
    await daemon.send('PUT', '/v1/files/nc_prog/keep.h', text, 'text/plain');
    page = await open(browser, daemon, '#/programs/nc_prog/keep.h');
    await page.waitForSelector('.cm-line >> nth=1');
    const there = async () => (await fetch(`${daemon.url}/v1/files/nc_prog/keep.h`)).text();
    await page.click('button:has-text("Delete")');
    await page.click('dialog button:has-text("Cancel")');
    assert.equal(await there(), text);
    await page.setInputFiles('.upload input[type="file"]', { name: 'KEEP.H', mimeType: 'text/plain', buffer: Buffer.from('new') });
    await page.click('dialog button:has-text("Cancel")');
    assert.equal(await there(), text);
    await page.click('button:has-text("Delete")');
    await page.click('dialog button:has-text("Delete")');
    await page.waitForSelector('.empty:not([hidden])');
    await page.setInputFiles('.upload input[type="file"]', { name: 'big.h', mimeType: 'text/plain', buffer: Buffer.alloc(8 * 1024 * 1024 + 1, 32) });
    await page.waitForFunction(() => (document.querySelector('.program .note')?.textContent ?? '') !== '');
    assert.ok(await page.isVisible('.program .note'));
  });

  it('carry what a check finds in their text', async () => {
    await daemon.send('PUT', '/v1/files/nc_prog/bad.h', 'BEGIN PGM BAD MM\n1 CALL LBL 7\n2 FOO\nEND PGM BAD MM\n', 'text/plain');
    page = await open(browser, daemon, '#/programs/nc_prog/bad.h');
    const found = () => page.$$eval('.cm-line.cm-error', (lines) => lines.map((line) => line.textContent));
    await page.waitForSelector('.cm-line.cm-error'); // as soon as it is open
    assert.deepEqual(await found(), ['1 CALL LBL 7', '2 FOO']);
    assert.equal(await page.textContent('.cm-place >> nth=1'), 'FOO');
    await page.click('.run button[type="submit"]'); // a run is refused for the same reasons
    await page.waitForFunction(() => (document.querySelector('.run .note')?.textContent ?? '') !== '');
    await page.click('.program .actions button:has-text("Check")');
    await page.waitForFunction(() => /2/.test(document.querySelector('.program .note')?.textContent));
    assert.deepEqual(await found(), ['1 CALL LBL 7', '2 FOO']);
    await page.click('.findings button >> nth=1');
    assert.equal(await page.textContent('.cm-activeLine'), '2 FOO');
  });

  it('are edited, checked as one types, and stored only when that is wanted', async () => {
    const text = 'BEGIN PGM ED MM\r\nTOOL CALL 30 Z\r\nEND PGM ED MM\r\n';
    await daemon.send('PUT', '/v1/files/nc_prog/ed.h', text, 'text/plain');
    const there = async () => (await fetch(`${daemon.url}/v1/files/nc_prog/ed.h`)).text();
    page = await open(browser, daemon, '#/programs/nc_prog/ed.h');
    await page.click('.cm-line >> nth=1');
    await page.keyboard.press('End');
    await page.keyboard.type('\nCALL LBL 9 ; nowhere');
    await page.waitForSelector('.cm-line.cm-error');
    assert.equal(await page.textContent('.cm-line.cm-error'), 'CALL LBL 9 ; nowhere');
    assert.match(await page.textContent('.findings'), /block 2/);
    assert.deepEqual(await page.$$eval('.cm-lineNumbers .cm-gutterElement', (all) => all.slice(1).map(({ textContent }) => textContent)), ['0', '1', '2', '3', '']);
    assert.equal(await there(), text);
    assert.match(await page.textContent('.title'), /not stored yet/);
    const colours = () => page.$$eval('.cm-line >> nth=2 >> span', (words) => new Set(words.map((word) => getComputedStyle(word).color)).size);
    await eventually(async () => assert.ok(await colours() > 1, 'Klartext has no colours')); // the editor reads a text when it has time
    // It is kept over a visit elsewhere, and stored with the line ends it had.
    await page.evaluate(() => { location.hash = '#/tables'; });
    await page.waitForSelector('.grid');
    await page.evaluate(() => { location.hash = '#/programs/nc_prog/ed.h'; });
    await page.waitForSelector('.cm-line.cm-error');
    await page.click('.cm-line >> nth=2');
    await page.keyboard.press('Control+s');
    await page.waitForFunction(() => document.querySelector('.title .aside')?.textContent === '');
    assert.equal(await there(), 'BEGIN PGM ED MM\r\nTOOL CALL 30 Z\r\nCALL LBL 9 ; nowhere\r\nEND PGM ED MM\r\n');
    // What somebody else has stored meanwhile is not overwritten.
    await daemon.send('PUT', '/v1/files/nc_prog/ed.h', text, 'text/plain');
    await page.keyboard.type('x');
    await page.click('.program .actions button:has-text("Store")');
    await page.waitForFunction(() => (document.querySelector('.program > .note')?.textContent ?? '') !== '');
    assert.equal(await there(), text);
    await page.click('button:has-text("Discard changes")');
    await page.click('dialog button:has-text("Discard changes")');
    await page.waitForFunction(() => document.querySelector('.title .aside')?.textContent === '');
    assert.equal((await page.$$('.cm-line')).length, 4); // a line after the last line end
    // A line of a run's move: by the keyboard too. What is run is stored first.
    await page.click('.cm-line >> nth=1');
    await page.keyboard.press('End');
    await page.keyboard.type('\nL Z+100 R0 FMAX\nL X+10 Y+5 R0 F500');
    await page.click('.run button[type="submit"]');
    await page.waitForSelector('.moves output');
    assert.match(await there(), /L X\+10 Y\+5 R0 F500\r\n/);
    await page.click('.cm-line >> nth=3');
    await page.keyboard.press('ArrowUp');
    assert.match(await page.textContent('.moves output'), /block 2 · Rapid/i);
  });

  it('are said to be in order only as they stand, and are checked again after an outage', async () => {
    await daemon.send('PUT', '/v1/files/nc_prog/mend.h', 'BEGIN PGM MEND MM\nEND PGM MEND MM\n', 'text/plain');
    page = await open(browser, daemon, '#/programs/nc_prog/mend.h');
    await page.waitForSelector('.cm-line >> nth=1');
    const note = (text) => page.waitForFunction((wanted) => document.querySelector('.program > .note').textContent === wanted, text);
    await page.click('.program .actions button:has-text("Check")');
    await note('No findings.');
    await page.click('.cm-line >> nth=0');
    await page.keyboard.press('End');
    await page.keyboard.type('\nFOO');
    await note('');
    await page.waitForSelector('.cm-line.cm-error');
    await page.route(/\/(v1|livez)/, (route) => route.abort());
    await page.keyboard.type(' BAR');
    await page.waitForFunction(() => /^Not checked: ./.test(document.querySelector('.findings').textContent));
    assert.equal(await page.$('.cm-line.cm-error'), null);
    await page.unroute(/\/(v1|livez)/);
    await page.waitForSelector('.cm-line.cm-error >> text=FOO BAR');
  });

  it('are run and stored once, and what is typed while another is opened stays its own', async () => {
    const texts = Object.fromEntries(['one', 'two'].map((name) => [name, `BEGIN PGM ${name.toUpperCase()} MM\nEND PGM ${name.toUpperCase()} MM\n`]));
    for (const [name, text] of Object.entries(texts)) await daemon.send('PUT', `/v1/files/nc_prog/${name}.h`, text, 'text/plain');
    const there = async (name) => (await fetch(`${daemon.url}/v1/files/nc_prog/${name}.h`)).text();
    page = await open(browser, daemon, '#/programs/nc_prog/one.h');
    await page.waitForSelector('.cm-line:has-text("END PGM ONE MM")');
    let go;
    const held = new Promise((resolve) => { go = resolve; });
    const late = async (route) => {
      await held;
      await route.continue();
    };
    await page.route('**/v1/runs', late);
    await page.$eval('.run form', (form) => { form.requestSubmit(); form.requestSubmit(); });
    await page.route('**/v1/files/nc_prog/two.h', late);
    await page.click('.files button:has-text("two.h")');
    await page.waitForSelector('.files button[aria-current]:has-text("two.h")');
    await page.click('.cm-line >> nth=0');
    await page.keyboard.press('End');
    await page.keyboard.type(' ; of one');
    go();
    await page.waitForSelector('.cm-line:has-text("END PGM TWO MM")');
    assert.equal(await page.textContent('.title'), 'two.h', 'nothing of it is not stored');
    // The run of the one is over where its button can be pressed again, and is not shown below the other.
    await page.waitForFunction(() => document.querySelector('.run button[type="submit"]')?.disabled === false);
    await eventually(async () => assert.equal((await daemon.json('/v1/runs?program=TNC:%5Cnc_prog%5Cone.h&status=completed')).runs.length, 1));
    assert.equal(await page.textContent('.report'), '');
    assert.doesNotMatch(hash(), /run=/);
    await page.click('.files button:has-text("one.h")');
    await page.waitForSelector('.cm-line:has-text("; of one")');
    assert.match(await page.textContent('.title'), /^one\.h.*not stored yet/);
    await page.keyboard.press('Control+s');
    await page.click('.cm-line >> nth=0');
    await page.keyboard.press('Control+s');
    await page.keyboard.press('Control+s');
    await page.waitForFunction(() => document.querySelector('.title .aside')?.textContent === '');
    assert.equal(await page.textContent('.program > .note'), '');
    assert.deepEqual([await there('one'), await there('two')], [texts.one.replace('MM\n', 'MM ; of one\n'), texts.two]);
    await eventually(async () => assert.equal((await daemon.json('/v1/runs?program=TNC:%5Cnc_prog%5Cone.h')).runs.length, 1));
  });

  it('begin with an empty one, which is stored under the name it got', async () => {
    page = await open(browser, daemon, '#/programs');
    await page.waitForSelector('.files .aside');
    await page.fill('.upload input[type="text"]', 'nc_prog/new');
    await page.fill('.begin input', 'PLATE');
    await page.click('.begin button');
    await page.waitForSelector('.cm-line:has-text("END PGM PLATE MM")');
    assert.equal((await fetch(`${daemon.url}/v1/files/nc_prog/new/PLATE.h`)).status, 404);
    await page.click('.program .actions button:has-text("Store")');
    await page.waitForSelector('.files button[aria-current]:has-text("PLATE.h")');
    assert.match(await (await fetch(`${daemon.url}/v1/files/nc_prog/new/PLATE.h`)).text(), /^BEGIN PGM PLATE MM\nEND PGM PLATE MM\n$/);
  });

  it('that are no UTF-8 are shown and cannot be spoiled', async () => {
    await daemon.send('PUT', '/v1/files/nc_prog/ansi.h', 'BEGIN PGM ANSI MM\n', 'text/plain');
    await fetch(`${daemon.url}/v1/files/nc_prog/ansi.h`, { method: 'PUT', body: Buffer.from('BEGIN PGM ANSI MM\n; Pr\xfcfen\nEND PGM ANSI MM\n', 'latin1') });
    page = await open(browser, daemon, '#/programs/nc_prog/ansi.h');
    await page.waitForSelector('.cm-line:has-text("Prüfen")');
    await page.click('.cm-line >> nth=1');
    await page.keyboard.type('x');
    assert.equal(await page.textContent('.cm-line >> nth=1'), '; Prüfen');
    assert.match(await page.textContent('.listing'), /UTF-8/);
  });

  it('show the log of cycle 444 in a frame that may do nothing', async () => {
    await daemon.send('PUT', '/v1/files/nc_prog/log.h', LOGGING, 'text/plain');
    await daemon.send('PUT', '/v1/setups/plate', PLATE);
    page = await open(browser, daemon, '#/programs/nc_prog/log.h?setup=plate');
    await page.waitForFunction(() => document.querySelector('.run select')?.value === 'plate');
    await page.click('.run button[type="submit"]');
    await page.click('.report .actions button');
    const frame = await (await page.waitForSelector('.report iframe')).contentFrame();
    await frame.waitForSelector('table');
    assert.equal(await page.getAttribute('.report iframe', 'sandbox'), '');
    assert.match(await page.getAttribute('.report iframe', 'src'), /^\/v1\/runs\/r\d+-[0-9a-f]{16}\/files\/TCHPR444/i);
    await picture(page, 'programs-444', { fullPage: true });
  });

  /** A run whose path has a part, feed moves, a rapid and four contacts. */
  async function run8255() {
    for (const name of ['8255.h', '82551.h', '82552.a']) await daemon.send('PUT', `/v1/files/${PROGRAM.replace('8255.h', name)}`, fs.readFileSync(`${EXAMPLE}/${name}`, 'utf8'), 'text/plain');
    const order = { program: 'TNC:\\nc_prog\\8255\\8255.h', setup: 'hole-good' };
    return (await (await daemon.send('POST', '/v1/runs', order)).json()).id;
  }

  /** How many pixels of the scene differ from its ground, and what they look like together. */
  const scenePixels = () => page.$eval('.scene canvas', (canvas) => {
    const copy = document.createElement('canvas');
    Object.assign(copy, { width: canvas.width, height: canvas.height });
    const pen = copy.getContext('2d');
    pen.drawImage(canvas, 0, 0);
    const { data } = pen.getImageData(0, 0, copy.width, copy.height);
    let differing = 0;
    let sum = 0;
    for (let i = 0; i < data.length; i += 4) {
      if (data[i] !== data[0] || data[i + 1] !== data[1] || data[i + 2] !== data[2]) differing += 1;
      sum = (sum * 31 + data[i] + 3 * data[i + 1] + 7 * data[i + 2]) % 2147483647;
    }
    return { differing, sum, all: data.length / 4 };
  });

  it('show part, stylus and path in space, which the slider and the finger move', async (test) => {
    const id = await run8255();
    page = await open(browser, daemon, `#/programs/${PROGRAM}?run=${id}&setup=hole-good`);
    await page.waitForSelector('.path');
    if (!await page.$('.scene')) return test.skip('this browser has no WebGL here');
    await page.$eval('.scene', (figure) => figure.scrollIntoView({ block: 'center' }));
    const settled = async () => { await drawn(page); return scenePixels(); };
    const first = await settled();
    assert.ok(first.differing > first.all / 20, `${first.differing} of ${first.all} pixels are drawn`);
    await page.$eval('.moves input', (slider) => { slider.value = 3; slider.dispatchEvent(new Event('input')); });
    const moved = await settled();
    assert.notEqual(moved.sum, first.sum, 'the stylus did not move');
    // Axes, the bore and the scale are written on it; a side and the section are buttons.
    const labels = () => page.$$eval('.scene-labels > span', (all) => all.map(({ textContent }) => textContent));
    assert.deepEqual(await labels(), ['X', 'Y', 'Z', 'Ø 25.013', '20 mm']);
    const places = () => page.$$eval('.scene-labels > span', (all) => all.slice(0, 3).map((one) => one.getBoundingClientRect()).map(({ x, y }) => [Math.round(x), Math.round(y)]));
    await page.click('.views button:has-text("Front")');
    const front = await settled();
    const [x0, , z0] = await places();
    assert.ok(x0[0] > z0[0] && x0[1] > z0[1], 'from the front X goes to the right and Z up');
    await page.click('.views button:has-text("Section")');
    assert.equal(await page.getAttribute('.views button:has-text("Section")', 'aria-pressed'), 'false');
    assert.notEqual((await settled()).sum, front.sum, 'the whole part is seen as its section is');
    await page.click('.views button:has-text("Section")');
    assert.equal((await settled()).sum, front.sum);
    await page.click('.views button:has-text("3-D")');
    assert.equal((await settled()).sum, moved.sum);
    const { x, y, width, height } = await (await page.$('.scene canvas')).boundingBox();
    await page.mouse.move(x + width / 2, y + height / 2);
    await page.mouse.down();
    await page.mouse.move(x + width / 2 + 90, y + height / 2 + 20, { steps: 3 });
    await page.mouse.up();
    const turned = await settled();
    assert.notEqual(turned.sum, moved.sum, 'it did not turn');
    await picture(page, 'programs-space');
    await page.emulateMedia({ colorScheme: 'dark' });
    await picture(page, 'programs-space-dark');
    // As a drawing it is marked where the slider is.
    await page.click('.path .switch button:last-child');
    assert.equal((await page.$$('.path-view .here circle')).length, 2);
    return undefined;
  });

  it('find the sphere on a turned table in the middle of what was touched', async () => {
    page = await open(browser, daemon, '#/programs');
    const touched = [[0, 0, 15], [15, 0, 0], [0, 15, 0], [-15, 0, 0], [0, -15, 0]];
    assert.deepEqual(sphereCentre(touched).map((value) => Math.round(value * 1e6) / 1e6 + 0), [0, 0, 0]);
    assert.equal(sphereCentre(touched.slice(1)), null); // in one plane
    const moves = [0, 60].flatMap((C) => touched.map(([X, Y, Z]) => {
      const at = { X: X + C, Y: Y - C, Z };
      return { kind: 'probe', line: 1, program: 'a.h', start_mm: at, end_mm: at, end_deg: { A: 0, C }, contact_mm: at };
    }));
    const spots = touchedSpheres(new Trace(new TextEncoder().encode(JSON.stringify({ moves }))));
    assert.deepEqual(spots.map(({ degrees: { C } }) => C), [0, 60]);
    spots.forEach(({ centre, degrees: { C } }) => centre.forEach((value, i) => assert.ok(Math.abs(value - [C, -C, 0][i]) < 1e-6)));
  });

  it('show the material below a measured surface', async () => {
    page = await open(browser, daemon, '#/programs');
    await page.click('.empty button:has-text("444")');
    await showDrawing();
    assert.equal(await page.locator('.path-view path.block').count(), 2);
    const { workpiece: { features } } = JSON.parse(fs.readFileSync('clients/nc/444/setups/plate.json', 'utf8'));
    const [{ points }] = outlines(drawnFeatures(features), 'Z');
    assert.deepEqual(points.map(({ X, Z }) => [X, Z]), [[0, -10.015], [100, -10.015], [100, -0.015], [0, -0.015]]);
  });

  it('fall back to the drawing where there is no WebGL', async () => {
    const id = await run8255();
    page = await open(browser, daemon, '#/programs');
    await page.addInitScript(() => {
      const { getContext } = HTMLCanvasElement.prototype;
      HTMLCanvasElement.prototype.getContext = function none(kind, ...rest) { return kind.startsWith('webgl') ? null : getContext.call(this, kind, ...rest); };
    });
    await page.evaluate((address) => { location.hash = address; }, `#/programs/${PROGRAM}?run=${id}&setup=hole-good`);
    await page.reload();
    await page.waitForSelector('.path-view .contact');
    assert.equal(await page.$('.scene'), null);
    const asked = await page.evaluate(() => performance.getEntriesByType('resource').map(({ name }) => name));
    assert.deepEqual(asked.filter((name) => name.includes('three')), []);
  });

  it('read the moves of a run from their bytes as JSON has them', async () => {
    page = await open(browser, daemon, '#/programs');
    const text = await (await fetch(`${daemon.url}/v1/runs/${await run8255()}/trace`)).text();
    const move = (i) => `{"kind":"${KINDS[i % 4]}","block":null,"line":${i},"program":"TNC:\\\\\u00e4 \\"${i % 2}\\".h",`
      + `"start_mm":{"X":${-i / 7},"Y":0,"Z":1e-7},"start_deg":{"C":9},"end_mm":{"X":-0.5,"Y":1e+3,"Z":${i}},"contact_mm":${i % 3 ? 'null' : `{"X":1.25,"Y":-2,"Z":${i}}`}}`;
    const made = `{"moves":[\n${Array.from({ length: 40 }, (_, i) => move(i)).join(',\n')}\n],"dropped":3}`;
    for (const json of [text, made, '{"moves":[\n\n],"dropped":0}', JSON.stringify(JSON.parse(text))]) {
      const { moves } = JSON.parse(json);
      const trace = new Trace(new TextEncoder().encode(json));
      assert.equal(trace.length, moves.length);
      assert.deepEqual(moves.map((_, i) => trace.at(i)), moves);
      assert.deepEqual([...trace.kinds].map((kind) => KINDS[kind]), moves.map(({ kind }) => kind));
      assert.deepEqual([...trace.lines], moves.map(({ line }) => line));
      assert.deepEqual([...trace.programAt].map((at) => trace.programs[at]), moves.map(({ program }) => program));
      const numbers = (points) => points.flatMap(({ X, Y, Z }) => [X, Y, Z]).map(Math.fround);
      assert.deepEqual([...trace.ends], numbers(moves.flatMap((one) => [one.start_mm, one.end_mm])));
      assert.deepEqual([...trace.contacts], numbers(moves.map((one) => one.contact_mm).filter(Boolean)));
      if (json === made) assert.deepEqual([trace.indexOf(7, (path) => path.includes('1')), trace.indexOf(7, () => true, 8)], [7, -1]);
    }
    const packed = await fetch(`${daemon.url}/v1/runs/${await run8255()}/trace`, { headers: { 'Accept-Encoding': 'gzip' } });
    assert.equal(packed.headers.get('content-encoding'), 'gzip');
    assert.equal(await packed.text(), text);
  });

  it('show 100,000 moves', async (test) => {
    const id = await run8255();
    page = await open(browser, daemon, '#/programs');
    const moves = Array.from({ length: 100_000 }, (_, i) => {
      const at = (k) => ({ X: 50 + 40 * Math.sin(k / 900), Y: 40 + 30 * Math.cos(k / 700), Z: k / 5000 });
      return { kind: ['rapid', 'feed', 'probe', 'arc'][i % 4], program: 'TNC:\\nc_prog\\8255\\8255.h', line: 1 + (i % 20), start_mm: at(i), end_mm: at(i + 1), feed_mm_min: 500, contact_mm: i % 4 === 2 ? at(i + 1) : null };
    });
    const body = JSON.stringify({ moves });
    await page.route('**/trace', (route) => route.fulfill({ contentType: 'application/json', body }));
    await page.evaluate((address) => { location.hash = address; }, `#/programs/${PROGRAM}?run=${id}&setup=hole-good`);
    await page.reload();
    await page.waitForSelector('.moves output');
    if (!await page.$('.scene')) return test.skip('this browser has no WebGL here');
    const times = await page.evaluate(() => {
      const { responseEnd } = performance.getEntriesByType('resource').find(({ name }) => name.endsWith('/trace'));
      return { read: responseEnd, shown: performance.now() };
    });
    test.diagnostic(`100,000 moves, ${(body.length / 1e6).toFixed(0)} MB: on the screen at most ${Math.round(times.shown - times.read)} ms after they were received`);
    assert.match(await page.getAttribute('.scene canvas', 'aria-label'), /100000 moves, 25000 contacts/);
    return undefined;
  });
});
