/**
 * Control charts of one characteristic, as values come.
 *
 * Tried, and held here:
 * - Fit and Trend with one answer a second late, another chosen meanwhile: the last choice counts
 * - Trend while two stations measure two sizes: stays at the size shown first
 * - 60,000 old values, 100 asked for: the newest, one request
 * - Trend in eight tabs: one stream for all tabs, none for a hidden one
 * - Trend, then Gauge before it has loaded: a view that was left changes nothing
 * - Trend: a drawing's limits; a new characteristic; the service back again: offered, at once, taken back
 */

import assert from 'node:assert/strict';
import { after, afterEach, before, describe, it } from 'node:test';

import { close, drawn, hashOf, open, openIn, picture } from './support/browser.mjs';
import { marksOf, untilPoints } from './support/chart.mjs';
import { eventually } from './support/eventually.mjs';
import { Gate } from './support/gate.mjs';
import { holdAll, waits } from './support/hold.mjs';
import { browser, daemon } from './support/stage.mjs';

let page;

afterEach(() => close(page));

const hash = () => hashOf(page);

describe('answers that come late', () => {
  /** Until a question there has been answered or given up, and a frame has been drawn since. */
  const ended = async (where) => {
    const isIt = (request) => request.url().includes(where);
    await Promise.race(['requestfinished', 'requestfailed'].map((event) => page.waitForEvent(event, isIt)));
    await drawn(page);
  };

  it('never overwrite a newer one, nor the next view', async () => {
    page = await open(browser, daemon, '#/fit/25H7/g6');
    await page.waitForSelector('.fit .headline');
    let go = await holdAll(page, '**/v1/fits/25H7/s6');
    let over = ended('/v1/fits/25H7/s6');
    await page.click('.preferred button:has-text("H7/s6")');
    await page.click('.preferred button:has-text("H7/h6")');
    await page.waitForFunction(() => decodeURIComponent(location.hash).startsWith('#/fit/25H7/h6'));
    await page.waitForFunction(() => document.querySelector('.fit .headline')?.textContent === 'Clearance fit');
    go();
    await over;
    assert.equal(await page.textContent('.fit .headline'), 'Clearance fit');
    await page.fill('#fit', 'nonsense');
    await page.press('#fit', 'Enter');
    assert.equal(await page.$('.fit .headline'), null);

    go = await holdAll(page, '**/v1/measurements?**');
    over = ended('/v1/measurements?');
    await page.evaluate(() => { location.hash = '#/trend'; });
    await page.waitForSelector('.trend');
    await page.evaluate(() => { location.hash = '#/gauge/25H7'; });
    await page.waitForSelector('.entry');
    go();
    await over;
    assert.ok(hash().startsWith('#/gauge/25H7'), hash());
  });
});

describe('a chart', () => {
  it('is of the characteristic that was chosen last, however late the answer for another comes', async () => {
    for (const [characteristic, designation, measured_mm] of [['late-B', '40 H7', '40.01'], ['late-C', '30 H7', '30.01']]) {
      await daemon.send('POST', '/v1/measurements', { designation, measured_mm, characteristic });
    }
    page = await open(browser, daemon, '#/trend?characteristic=late-A');
    await page.waitForSelector('#trend-characteristic option[value="late-C"]', { state: 'attached' });
    const go = await holdAll(page, '**/v1/measurements?*characteristic=late-B*');
    await page.selectOption('#trend-characteristic', 'late-B');
    await waits(page);
    await page.selectOption('#trend-characteristic', 'late-C');
    await untilPoints(page, 1);
    await waits(page, false); // the other is given up: its answer is nobody's
    go();
    assert.deepEqual([await page.inputValue('#trend-characteristic'), await page.inputValue('#trend-designation')], ['late-C', '30 H7']);
    assert.match(hash(), /characteristic=late-C&designation=30/);
    assert.match(await page.textContent('.trend > .scroll tbody tr'), /30\.010 mm/);
  });
});

describe('the trend', () => {
  let gate;
  before(async () => { gate = await new Gate(daemon).open(); });
  after(() => gate.close());
  const untilStreams = (count) => eventually(() => assert.equal(gate.streams, count));

  it('holds no stream while nobody sees it, and misses nothing meanwhile', async () => {
    page = await open(browser, gate, '#/trend');
    await page.waitForSelector('.trend form');
    const hide = (hidden) => page.evaluate((value) => {
      Object.defineProperty(document, 'hidden', { value, configurable: true });
      document.dispatchEvent(new Event('visibilitychange'));
    }, hidden);
    await untilStreams(1);
    await hide(true);
    await untilStreams(0);
    await daemon.send('POST', '/v1/measurements', { designation: '31 H7', measured_mm: '31.002' });
    await hide(false);
    await untilStreams(1);
    await untilPoints(page, 1);
  });

  it('shares one stream among all tabs of a browser: eight of them load and go on', async () => {
    page = await open(browser, gate, '#/trend?designation=32 H7');
    await untilStreams(1);
    const tabs = [];
    for (let i = 0; i < 7; ++i) tabs.push(await openIn(page.context(), gate, '#/trend?designation=32 H7'));
    for (const tab of tabs) await tab.waitForSelector('.trend .empty');
    await untilStreams(1);
    await daemon.send('POST', '/v1/measurements', { designation: '32 H7', measured_mm: '32.002' });
    for (const tab of [page, ...tabs]) await untilPoints(tab, 1);
    for (const tab of tabs) await tab.close();
    await untilStreams(1);
  });

  it('asks once for the newest, however much older there is', async () => {
    const old = Array.from({ length: 3000 }, (_, i) => ({ designation: '33 H7', measured_mm: '33.01', characteristic: 'old', measured_at: `2026-01-0${1 + i % 9}T08:00:00Z` }));
    await daemon.send('POST', '/v1/measurements', old);
    await daemon.send('POST', '/v1/measurements', ['33.001', '33.002'].map((measured_mm) => ({ designation: '33 H7', measured_mm, characteristic: 'old' })));
    const asked = [];
    page = await open(browser, daemon, '');
    // What came since it was asked, which the page looks for when it follows the events, is another question.
    page.on('request', (request) => /\/v1\/measurements\?(?!.*\bafter=)/.test(request.url()) && asked.push(request.url()));
    await page.evaluate(() => { location.hash = '#/trend?characteristic=old&count=50'; });
    await untilPoints(page, 50);
    assert.equal(asked.length, 1);
    assert.match(await page.textContent('.trend > .scroll tbody tr'), /33\.002 mm/);
  });

  it('shows the last values and those that come', async () => {
    const values = Array.from({ length: 30 }, (_, i) => (25.001 + i / 1000).toFixed(3));
    await daemon.send('POST', '/v1/measurements', values.map((text) => ({ designation: '25 H7', measured_mm: text, characteristic: 'bore-A' })));
    await daemon.send('POST', '/v1/measurements', { designation: '10 f7', measured_mm: '9.98' });
    page = await open(browser, daemon, '#/trend?characteristic=bore-A&count=50');
    await untilPoints(page, 30);
    assert.deepEqual([(await marksOf(page, 'good')).length, (await marksOf(page, 'reject')).length], [21, 9]);
    const counts = () => page.$$eval('.tiles dd', (tiles) => tiles.slice(0, 3).map((tile) => Number(tile.textContent)));
    assert.deepEqual(await counts(), [21, 0, 9]);
    await daemon.send('POST', '/v1/measurements', [
      { designation: '25 H7', measured_mm: '24.999', characteristic: 'bore-A' },
      { designation: '25 H7', measured_mm: '24.998', characteristic: 'bore-B' }]);
    await untilPoints(page, 31);
    assert.deepEqual(await counts(), [21, 1, 9]);
    assert.equal((await marksOf(page, 'rework')).length, 1);
    const [corrected] = (await daemon.json('/v1/measurements?characteristic=bore-A&verdict=rework')).measurements;
    await daemon.send('POST', `/v1/measurements/${corrected.id}/corrections`, { measured_mm: '25.01', reason: 'test' });
    await page.waitForFunction(() => document.querySelector('.tiles dd')?.textContent === '22');
    assert.deepEqual(await counts(), [22, 0, 9]);
    await picture(page, 'trend', { fullPage: true });
  });

  it('keeps a value that is stored while the list is read', async () => {
    const post = (text) => daemon.send('POST', '/v1/measurements', { designation: '25 H7', measured_mm: text, characteristic: 'slow-list' });
    await post('25.001');
    page = await open(browser, daemon, '#/parts');
    await page.evaluate(() => {
      globalThis.heard = 0;
      const { set } = Object.getOwnPropertyDescriptor(MessagePort.prototype, 'onmessage');
      Object.defineProperty(MessagePort.prototype, 'onmessage', { set(take) { set.call(this, (message) => { take(message); globalThis.heard += 1; }); } });
    });
    let asked = 0;
    // Each answer of the list is older than a value that was stored before it came: the first time before the
    // page follows the events, the second time while it does.
    await page.route('**/v1/measurements?*sort=newest*', async (route) => {
      const answer = await route.fetch();
      const before = await page.evaluate(() => globalThis.heard);
      await post(`25.00${++asked + 1}`);
      if (asked > 1) await page.waitForFunction((count) => globalThis.heard > count, before);
      await route.fulfill({ response: answer });
    });
    const points = (count) => untilPoints(page, count);
    await page.evaluate(() => { location.hash = '#/trend?characteristic=slow-list&designation=25+H7'; });
    await points(2);
    await page.selectOption('#trend-count', '200');
    await points(3);
    assert.equal(asked, 2, 'the list is read once for each choice');
  });

  it('stays at the size that was shown first, whatever another station measures', async () => {
    await daemon.send('POST', '/v1/measurements', ['25.01', '25.011'].map((text) => ({ designation: '25 H7', measured_mm: text, characteristic: 'hops' })));
    page = await open(browser, daemon, '#/trend?characteristic=hops');
    const points = (count) => untilPoints(page, count);
    await points(2);
    const measure = (designation, measured) => daemon.send('POST', '/v1/measurements', { designation, measured_mm: measured, characteristic: 'hops' });
    await measure('25 H7', '25.0115');
    await points(3); // from here on it follows the events
    for (const [designation, measured] of [['40 H7', '40.01'], ['25 H7', '25.012'], ['25 H7', '25.013'], ['40 H7', '40.011'], ['25 H7', '25.014']]) await measure(designation, measured);
    await points(6); // events come in their order: all of them
    assert.equal(await page.inputValue('#trend-designation'), '25 H7');
    assert.deepEqual(await page.$$eval('#trend-designation option', (all) => all.map(({ value }) => value)), ['25 H7', '40 H7']);
  });

  it('offers limits of a drawing and what is measured for the first time, and takes back its note when the service is back', async () => {
    const groove = (measured_mm, upper_um) => ({ nominal_mm: 12, feature: 'hole', upper_um, lower_um: 0, measured_mm, characteristic: 'groove' });
    await daemon.send('POST', '/v1/measurements', [groove('12.01', 30), groove('12.02', 30), groove('12.03', 50)]);
    page = await open(browser, daemon, '#/trend?characteristic=groove&count=77');
    const offered = (name) => page.$$eval(`#trend-${name} option`, (all) => all.map(({ value }) => value));
    const points = (count) => untilPoints(page, count);
    await points(1);
    assert.deepEqual(await offered('designation'), ['12 +30/0 µm', '12 +50/0 µm']);
    assert.equal(await page.inputValue('#trend-count'), '77');
    await page.selectOption('#trend-designation', '12 +30/0 µm');
    await points(2);
    await daemon.send('POST', '/v1/measurements', { designation: '25 H7', measured_mm: '25.01', characteristic: 'first-time' });
    await page.waitForSelector('#trend-characteristic option[value="first-time"]', { state: 'attached' });
    await page.route('**/v1/measurements?*', (route) => route.abort());
    await page.selectOption('#trend-count', '200');
    await page.waitForFunction(() => (document.querySelector('.trend .note')?.textContent ?? '') !== '');
    await page.unroute('**/v1/measurements?*');
    await daemon.send('POST', '/v1/measurements', groove('12.015', 30));
    await page.waitForFunction(() => document.querySelector('.trend .note')?.textContent === '');
    page.errors.length = 0;
  });
});
