/**
 * What a value demands is one state: done, corrected and moved values are asked about once, and leave no tile
 * behind.
 *
 * Tried, and held here:
 * - Say the cause in an outage, or before a slow answer: asked once
 * - Correct a good value to a reject: asked once; the note is also on the correction
 * - Correct a reject to a good value: nothing is asked
 * - Correct the part of a value: the characteristic is due again
 * - Measure a part twice, in another tab or at another station: *SN-1 was measured at 04:26*
 */

import assert from 'node:assert/strict';
import { before, beforeEach, describe, it } from 'node:test';

import { close, findings, open, openIn, picture, timer } from './support/browser.mjs';
import { eventually } from './support/eventually.mjs';
import { hold } from './support/hold.mjs';
import { answer } from './support/reactions.mjs';
import { known, scan } from './support/scanner.mjs';
import { begin, browser, daemon, storedSince } from './support/stage.mjs';

describe('what a value demands', () => {
  let page;

  before(async () => {
    await daemon.send('PUT', '/v1/catalogues/turning', { causes: ['Insert worn', 'Wrong offset'], measures: ['Insert changed', 'Part scrapped'] });
    await daemon.send('PUT', '/v1/plans/4711-A', { characteristics: [
      { name: 'bore-A', designation: '25 H7', catalogue: 'turning' }, { name: 'bore-B', designation: '40 H8' }, { name: 'length', nominal_mm: 120, feature: 'shaft', upper_um: 300, lower_um: -300 }] });
  });
  beforeEach(begin);

  const station = async (part) => {
    page = await open(browser, daemon, `#/gauge?plan=4711-A${part ? `&part_id=${part}` : ''}`);
    await page.waitForSelector('.tiles-of-plan li');
    await known(page);
    await page.waitForSelector('.echo .figures');
  };
  const line = (text) => scan(page, text);
  const verdict = (word, of = ':not([data-provisional])') => page.waitForSelector(`.verdict[data-verdict="${word}"]${of}`);
  const marks = () => page.$$eval('.tiles-of-plan li', (all) => all.map((tile) => tile.querySelector('.shape')?.dataset.verdict));
  const hasMarks = (...wanted) => eventually(async () => assert.deepEqual(await marks(), wanted));
  const isUp = () => page.waitForSelector('.link[data-state="up"]');
  const say = (...texts) => answer(page, ...texts);
  const notes = async () => (await daemon.stored('history=all&notes=shown')).slice(-(await storedSince()).length)
    .map((record) => [record.measured_mm, ...(record.notes ?? []).map((note) => [note.cause, note.measure])]);

  it('is not shown as said where the service refuses the note', async () => {
    await station('SN-1');
    await page.route('**/notes', (route) => (route.request().method() === 'GET' ? route.continue()
      : route.fulfill({ status: 422, contentType: 'application/problem+json', body: '{"code":"request.invalid","detail":"no such cause"}' })));
    await line('25.03');
    await say('Insert worn', 'Insert changed');
    await page.waitForFunction(() => /^The note was not stored: ./.test(document.querySelector('.recent .noted')?.textContent));
    await page.reload();
    await page.waitForFunction(() => /^The note was not stored: ./.test(document.querySelector('.recent .noted')?.textContent));
    assert.deepEqual(await notes(), [[25.03]]);
    await close(page);
  });

  it('is asked once over an outage, and over an answer that takes longer than two taps', async () => {
    await station('SN-1');
    await daemon.stop();
    await line('25.03');
    await say('Insert worn', 'Insert changed');
    await daemon.start();
    await isUp();
    await page.waitForSelector('.recent .stored');
    assert.ok(await page.isHidden('.reactions'));
    await page.click('.arrived button');
    const release = await hold(page, '**/v1/measurements');
    await page.click('.tiles-of-plan li:first-child button');
    await page.waitForSelector('.echo .figures');
    await line('25.04');
    await say('Wrong offset', 'Part scrapped');
    await release();
    await isUp();
    await eventually(async () => assert.deepEqual(await notes(), [[25.03, ['Insert worn', 'Insert changed']], [25.04, ['Wrong offset', 'Part scrapped']]]));
    assert.ok(await page.isHidden('.reactions'));
    page.errors.length = 0;
    await close(page);
  });

  it('moves with a part that is corrected: its characteristic is due again', async () => {
    await station('SN-8003');
    await line('25.01');
    await verdict('good');
    await page.click('.recent .fix button:last-child');
    await line('SN-8004');
    await page.waitForSelector('.recent li.corrected');
    assert.match(await page.textContent('.recent li.corrected'), /of another part/);
    await hasMarks(undefined, undefined, undefined);
    await line('40.01');
    await line('120.1');
    await page.waitForFunction(() => document.querySelector('.tiles-of-plan [aria-current]')?.textContent.includes('bore-A'));
    await hasMarks(undefined, 'good', 'good');
    await line('25.012');
    await page.waitForFunction(() => document.querySelector('.progress')?.textContent === 'All 3 measured');
    await isUp();
    const inForce = (await daemon.stored('part_id=SN-8003')).map(({ characteristic, measured_mm }) => [characteristic, measured_mm]);
    assert.deepEqual(inForce, [['bore-B', 40.01], ['length', 120.1], ['bore-A', 25.012]]);
    await close(page);
  });

  it('moves with a part that is corrected when all was measured', async () => {
    await station('SN-8005');
    for (const value of ['25.01', '40.01', '120.1']) await line(value);
    await page.waitForFunction(() => document.querySelector('.progress')?.textContent === 'All 3 measured');
    // The size above the verdict is the size that was judged.
    await verdict('good');
    assert.match(await page.textContent('.echo'), /119\.700 to 120\.300/);
    await page.waitForFunction(() => document.querySelectorAll('.recent .stored .fix').length === 3);
    await page.click('.recent li:last-child .fix button:last-child');
    await line('SN-8006');
    await page.waitForFunction(() => document.querySelector('.tiles-of-plan [aria-current]')?.textContent.includes('bore-A'));
    await hasMarks(undefined, 'good', 'good');
    await isUp(); // a value that is under way would be stored in the next test
    await close(page);
  });

  it('is of the value in force: a correction asks for a cause, or asks no more for one', async () => {
    await station('SN-5');
    await line('25.012');
    await verdict('good');
    await page.waitForSelector('.recent .stored .fix');
    await page.keyboard.press('Control+z');
    await line('25.040');
    await page.waitForSelector('.reactions .catalogue');
    await say('Insert worn', 'Insert changed');
    await page.waitForFunction(() => document.querySelector('.recent .stored .noted'));
    await isUp();
    await page.keyboard.press('Control+z'); // what was said of it holds for its correction
    await line('25.030');
    await page.waitForFunction(() => document.querySelector('.recent .stored .figure')?.textContent === '25.030');
    assert.ok(await page.isHidden('.reactions'));
    assert.match(await page.textContent('.recent .stored'), /Insert worn → Insert changed/);
    await isUp();
    await eventually(async () => assert.deepEqual(await notes(), [[25.012], [25.04, ['Insert worn', 'Insert changed']], [25.03, ['Insert worn', 'Insert changed']]]));
    await line('SN-6');
    await known(page);
    await line('25.05');
    await page.waitForSelector('.reactions .catalogue');
    await page.waitForSelector('.recent li:first-child.stored .fix');
    await page.keyboard.press('Control+z');
    await line('25.003');
    await page.waitForSelector('.reactions', { state: 'hidden' });
    await line('40.01'); // the station is free again
    await hasMarks('good', 'good', undefined);
    await isUp();
    await close(page);
  });

  it('takes a double tap on a cause for one: it is no action', async () => {
    await station('SN-TAP');
    await line('25.04');
    await page.waitForSelector('.reactions .catalogue');
    await page.evaluate(() => {
      const now = performance.now();
      const tap = (ago) => {
        const event = new MouseEvent('click', { bubbles: true, cancelable: true, detail: 1 });
        Object.defineProperty(event, 'timeStamp', { value: now - ago });
        document.querySelector('.choices-of button').dispatchEvent(event);
      };
      tap(1000);
      tap(800);
    });
    assert.match(await page.textContent('.reactions'), /Insert worn.*What is done about it/);
    await say('Part scrapped');
    await isUp();
    await eventually(async () => assert.deepEqual(await notes(), [[25.04, ['Insert worn', 'Part scrapped']]]));
    await close(page);
  });

  it('takes a cause that was given elsewhere, and asks no more', async () => {
    await station('SN-N');
    await line('25.04');
    await page.waitForSelector('.reactions .catalogue');
    await page.waitForSelector('.recent li:first-child.stored');
    const [{ id }] = await storedSince('SN-N');
    await daemon.send('POST', `/v1/measurements/${id}/notes`, { cause: 'Wrong offset', measure: 'Part scrapped' });
    await page.waitForSelector('.reactions', { state: 'hidden' });
    await line('40.01');
    await hasMarks('reject', 'good', undefined);
    assert.deepEqual((await daemon.json(`/v1/measurements/${id}/notes`)).notes.map(({ cause, measure }) => [cause, measure]), [['Wrong offset', 'Part scrapped']]);
    await isUp();
    await close(page);
  });

  it('names the characteristic in the list, with the limits of a drawing', async () => {
    await station('SN-7');
    for (const value of ['25.01', '40.01', '120.1']) await line(value);
    await page.waitForFunction(() => document.querySelectorAll('.recent .stored').length === 3);
    assert.deepEqual(await page.$$eval('.recent li .aside:nth-of-type(3)', (all) => all.map((each) => each.textContent.replace(/ · \d\d:\d\d:\d\d$/, ''))),
      ['SN-7 · length · 119.700 to 120.300 mm', 'SN-7 · bore-B · Ø 40 H8', 'SN-7 · bore-A · Ø 25 H7']);
    await close(page);
  });

  it('ends a plan with the verdict of the part, as large as that of a value, with the service and without', async () => {
    await station('SN-6001');
    const size = () => page.$eval('.verdict .word', (word) => getComputedStyle(word).fontSize);
    await line('25.012');
    await verdict('good');
    const large = await size();
    await line('40.05');
    await verdict('reject');
    await line('120.1');
    const says = (source) => page.waitForFunction((text) => new RegExp(text).test(document.querySelector('.verdict').textContent), source);
    await says('RejectPart SN-6001 · bore-B Rejectlength 120.100 mm · Good');
    assert.deepEqual([await page.getAttribute('.verdict', 'data-verdict'), await size() <= large], ['reject', true]);
    assert.match(await page.textContent('.echo'), /119\.700 to 120\.300/); // the size above it is the one measured last
    await picture(page, 'gauge-part-verdict');
    await page.waitForFunction(() => document.querySelectorAll('.recent .stored .fix').length === 3);
    await page.click('.recent li:nth-child(2) .fix button'); // the reject was a slip of the gauge
    await page.waitForSelector('.verdict[data-verdict="correcting"]');
    assert.match(await page.textContent('.verdict'), /Correct 40\.050\smm.*SN-6001 · bore-B · Ø 40 H8.*40\.000 to 40\.039/);
    assert.notEqual(await page.$eval('.verdict', (panel) => getComputedStyle(panel).backgroundColor), 'rgb(166, 15, 34)');
    assert.deepEqual(await findings(page), []);
    await page.keyboard.press('Escape');
    await verdict('reject');
    await page.click('.recent li:nth-child(2) .fix button');
    await line('40.01');
    await says('GoodPart SN-6001All 3 measured');
    await verdict('good');
    await daemon.stop();
    await line('SN-6002');
    await known(page);
    for (const value of ['25.012', '40.01', '120.9']) await line(value);
    await verdict('rework', '[data-provisional="away"]');
    await says('ReworkPart SN-6002 · length Rework');
    await timer(page, 200); // and a wait for the answer shows the value alone no longer than that
    assert.match(await page.textContent('.verdict'), /Part SN-6002/);
    await daemon.start();
    await isUp();
    page.errors.length = 0;
    await close(page);
  });

  it('says that a part was measured, here, in another tab and at another station', async () => {
    await station('SN-9');
    for (const value of ['25.01', '40.01', '120.1']) await line(value);
    await line('SN-10');
    await known(page);
    await line('SN-9');
    await page.waitForFunction(() => /SN-9 was measured at \d\d:\d\d/.test(document.querySelector('.of-plan')?.textContent));
    await hasMarks('good', 'good', 'good');
    await line('25.012');
    assert.match(await page.textContent('#entry-note'), /Not stored.*All of SN-9 is measured/);
    await page.press('.of-plan button', 'Enter'); // after rework it is measured anew
    assert.equal(await page.evaluate(() => document.activeElement.id), 'value');
    await hasMarks(undefined, undefined, undefined);
    await page.keyboard.press('Escape');
    const other = await openIn(page.context(), daemon, '#/gauge?plan=4711-A&part_id=SN-9');
    await other.waitForSelector('.tiles-of-plan li');
    await known(other);
    await line('25.011');
    await other.waitForFunction(() => /SN-9 was measured at/.test(document.querySelector('.of-plan')?.textContent) && document.querySelector('.tiles-of-plan .shape'));
    assert.deepEqual(other.errors, []);
    await other.close();
    await daemon.send('POST', '/v1/measurements', { designation: '25 H7', measured_mm: '25.013', part_id: 'SN-11', characteristic: 'bore-A', machine: 'M2' });
    await line('SN-11');
    await page.waitForFunction(() => /SN-11 was measured at .*M2/.test(document.querySelector('.of-plan')?.textContent));
    assert.match(await page.textContent('.tiles-of-plan [aria-current]'), /bore-A/, 'nobody measures another characteristic unawares');
    await close(page);
  });
});
