/**
 * The list of what was measured, when it is long: reached at any place, with few rows in the page and few questions.
 *
 * Tried, and held here:
 * - Rows that came at once, 10,000 in one import: a time alone does not tell them apart
 * - A correction far from what it corrects
 * - A value stored while the list is open
 */

import assert from 'node:assert/strict';
import { before, describe, it } from 'node:test';

import { close, findings, open, openIn, picture, timer } from './support/browser.mjs';
import { holdNext } from './support/hold.mjs';
import { browser, daemon } from './support/stage.mjs';

const ROWS = 100_000;
const IMPORT = 10_000;
/** Rows that the page may hold, and questions that a place may take: those that find it, and steps of 1,000 rows into an import. */
const MOST_ROWS = 300;
const MOST_QUESTIONS = 40;
/** The question for rows that came at the top. */
const NEW_ROWS = /\/v1\/measurements\?(?=.*sort=oldest).*after=/;
const VIEW = { viewport: { width: 1366, height: 768 } };

/** The part in a row, the newest first. */
const partAt = (row) => `L-${ROWS - 1 - row}`;
/** What stands in sight: [row, part] from the first on. */
const inSight = (page) => page.evaluate(() => {
  const { top, bottom } = document.querySelector('.records').getBoundingClientRect();
  const head = document.querySelector('.records thead').getBoundingClientRect().height;
  return [...document.querySelectorAll('.records tbody tr[aria-rowindex]')].filter((row) => row.getBoundingClientRect().bottom > top + head + 5 && row.getBoundingClientRect().top < bottom)
    .map((row) => [Number(row.ariaRowIndex ?? row.getAttribute('aria-rowindex')) - 2, row.cells[0].textContent]);
});
/** Until rows stand in sight from top to bottom and nothing is asked. */
const rest = (page) => page.waitForFunction(() => {
  const list = document.querySelector('.records');
  const [{ top, bottom }, rows] = [list.getBoundingClientRect(), list.querySelector('tbody').getBoundingClientRect()];
  return !list.ariaBusy && rows.top < top + 60 && rows.bottom > bottom - 2;
});
const seen = async (page, row) => {
  await page.waitForFunction((index) => {
    const [list, at] = [document.querySelector('.records'), document.querySelector(`.records tr[aria-rowindex="${index}"]`)];
    if (!at || list.ariaBusy) return false;
    const [{ top, bottom }, { top: from }] = [list.getBoundingClientRect(), at.getBoundingClientRect()];
    return from > top - 1 && from < bottom;
  }, row + 2);
  const rows = await inSight(page);
  assert.deepEqual(rows, rows.map((_, i) => [rows[0][0] + i, partAt(rows[0][0] + i)]));
  return rows;
};
async function goTo(page, row) {
  await page.getByLabel('Row').fill(String(row + 1));
  await page.getByLabel('Row').press('Enter');
  return seen(page, row);
}

describe('the list of 100,000', () => {
  before(async () => {
    for (let first = 0; first < ROWS; first += IMPORT) {
      await daemon.send('POST', '/v1/measurements', Array.from({ length: IMPORT }, (_, i) => (
        { designation: '25 H7', measured_mm: (25 + ((first + i) % 210) / 10000).toFixed(4), part_id: `L-${first + i}`, order: 'WO-L' })));
    }
  });

  it('is reached at any row, and holds few', async () => {
    const page = await open(browser, daemon, '#/parts?order=WO-L', VIEW);
    await page.waitForSelector('.place input');
    assert.equal(await page.textContent('.place .hint'), 'of 100000');
    assert.equal(await page.getAttribute('.records table', 'aria-rowcount'), String(ROWS + 1));
    let questions = 0;
    page.on('request', (request) => { if (request.url().includes('/v1/measurements')) questions += 1; });
    let drawn = 17;
    for (let i = 0; i < 10; ++i) {
      drawn = (drawn * 48271) % 2147483647;
      const row = drawn % ROWS;
      questions = 0;
      const rows = await goTo(page, row);
      assert.equal(rows[0][0], row);
      const { measurements: [record] } = await daemon.json(`/v1/measurements?part_id=${rows[0][1]}`);
      assert.ok((await page.textContent(`.records tr[aria-rowindex="${row + 2}"]`)).includes(record.measured_mm.toFixed(4).slice(0, 6)), rows[0][1]);
      assert.ok(questions <= MOST_QUESTIONS, `${questions} questions for row ${row}`);
      assert.ok(await page.locator('.records tbody tr').count() <= MOST_ROWS);
    }
    assert.deepEqual(await findings(page), []);
    await picture(page, 'parts-long');
    await page.fill('[name="part_id"]', 'L-17');
    await page.press('[name="part_id"]', 'Enter');
    await page.waitForFunction(() => document.querySelectorAll('.records tbody tr').length === 1);
    assert.ok(await page.isHidden('.place'));
    assert.deepEqual(await inSight(page), [[0, 'L-17']]);
    await close(page);
  });

  it('scrolls by place, on without a gap, and takes the keys', async () => {
    const page = await open(browser, daemon, '#/parts?order=WO-L', VIEW);
    await page.waitForSelector('.place input');
    await page.$eval('.records', (list) => { list.scrollTop = (list.scrollHeight - list.clientHeight) / 2; });
    await rest(page);
    let [[first]] = await inSight(page);
    assert.ok(Math.abs(first - ROWS / 2) < 20, String(first));
    for (const by of [3000, 3000, 3000, 3000, 3000, -3000, -3000, -3000, -3000, -3000, -3000, -3000]) {
      await page.$eval('.records', (list, px) => { list.scrollTop += px; }, by);
      await page.waitForFunction(([from, isDown]) => (isDown ? document.querySelector('.place input').value - 1 > from : document.querySelector('.place input').value - 1 < from), [first, by > 0]);
      await rest(page);
      const rows = await page.$$eval('.records tbody tr[aria-rowindex]', (all) => all.map((row) => [Number(row.getAttribute('aria-rowindex')) - 2, row.cells[0].textContent]));
      assert.deepEqual(rows, rows.map((_, i) => [rows[0][0] + i, partAt(rows[0][0] + i)]));
      assert.ok(rows.length <= MOST_ROWS);
      [[first]] = await inSight(page);
    }
    await page.focus('.records');
    await page.keyboard.press('End');
    await seen(page, ROWS - 1);
    await page.keyboard.press('PageUp');
    await page.waitForFunction((last) => document.querySelector('.place input').value < last, ROWS - 9);
    await page.keyboard.press('Home');
    await seen(page, 0);
    await page.keyboard.press('PageDown');
    await page.waitForFunction(() => document.querySelector('.place input').value > 4);
    assert.ok((await inSight(page))[0][0] < 20);
    await close(page);
  });

  it('stays where somebody has scrolled to while it looks for new rows', async () => {
    const context = await browser.newContext(VIEW);
    const looking = await holdNext(context, NEW_ROWS);
    const page = await openIn(context, daemon, '#/parts?order=WO-L');
    await looking.asked;
    await page.$eval('.records', (list) => { list.scrollTop = (list.scrollHeight - list.clientHeight) / 2; });
    looking.go();
    await rest(page);
    const [[first]] = await inSight(page);
    assert.ok(Math.abs(first - ROWS / 2) < 20, String(first));
    await close(page);
  });

  it('goes to the row that was entered while it looks for new rows, and while it is read anew', async () => {
    const context = await browser.newContext(VIEW);
    const looking = await holdNext(context, NEW_ROWS);
    const page = await openIn(context, daemon, '#/parts?order=WO-L');
    await looking.asked;
    const finding = await holdNext(page, /\/v1\/measurements\/summary\?(?=.*received_to=)/);
    await page.getByLabel('Row').fill('43211');
    await page.getByLabel('Row').press('Enter');
    await finding.asked;
    const renewed = page.waitForResponse(NEW_ROWS);
    looking.go();
    await renewed;
    await timer(page, 1000);
    finding.go();
    const rows = await seen(page, 43_210);
    const reading = await holdNext(page, /\/v1\/measurements\?(?=.*sort=newest)/);
    const { measurements: [{ id }] } = await daemon.json(`/v1/measurements?part_id=${rows[0][1]}`);
    await daemon.send('POST', `/v1/measurements/${id}/notes`, { text: 'seen' });
    await reading.asked;
    await page.getByLabel('Row').fill('20001');
    await page.getByLabel('Row').press('Enter');
    reading.go();
    await seen(page, 20_000);
    await close(page);
  });

  it('comes back where it was, after a reload, after another view, and when values have come', async () => {
    const page = await open(browser, daemon, '#/parts?order=WO-L', VIEW);
    await page.waitForSelector('.place input');
    const [[, part]] = await goTo(page, 61_234);
    await page.waitForFunction(() => /at=38765/.test(location.hash));
    const first = async () => (await inSight(page))[0][1];
    await page.reload();
    await seen(page, 61_234);
    assert.equal(await first(), part);
    await page.$eval('.records tr[aria-rowindex="61238"] a', (link) => link.click());
    await page.waitForFunction(() => document.querySelectorAll('.records tbody tr').length === 1);
    await page.goBack();
    await seen(page, 61_234);
    assert.equal(await first(), part);
    await daemon.send('POST', '/v1/measurements', { designation: '25 H7', measured_mm: '25.01', part_id: 'L-new', order: 'WO-L' });
    const again = await openIn(page.context(), daemon, await page.evaluate(() => location.hash));
    await again.waitForFunction((id) => document.querySelector('.records tbody')?.textContent.includes(id) && !document.querySelector('.records').ariaBusy, part);
    await rest(again);
    assert.deepEqual((await inSight(again))[0], [61_235, part]);
    await again.focus('.records');
    await again.keyboard.press('Home');
    await again.waitForSelector('.records tr[aria-rowindex="2"] >> text=L-new');
    await close(again);
  });

  it('leaves the address alone once another is chosen', async () => {
    const page = await open(browser, daemon, '#/parts?order=WO-L', VIEW);
    await page.waitForSelector('.place input');
    await rest(page);
    // A view that comes late: the list still stands when its place is due.
    const address = await page.evaluate(async () => {
      history.pushState(null, '', '#/parts?part_id=L-17');
      document.querySelector('.records').scrollTop += 700;
      await new Promise((resolve) => { setTimeout(resolve, 1000); });
      return location.hash;
    });
    assert.equal(address, '#/parts?part_id=L-17');
    await close(page);
  });

  it('strikes out what was corrected, however far away the correction stands', async () => {
    const { measurements: [record] } = await daemon.json('/v1/measurements?part_id=L-500');
    await daemon.send('POST', `/v1/measurements/${record.id}/corrections`, { measured_mm: '25.0001', reason: 'slipped' });
    const page = await open(browser, daemon, '#/parts?order=WO-L&history=all&at=510', VIEW);
    await page.waitForSelector('.records tr.corrected');
    assert.deepEqual(await page.$$eval('.records tr.corrected', (all) => all.map((row) => row.cells[0].textContent)), ['L-500']);
    await close(page);
  });
});
