/** A stored run is gone through block by block, with what changed and with breakpoints; tables of the control have cells. */

import assert from 'node:assert/strict';
import fs from 'node:fs';
import { before, describe, it } from 'node:test';

import { readTable, withCell, withoutRow, withRow } from '../../../clients/web/programs/table_text.js';
import { readBreaks } from '../../../clients/web/programs/breaks.js';
import { Steps } from '../../../clients/web/programs/steps.js';
import { close, findings, open, picture } from './support/browser.mjs';
import { browser, daemon } from './support/stage.mjs';

const LOOP = `0 BEGIN PGM LOOP MM
1 TOOL CALL 5 Z S2000
2 L X+0 Y+0 Z+50 R0 FMAX
3 Q1 = +0
4 LBL 1
5 Q1 = Q1 + 10
6 L X+Q1 F600
7 CALL LBL 1 REP 4
8 CALL PGM INNER
9 TOOL CALL 7 Z S2000
10 L Y+60 F600
11 END PGM LOOP MM
`;
const INNER = `0 BEGIN PGM INNER MM
1 Q2 = Q1 * 2
2 L Z+20 F600
3 END PGM INNER MM
`;
const TABLE = fs.readFileSync('clients/nc/8210/82101.tab', 'utf8');
const TOOLS = 'BEGIN TOOL .T MM\n; own tools\nT       NAME      L         R         TP_NO\n0\n5       MILL      +80       +6\n30      PROBE     +120      +2        1\n[END]\n';

describe('the cells of a table', () => {
  it('are read and changed at their place, with nothing else of the text changed', () => {
    const table = readTable(TOOLS);
    assert.deepEqual(table.columns.map(({ name, width }) => [name, width]), [['T', 7], ['NAME', 9], ['L', 9], ['R', 9], ['TP_NO', Infinity]]);
    assert.deepEqual(table.rows.map(({ cells }) => cells), [['0', '', '', '', ''], ['5', 'MILL', '+80', '+6', ''], ['30', 'PROBE', '+120', '+2', '1']]);
    assert.equal(withCell(TOOLS, table, 1, 3, '+6.25'), TOOLS.replace('+80       +6', '+80       +6.25'));
    assert.equal(withCell(TOOLS, table, 0, 4, '3'), TOOLS.replace('\n0\n', `\n0${' '.repeat(37)}3\n`));
    // A name that is too long widens the column in every row.
    const wide = readTable(withCell(TOOLS, table, 1, 1, 'MILL_ROUGHING'));
    assert.deepEqual(wide.rows[1].cells, ['5', 'MILL_ROUGHING', '+80', '+6', '']);
    assert.deepEqual(wide.rows[2].cells, ['30', 'PROBE', '+120', '+2', '1']);
    assert.deepEqual(readTable(withRow(TOOLS, table)).rows.at(-1).cells, ['31', '', '', '', '']);
    assert.equal(withoutRow(TOOLS, table, 1), TOOLS.replace('5       MILL      +80       +6\n', ''));
  });

  it('keep the width that a description sets, and are none where a value reaches over a column', () => {
    const table = readTable(TABLE);
    assert.deepEqual(table.rows[1].cells, ['1', '+90', '+10']);
    assert.throws(() => withCell(TABLE, table, 0, 1, '+1234567.8901'), RangeError);
    assert.equal(readTable(TOOLS.replace('5       MILL ', '5      XMILL ')), null);
    assert.equal(readTable('0 BEGIN PGM A MM\n'), null);
  });
});

describe('breakpoints', () => {
  const blocks = [0, 5, 10, 15, 10].map((value, i) => ({ block: i, line: i + 1, program: 'TNC:\\A.H', moves: 0, values: { Q1: value, QS1: value > 5 ? 'B' : 'A' } }));
  const steps = new Steps({ length: 0, lines: [], programs: [], programAt: [], blocks });
  const all = (typed) => { const breaks = readBreaks(typed, 'TNC:\\a.h', (text) => text); return blocks.map((_, i) => i).filter((i) => breaks.some((stops) => stops(steps, i))); };

  it('stop at a block, at a change, and when a condition becomes true', () => {
    assert.deepEqual(all('3'), [3]);
    assert.deepEqual(all('N3, a.h:n2'), [2, 3]);
    assert.deepEqual(all('a.h:1, B.H:2'), [1]);
    assert.deepEqual(all('MY SUB.H:1, a.h : 1'), [1]);
    assert.deepEqual(all('Q1 > 7.5'), [2]);
    assert.deepEqual(all('Q1 = 10'), [2, 4]);
    assert.deepEqual(all('QS1'), [0, 2]);
    assert.deepEqual(all('QS1 = "B"'), [2]);
    assert.deepEqual(all('Q7 < 3'), []);
    assert.throws(() => all('block 3'), /block 3/);
  });
});

describe('the time of a tool', () => {
  it('is that of the moves of its blocks', () => {
    const blocks = [[0, 5], [1, 5], [1, 5], [2, 5], [2, 7], [3, 7]].map(([moves, tool], i) => ({ block: i, line: i + 1, program: 'TNC:\\A.I', moves, tool, values: {} }));
    const steps = new Steps({ length: 3, blocks, at: () => ({ kind: 'rapid', seconds: 1 }) });
    assert.deepEqual(steps.toolTimes().map(({ tool, total }) => [tool, total]), [[5, 2], [7, 1]]);
  });
});

describe('a stored run', () => {
  before(async () => {
    for (const [name, text] of Object.entries({ 'LOOP.H': LOOP, 'INNER.H': INNER, 'POINTS.TAB': TABLE, 'tool.t': TOOLS })) await daemon.send('PUT', `/v1/files/nc_prog/${name}`, text, 'text/plain');
    await daemon.send('PUT', '/v1/setups/mill', { machine: { tools: [5, 7].map((number) => ({ number, name: `MILL-${number}`, length_mm: 80, radius_mm: 6 })) } });
  });

  it('goes by block, back and forward, to breakpoints; the called program and the time of each tool are shown', async () => {
    const page = await open(browser, daemon, '#/programs/nc_prog/LOOP.H', { viewport: { width: 1366, height: 768 } });
    await page.waitForSelector('.cm-line');
    await page.selectOption('.run select', 'mill');
    await page.waitForFunction(() => document.querySelector('.run details textarea').value.includes('MILL-5'));
    await page.click('.run button[type="submit"]');
    await page.waitForSelector('.stepping');
    const said = () => page.textContent('.stepping > p');
    await page.fill('[name="breaks"]', 'Q1 >= 30, INNER.H:2');
    await page.press('[name="breaks"]', 'Enter');
    await page.$eval('.moves input[type="range"]', (slider) => { slider.value = 0; slider.dispatchEvent(new Event('input')); });
    await page.click('.breaks >> text=On to a breakpoint');
    await page.waitForFunction(() => /LOOP.H block 5/.test(document.querySelector('.stepping > p').textContent));
    assert.match(await page.textContent('.stepping .parameters'), /Q120 → 30/);
    assert.match(await page.textContent('.moves output'), /X 20/);
    await page.click('.steps button:last-child');
    assert.match(await said(), /LOOP.H block 6/);
    assert.match(await page.textContent('.moves output'), /X 30/);
    await page.click('.breaks >> text=On to a breakpoint');
    await page.waitForSelector('.called:not([hidden]) .editor');
    assert.match(await said(), /INNER.H block 2/);
    await page.click('.steps button:first-child');
    assert.match(await page.textContent('.stepping .parameters'), /Q2100/);
    await page.click('.breaks >> text=Back to a breakpoint');
    assert.match(await said(), /LOOP.H block 5/);
    await page.click('.breaks >> text=Break here');
    assert.equal(await page.inputValue('[name="breaks"]'), 'Q1 >= 30, INNER.H:2, 5');
    await page.fill('[name="breaks"]', 'somewhere');
    await page.click('.breaks >> text=On to a breakpoint');
    await page.waitForFunction(() => /“somewhere” is not a breakpoint/.test(document.querySelector('.stepping .note').textContent));
    // The times of both tools are all the machining time.
    const { runs: [{ id }] } = await daemon.json('/v1/runs?limit=1');
    const run = await daemon.json(`/v1/runs/${id}`);
    await page.waitForSelector('.report [aria-label="Time by tool"]');
    const rows = await page.$$eval('.report [aria-label="Time by tool"] tbody tr', (all) => all.map((row) => [...row.children].map((cell) => cell.textContent)));
    assert.deepEqual(rows.map(([tool]) => tool), ['5', '7']);
    assert.ok(Math.abs(rows.reduce((sum, row) => sum + parseFloat(row.at(-1)), 0) - run.machining_time_s) < 0.11, JSON.stringify([rows, run.machining_time_s]));
    assert.deepEqual((await daemon.json(`/v1/runs/${id}/request`)).watch, ['Q1', 'Q2']);
    assert.deepEqual(await findings(page), []);
    await picture(page, 'steps', { fullPage: true });
    await page.setViewportSize({ width: 390, height: 844 });
    await page.waitForFunction(() => document.documentElement.scrollWidth <= innerWidth);
    await picture(page, 'steps-390', { fullPage: true });
    await close(page);
  });

  it('ends with the program of its last move open', async () => {
    await daemon.send('PUT', '/v1/files/nc_prog/ENDS.H', '0 BEGIN PGM ENDS MM\n1 TOOL CALL 5 Z S2000\n2 Q1 = +1\n3 CALL PGM INNER\n4 END PGM ENDS MM\n', 'text/plain');
    const { id } = await (await daemon.send('POST', '/v1/runs', { program: 'TNC:\\nc_prog\\ENDS.H', setup: 'mill' })).json();
    const page = await open(browser, daemon, `#/programs/nc_prog/ENDS.H?run=${id}`);
    await page.waitForSelector('.called:not([hidden]) .cm-here:has-text("L Z+20")');
    await close(page);
  });

  it('stops at what is set beside the lines of the editor, and of the program that it calls, for the window', async () => {
    const page = await open(browser, daemon, '#/programs/nc_prog/LOOP.H', { viewport: { width: 1366, height: 768 } });
    await page.waitForSelector('.cm-line');
    /** The lines with a mark, from 0, as the blocks count, in the editor at a place. */
    const marked = (place = '.texts > .listing .editor') => page.$eval(place, (editor) => [...editor.shadowRoot.querySelectorAll('.cm-breaks .cm-gutterElement')].flatMap((one, i) => (one.textContent === '●' ? [i] : [])));
    const untilMarked = (lines, place) => page.waitForFunction(([at, wanted]) => JSON.stringify([...document.querySelector(at).shadowRoot.querySelectorAll('.cm-breaks .cm-gutterElement')].flatMap((one, i) => (one.textContent === '●' ? [i] : []))) === wanted, [place ?? '.texts > .listing .editor', JSON.stringify(lines)]);
    await page.click('.cm-breaks .cm-gutterElement:nth-child(6)');
    await untilMarked([5]);
    await page.click('.cm-line >> nth=9');
    await page.keyboard.press('F9');
    await untilMarked([5, 9]);
    await page.selectOption('.run select', 'mill');
    await page.click('.run button[type="submit"]');
    await page.waitForSelector('.stepping');
    assert.equal(await page.inputValue('[name="breaks"]'), '5, 9');
    await page.$eval('.moves input[type="range"]', (slider) => { slider.value = 0; slider.dispatchEvent(new Event('input')); });
    await page.click('.breaks >> text=On to a breakpoint');
    await page.waitForFunction(() => /LOOP.H block 5/.test(document.querySelector('.stepping > p').textContent));
    await page.fill('[name="breaks"]', 'INNER.H:2');
    await page.press('[name="breaks"]', 'Enter');
    await untilMarked([]);
    await page.click('.breaks >> text=On to a breakpoint');
    await page.waitForSelector('.called:not([hidden]) .editor');
    await untilMarked([2], '.called .editor');
    await page.click('.called .cm-breaks .cm-gutterElement:nth-child(2)');
    await page.waitForFunction(() => document.querySelector('[name="breaks"]').value === 'INNER.H:2, INNER.H:1');
    await picture(page, 'breakpoints');
    await page.reload();
    await page.waitForSelector('.stepping');
    assert.equal(await page.inputValue('[name="breaks"]'), 'INNER.H:2, INNER.H:1');
    assert.deepEqual(await marked(), []);
    assert.deepEqual(await findings(page), []);
    await close(page);
  });

  it('begins at the block that is given, and says why it cannot', async () => {
    const page = await open(browser, daemon, '#/programs/nc_prog/LOOP.H', { viewport: { width: 1366, height: 768 }, locale: 'de-DE' });
    await page.waitForSelector('.cm-line');
    await page.selectOption('.run select', 'mill');
    await page.click('.run .of-more summary');
    await page.fill('[name="start_block"]', 'LBL 1');
    await page.click('.run button[type="submit"]');
    await page.waitForFunction(() => /„LBL 1“ ist keine Satznummer/.test(document.querySelector('.run .note').textContent));
    await page.fill('[name="start_block"]', '99');
    await page.click('.run button[type="submit"]');
    await page.waitForFunction(() => /\/start_block/.test(document.querySelector('.run .note').textContent));
    await page.fill('[name="start_block"]', '9');
    await page.click('.run button[type="submit"]');
    await page.waitForSelector('.stepping');
    assert.match(await page.textContent('.stepping > p'), /Satz 3 von 3 gelaufenen/);
    const { runs: [{ id }] } = await daemon.json('/v1/runs?limit=1');
    assert.equal((await daemon.json(`/v1/runs/${id}/request`)).start_block, 9);
    assert.equal(await page.textContent('.run .of-more summary'), 'Teil, Auftrag und Start · 9');
    await close(page);
  });

  it('is of the tables that are edited by cells and stored', async () => {
    const page = await open(browser, daemon, '#/programs/nc_prog/tool.t', { viewport: { width: 1024, height: 768 }, locale: 'it-IT' });
    await page.waitForSelector('.table-editor tbody tr');
    await page.fill('[aria-label="R, riga 5"]', '+6.25');
    await page.press('[aria-label="R, riga 5"]', 'Enter');
    assert.equal(await page.evaluate(() => document.activeElement.getAttribute('aria-label')), 'R, riga 30');
    await page.click('.table-editor .actions button');
    await page.fill('[aria-label="NAME, riga 31"]', 'DRILL');
    await page.press('[aria-label="NAME, riga 31"]', 'Tab');
    assert.deepEqual(await findings(page), []);
    await page.waitForFunction(() => document.documentElement.scrollWidth <= innerWidth);
    await picture(page, 'table-editor-it');
    await page.keyboard.press('Control+s');
    await page.click('.actions .primary').catch(() => {});
    await page.waitForFunction(() => document.querySelector('.title .aside').textContent === '');
    const stored = await (await fetch(`${daemon.url}/v1/files/nc_prog/tool.t`)).text();
    assert.equal(stored, TOOLS.replace('+80       +6\n', '+80       +6.25\n').replace('[END]', '31      DRILL\n[END]'));
    await page.click('.texts > .switch button:last-child');
    assert.match(await page.evaluate(() => document.querySelector('.editor').shadowRoot.textContent), /DRILL/);
    await page.setViewportSize({ width: 390, height: 844 });
    await page.click('.texts > .switch button:first-child');
    await page.waitForFunction(() => document.documentElement.scrollWidth <= innerWidth);
    await picture(page, 'table-editor-390');
    await close(page);
  });

  it('keeps a column of a described table to its width', async () => {
    const page = await open(browser, daemon, '#/programs/nc_prog/POINTS.TAB');
    await page.waitForSelector('.table-editor tbody tr');
    await page.fill('[aria-label="X, row 1"]', '+1234567.8901');
    await page.press('[aria-label="X, row 1"]', 'Tab');
    await page.waitForFunction(() => /X takes at most 9 characters/.test(document.querySelector('.table-editor .note').textContent));
    await close(page);
  });
});
