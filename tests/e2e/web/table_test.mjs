/**
 * Tables of the control as cells.
 *
 * Tried, and held here:
 * - 4,000 cells: a key draws none of them anew; Tab goes to the next one
 * - A row more than opens as cells; the last row removed; a comment for a row's number
 */

import assert from 'node:assert/strict';
import { afterEach, beforeEach, describe, it } from 'node:test';

import { close, open } from './support/browser.mjs';
import { browser, daemon } from './support/stage.mjs';

const [ROWS, COLUMNS, WIDTH] = [400, 10, 10];
const line = (cells, more = {}) => cells.map((cell, column) => String(cell).padEnd(WIDTH + (more[column] ?? 0))).join('').trimEnd();
const HEAD = ['NR', ...Array.from({ length: COLUMNS - 1 }, (_, i) => `C${i + 1}`)];
const cellsOf = (row) => Array.from({ length: COLUMNS }, (_, column) => (column ? row * COLUMNS + column : row));
const TABLE = ['BEGIN BIG .TAB MM', line(HEAD),
  ...Array.from({ length: ROWS }, (_, row) => line(cellsOf(row))), '[END]', ''].join('\n');

let page;

const name = () => page.evaluate(() => document.activeElement.getAttribute('aria-label'));
const rowCount = () => page.evaluate(() => document.querySelectorAll('.table-editor tbody tr').length);

async function stored() {
  await page.click('.texts > .switch button:last-child');
  await page.click('.editor');
  await page.keyboard.press('Control+s');
  await page.waitForFunction(() => document.querySelector('.title .aside').textContent === '');
  return (await fetch(`${daemon.url}/v1/files/big.tab`)).text();
}

describe('a table of 4,000 cells', () => {
  beforeEach(async () => {
    await daemon.send('PUT', '/v1/files/big.tab', TABLE);
    page = await open(browser, daemon, '#/programs/big.tab');
    await page.waitForSelector('.table-editor tbody tr');
  });
  afterEach(() => close(page));

  it('draws no cell anew for a key', async () => {
    await page.evaluate(() => {
      globalThis.drawn = 0;
      new MutationObserver((changes) => changes.forEach(({ addedNodes }) => { globalThis.drawn += addedNodes.length; }))
        .observe(document.querySelector('.table-editor .scroll'), { childList: true, subtree: true });
    });
    await page.fill('[aria-label="C3, row 7"]', '5');
    await page.keyboard.press('Enter');
    assert.equal(await name(), 'C3, row 8');
    await page.keyboard.press('ArrowUp');
    await page.keyboard.press('ArrowUp');
    assert.equal(await name(), 'C3, row 6');
    await page.keyboard.press('End');
    await page.keyboard.type('1');
    await page.keyboard.press('Tab');
    assert.equal(await name(), 'C4, row 6');
    await page.fill('[aria-label="C9, row 6"]', 'wider than before');
    await page.fill('[aria-label="C2, row 6"]', '12345678901');
    await page.fill('[aria-label="NR, row 6"]', '600');
    await page.keyboard.press('Tab');
    assert.equal(await name(), 'C1, row 600');
    assert.equal(await page.evaluate(() => globalThis.drawn), 0);
    const rows = [HEAD, ...Array.from({ length: ROWS }, (_, row) => cellsOf(row))];
    rows[7] = [600, 61, '12345678901', 631, 64, 65, 66, 67, 68, 'wider than before'];
    rows[8][3] = 5;
    assert.equal(await stored(), ['BEGIN BIG .TAB MM', ...rows.map((row) => line(row, { 2: 2 })), '[END]', ''].join('\n'));
  });

  it('grows beyond that and shrinks', async () => {
    await page.click('.table-editor .actions button');
    assert.equal(await rowCount(), ROWS + 1);
    await page.fill(`[aria-label="C1, row ${ROWS}"]`, '7');
    await page.keyboard.press('Enter');
    await page.click(`[aria-label="Remove row ${ROWS - 1}"]`);
    assert.equal(await name(), `Remove row ${ROWS}`);
    await page.click('[aria-label="Remove row 0"]');
    assert.equal(await rowCount(), ROWS - 1);
    await page.fill('[aria-label="C1, row 1"]', '8');
    await page.keyboard.press('Enter');
    const lines = TABLE.split('\n');
    lines.splice(ROWS + 1, 1, `${ROWS}`.padEnd(WIDTH) + '7');
    lines.splice(2, 2, line([1, 8, ...cellsOf(1).slice(2)]));
    assert.equal(await stored(), lines.join('\n'));
  });

  it('refuses a comment for the number of a row', async () => {
    for (const wrong of [';5', '[END]', '']) {
      await page.fill('[aria-label="NR, row 3"]', wrong);
      await page.keyboard.press('Enter');
      assert.ok(await page.$('[aria-label="NR, row 3"][aria-invalid]'), wrong);
    }
    await page.fill('[aria-label="C1, row 3"]', '9\t9');
    await page.keyboard.press('Enter');
    assert.equal(await stored(), TABLE.replace(line(cellsOf(3)), line(Object.assign(cellsOf(3), { 1: '9 9' }))));
  });
});
