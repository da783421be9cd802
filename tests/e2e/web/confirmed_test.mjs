/** A value far outside that somebody confirmed says so in its record; figures leave it out when they are asked to. The tool goes into each record. */

import assert from 'node:assert/strict';
import { beforeEach, describe, it } from 'node:test';

import { close, findings, hashOf, open, picture } from './support/browser.mjs';
import { untilPoints } from './support/chart.mjs';
import { scan } from './support/scanner.mjs';
import { begin, browser, daemon, storedSince } from './support/stage.mjs';

const PART = 'SN-77';

describe('a confirmed value', () => {
  beforeEach(begin);

  const station = async (address) => {
    const page = await open(browser, daemon, address);
    await page.waitForSelector('.echo .figures');
    return page;
  };
  const stored = (page, count) => page.waitForFunction((wanted) => document.querySelectorAll('.recent .stored .fix').length === wanted
    && document.querySelector('.link').dataset.state === 'up', count);
  const confirm = async (page, text) => {
    await scan(page, text);
    await page.getByRole('button', { name: `Store ${text} mm` }).click();
  };
  const records = async () => (await storedSince()).map(({ measured_mm, confirmed, tool, correction_of }) => [measured_mm, confirmed, tool, Boolean(correction_of)]);

  it('says so in its record, in the list and at its part, over a correction of its part, and other values do not', async () => {
    const page = await station(`#/gauge/25H7?part_id=${PART}&characteristic=bore-C&tool=T12`);
    await scan(page, '25.01');
    await stored(page, 1);
    await confirm(page, '26.5');
    await stored(page, 2);
    assert.match(await page.textContent('.recent li:first-child'), /confirmed/);
    assert.doesNotMatch(await page.textContent('.recent li:last-child'), /confirmed/);
    await page.click('.recent li:first-child .fix button:last-child');
    await scan(page, `${PART}-A`);
    await page.waitForSelector('.recent li.corrected');
    await stored(page, 2);
    await page.click('.recent li:first-child .fix button:first-child');
    await scan(page, '25.011');
    await page.waitForFunction(() => document.querySelectorAll('.recent li.corrected').length === 2);
    await stored(page, 2);
    await page.click('.recent li:first-child .fix button:first-child');
    await confirm(page, '27');
    await page.waitForFunction(() => document.querySelectorAll('.recent li.corrected').length === 3);
    await stored(page, 2);
    assert.deepEqual((await daemon.stored('history=all')).slice(-5).map(({ measured_mm, confirmed, correction_of }) => [measured_mm, confirmed, Boolean(correction_of)]),
      [[25.01, undefined, false], [26.5, true, false], [26.5, true, true], [25.011, undefined, true], [27, true, true]]);
    await page.evaluate((part) => { location.hash = `#/parts?part_id=${part}-A`; }, PART);
    await page.waitForSelector('.records tbody tr');
    assert.match(await page.textContent('.records tbody'), /confirmed/);
    // A correction at the desk keeps it, or is confirmed itself.
    await page.click('.records .quiet >> text=Correct');
    await page.fill('dialog label:has-text("Measured value") input', '28');
    await page.fill('dialog label:has-text("Reason") input', 'read anew');
    await page.click('dialog .primary');
    await page.waitForFunction(() => /far outside/.test(document.querySelector('dialog .note').textContent));
    await page.click('dialog .primary');
    await page.waitForSelector('dialog', { state: 'detached' });
    assert.deepEqual((await records()).at(-1), [28, true, 'T12', true]);
    await close(page);
  });

  it('is left out of list, chart and overview at a touch, by a rule that is said', async () => {
    await daemon.send('POST', '/v1/measurements', [...Array.from({ length: 12 }, (_, i) => ({ designation: '25 H7', measured_mm: `25.0${10 + i % 5}`, characteristic: 'bore-D', tool: i % 2 ? 'T1' : 'T2' })),
      { designation: '25 H7', measured_mm: '26', characteristic: 'bore-D', tool: 'T1', confirmed: true }]);
    const page = await open(browser, daemon, '#/trend?characteristic=bore-D', { viewport: { width: 1366, height: 768 } });
    await untilPoints(page, 13);
    await page.click('.of-more summary');
    await page.click('.chips >> text=Without confirmed values');
    await untilPoints(page, 12);
    assert.match(hashOf(page), /confirmed=false/);
    assert.match(await page.textContent('.trend form'), /confirmed values far outside the limits/);
    await daemon.send('POST', '/v1/measurements', [{ designation: '25 H7', measured_mm: '27', characteristic: 'bore-D', confirmed: true }, { designation: '25 H7', measured_mm: '25.012', characteristic: 'bore-D', tool: 'T1' }]);
    await untilPoints(page, 13);
    await picture(page, 'trend-without-confirmed');
    assert.deepEqual(await findings(page), []);
    await page.fill('[name="tool"]', 'T1');
    await page.press('[name="tool"]', 'Tab');
    await untilPoints(page, 7);
    assert.match(hashOf(page), /tool=T1/);
    // Boxes by the tool: quartiles of each, in the address.
    await page.fill('[name="tool"]', '');
    await page.press('[name="tool"]', 'Tab');
    await untilPoints(page, 13);
    await page.click('.boxes summary');
    await page.selectOption('[name="boxes"]', 'tool');
    await page.waitForFunction(() => document.querySelectorAll('.boxes .box').length === 2);
    assert.match(await page.textContent('.boxes .aside'), /T1: n = 7 · T2: n = 6/);
    assert.deepEqual(await page.$$eval('.boxes .limit', (all) => all.map(({ textContent }) => textContent)), ['U +21', 'L 0']);
    assert.match(hashOf(page), /boxes=tool/);
    assert.deepEqual(await findings(page), []);
    await page.$eval('.boxes', (boxes) => boxes.scrollIntoView());
    await picture(page, 'trend-boxes');
    await page.evaluate(() => { location.hash = '#/overview?confirmed=false&tool=T1'; });
    await page.waitForSelector('.overview .scroll[data-settled]');
    assert.match(await page.textContent('.overview tbody'), /bore-D7/);
    await page.evaluate(() => { location.hash = '#/parts?confirmed=false&characteristic=bore-D'; });
    await page.waitForFunction(() => document.querySelectorAll('.records tbody tr').length === 13);
    await close(page);
  });

  it('has the tool of the station, which is kept, scanned, and in the address', async () => {
    const page = await station('#/gauge/25H7');
    await scan(page, 'T:T7');
    await scan(page, '25.01');
    await stored(page, 1);
    assert.match(hashOf(page), /tool=T7/);
    await page.reload();
    await page.waitForSelector('.echo .figures');
    assert.match(await page.textContent('.more-line'), /Tool T7/);
    await scan(page, '25.011');
    await page.waitForFunction(() => document.querySelectorAll('.recent .stored .fix').length === 2);
    assert.deepEqual(await records(), [[25.01, undefined, 'T7', false], [25.011, undefined, 'T7', false]]);
    await close(page);
  });
});
