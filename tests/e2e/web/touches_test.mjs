/** How many keys and touches the daily tasks take: those of a person are counted, so that no change makes one longer unseen. */

import assert from 'node:assert/strict';
import { afterEach, describe, it } from 'node:test';

import { close, open } from './support/browser.mjs';
import { known, scan } from './support/scanner.mjs';
import { begin, browser, daemon, storedSince } from './support/stage.mjs';

/** Yesterday at ten, and the next morning. */
const YESTERDAY = '2026-03-09T10:00:00Z';
const NOW = '2026-03-10T09:00:00Z';

describe('the fewest keys and touches', () => {
  let page;
  afterEach(() => close(page));

  /** A page whose keys and touches are counted from here on. */
  const counting = async (address, options) => {
    await begin();
    page = await open(browser, daemon, address, options);
    await page.evaluate(() => {
      globalThis.counted = { keys: 0, touches: 0 };
      for (const [type, name] of [['keydown', 'keys'], ['pointerdown', 'touches']]) addEventListener(type, ({ isTrusted }) => { globalThis.counted[name] += isTrusted; }, { capture: true });
    });
  };
  const counted = () => page.evaluate(() => globalThis.counted);
  const type = async (line) => {
    await known(page);
    await page.keyboard.type(`${line}\n`);
    await known(page);
  };

  it('12 keys for a single bore at a station where nothing is configured', async () => {
    await counting('#/gauge');
    await page.waitForSelector('#designation');
    await type('25H7');
    await type('25.013');
    await page.waitForSelector('.verdict[data-verdict="good"]:not([data-provisional])');
    assert.deepEqual(await counted(), { keys: 12, touches: 0 });
  });

  it('no touch for five characteristics of a plan, and one for their certificate', async () => {
    const sizes = [['t-1', '25 H7', '25.01'], ['t-2', '40 H8', '40.02'], ['t-3', '30 k6', '30.01'], ['t-4', '8 P9', '7.97'], ['t-5', '60 h7', '59.99']];
    await daemon.send('PUT', '/v1/plans/TOUCH-1', { characteristics: sizes.map(([name, designation]) => ({ name, designation })) });
    await counting('#/gauge');
    await page.waitForSelector('.plan select:visible');
    await page.focus('#value');
    const lines = ['TOUCH-1', 'SN-T1', ...sizes.map(([, , value]) => value)];
    for (const line of lines) await scan(page, line);
    await page.waitForFunction(() => document.querySelectorAll('.recent li.stored').length === 5);
    assert.deepEqual((await storedSince()).map(({ characteristic, part_id: part }) => [characteristic, part]), sizes.map(([name]) => [name, 'SN-T1']));
    assert.equal((await counted()).touches, 0);
    const [sheet] = await Promise.all([page.context().waitForEvent('response', (answer) => answer.url().includes('/v1/certificates')), page.click('.recent .fix a')]);
    assert.equal(sheet.headers()['content-type'], 'application/pdf');
    assert.equal((await counted()).touches, 1);
  });

  it('two touches for the certificate of a part that Parts shows', async () => {
    await daemon.send('POST', '/v1/measurements', { designation: '25 H7', measured_mm: '25.01', part_id: 'SN-T2' });
    await counting('#/parts?part_id=SN-T2');
    await page.waitForSelector('.records tbody tr');
    const [sheet] = await Promise.all([
      page.context().waitForEvent('response', (answer) => answer.url().includes('/v1/certificates')),
      page.click('.certificate summary').then(() => page.click('.certificate a')),
    ]);
    assert.equal(sheet.headers()['content-type'], 'application/pdf');
    assert.equal((await counted()).touches, 2);
  });

  it('one touch for a part of yesterday', async () => {
    await daemon.send('POST', '/v1/measurements', [{ designation: '25 H7', measured_mm: '25.01', part_id: 'SN-T3', measured_at: YESTERDAY }]);
    await counting('#/parts', { at: NOW, timezoneId: 'Europe/Berlin' });
    await page.waitForSelector('.records tbody tr');
    await page.click('.chips >> text=Yesterday');
    await page.waitForFunction(() => document.querySelectorAll('.records tbody tr').length === 1 && /SN-T3/.test(document.querySelector('.records tbody').textContent));
    assert.deepEqual(await counted(), { keys: 0, touches: 1 });
  });
});
