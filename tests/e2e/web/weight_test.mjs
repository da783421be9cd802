/** What the page takes until it answers, counted without a clock: requests one behind the other, and how much is done in one turn. */

import assert from 'node:assert/strict';
import { describe, it } from 'node:test';

import { browserName, close, open } from './support/browser.mjs';
import { browser, daemon } from './support/stage.mjs';

/** The document, its script, and the texts of a language: at 100 ms a round trip that leaves 0.6 s of 0.9 to the browser. */
const ROUND_TRIPS = 3;
const VALUES = 20_000;
/** Records that are read in one turn: less than 50 ms of a slow processor. */
const MOST_A_TURN = 1000;

describe('the page', () => {
  it(`takes a key after ${ROUND_TRIPS} round trips`, { skip: browserName !== 'chromium' }, async (test) => {
    const context = await browser.newContext({ locale: 'de-DE', serviceWorkers: 'block' });
    const page = await context.newPage();
    const devtools = await context.newCDPSession(page);
    await devtools.send('Network.enable');
    const trips = new Map();
    const callerOf = (stack) => stack && (stack.callFrames[0]?.url ?? callerOf(stack.parent));
    devtools.on('Network.requestWillBeSent', ({ request: { url }, initiator: { url: by, stack } }) => trips.set(url, 1 + (trips.get(by ?? callerOf(stack)) ?? 0)));
    await page.goto(`${daemon.url}/#/gauge/25H7`);
    await page.waitForSelector('#value');
    const before = new Map(trips);
    await page.waitForSelector('.echo .figures');
    const deepest = [...before].sort(([, one], [, other]) => other - one)[0];
    test.diagnostic(`${before.size} requests, the last ${deepest}`);
    assert.ok(deepest[1] <= ROUND_TRIPS, String(deepest));
    assert.ok(before.size >= 4, 'the document, style, script and texts at least');
    await context.close();
  });

  it('reads and draws many values in turns, between which it answers', async () => {
    await daemon.send('POST', '/v1/measurements', Array.from({ length: VALUES }, (_, i) => (
      { designation: '25 H7', measured_mm: (25.0105 + 0.004 * Math.sin(i / 3) * Math.cos(i * i)).toFixed(4), part_id: `SN-${i}`, characteristic: 'turns' })));
    const page = await open(browser, daemon, '#/parts');
    await page.evaluate(() => {
      globalThis.counted = { now: 0, most: 0, all: 0, together: null };
      const parse = JSON.parse;
      JSON.parse = (...given) => {
        counted.all += 1;
        counted.now += 1;
        counted.most = Math.max(counted.most, counted.now);
        if (counted.now === 1) {
          const { port1, port2 } = new MessageChannel();
          port1.onmessage = () => { counted.now = 0; port1.close(); };
          port2.postMessage(null);
        }
        return parse(...given);
      };
      new MutationObserver(() => {
        if (counted.together === null && document.querySelector('.trend .tiles dd')) counted.together = Boolean(document.querySelector('.control-chart'));
      }).observe(document.getElementById('main'), { childList: true, subtree: true });
    });
    await page.evaluate((address) => { location.hash = address; }, `#/trend?characteristic=turns&count=${VALUES}`);
    // The chart offers 10,000 and 100,000; an address may ask for another number.
    await page.waitForFunction((count) => document.querySelector('.control-chart')?.getAttribute('aria-label').includes(` ${count} `), VALUES);
    const { most, all, together } = await page.evaluate(() => counted);
    assert.ok(all >= VALUES, `${all} records read`);
    assert.ok(most <= MOST_A_TURN, `${most} records in one turn`);
    assert.equal(together, false, 'figures and chart are drawn in one turn');
    await close(page);
  });
});
