/**
 * The service is killed, the page and every value stay: the service worker, two tabs, a scanner that goes on.
 *
 * Tried, and held here:
 * - Two tabs, and what became of the values of an outage: each under its own name
 */

import assert from 'node:assert/strict';
import { afterEach, before, beforeEach, describe, it } from 'node:test';

import { close, launch, open, openIn, picture } from './support/browser.mjs';
import { Daemon } from './support/daemon.mjs';
import { eventually } from './support/eventually.mjs';
import { scan } from './support/scanner.mjs';

describe('while the service is away', () => {
  let browser;
  let daemon;
  let page;

  before(async () => { browser = await launch(); });
  beforeEach(async () => { daemon = await new Daemon().start(); });
  afterEach(async () => {
    await close(page);
    await daemon.cleanup();
  });

  const kept = (file) => page.waitForFunction(async (name) => (await (await caches.open('page')).keys())
    .some(({ url }) => new URL(url).pathname.endsWith(name)), file);

  it('the page itself loads, in its language, judges, and sends afterwards', async () => {
    page = await open(browser, daemon, '#/gauge/25H7', { serviceWorkers: 'allow', locale: 'de-DE' });
    await page.waitForSelector('.echo .figures');
    for (const file of ['/', '/app.js', '/lang/de.js', '/style/page.css']) await kept(file);
    await daemon.kill();
    const again = await page.context().newPage();
    await again.goto(`${daemon.url}/#/gauge/25H7`);
    await again.waitForSelector('.echo .figures');
    await again.focus('#value');
    await scan(again, '25.03');
    await again.waitForSelector('.verdict[data-provisional="away"][data-verdict="reject"]');
    assert.match(await again.textContent('#link'), /nicht erreichbar · 1/);
    assert.equal(await again.textContent('.unkept'), '');
    await picture(again, 'outage');
    await daemon.start();
    await again.waitForFunction(() => /1 Ausschuss/.test(document.querySelector('.arrived')?.textContent));
    assert.deepEqual((await daemon.stored()).map((record) => record.measured_mm), [25.03]);
    // Nothing of the interface is kept: what is shown is what the service says.
    assert.deepEqual(await again.evaluate(async () => (await (await caches.open('page')).keys()).map(({ url }) => new URL(url).pathname).filter((path) => path.startsWith('/v1'))), []);
  });

  it('a page that the browser does not keep says so', async () => {
    page = await open(browser, daemon, '#/gauge/25H7');
    await page.waitForSelector('.echo .figures');
    await daemon.kill();
    await page.waitForFunction(() => /Do not close or reload/.test(document.querySelector('.unkept')?.textContent));
    await daemon.start();
    await page.waitForFunction(() => document.querySelector('.unkept')?.textContent === '');
  });

  it('the desk asks again for what it was asked meanwhile', async () => {
    await daemon.send('POST', '/v1/measurements', ['M1', 'M2'].map((machine) => ({ designation: '25 H7', measured_mm: '25.01', characteristic: 'bore', part_id: `of ${machine}`, machine })));
    const rows = (selector, count) => [(view) => document.querySelectorAll(view[0]).length === view[1], [selector, count]];
    const machine = async (view) => {
      await view.fill('[name="machine"]', 'M1');
      await view.press('[name="machine"]', 'Enter');
    };
    const fit = async (view) => {
      await view.fill('#fit', '30 H7/h6');
      await view.press('#fit', 'Enter');
    };
    const views = [
      ['trend?characteristic=bore', rows('.trend > .scroll tbody tr', 2), machine, rows('.trend > .scroll tbody tr', 1)],
      ['overview', [() => /bore2/.test(document.querySelector('.overview tbody')?.textContent)], machine, [() => /bore1/.test(document.querySelector('.overview tbody')?.textContent)]],
      ['parts', rows('.records tbody tr', 2), machine, rows('.records tbody tr', 1)],
      ['fit/25H7/g6', rows('.fit .limits tr', 2), fit, [() => /h6/.test(document.querySelector('.fit .limits')?.textContent)]],
    ];
    page = await open(browser, daemon, '#/tables');
    const tabs = [];
    for (const [address, shown] of views) {
      tabs.push(await openIn(page.context(), daemon, `#/${address}`));
      await tabs.at(-1).waitForFunction(...shown);
    }
    await daemon.kill();
    const noted = (wanted) => (document.querySelector('.desk .note').textContent !== '') === wanted;
    for (const [i, [, , change]] of views.entries()) {
      await change(tabs[i]);
      await tabs[i].waitForFunction(noted, true);
    }
    await daemon.start();
    for (const [i, [, , , shown]] of views.entries()) {
      await tabs[i].waitForFunction(...shown);
      await tabs[i].waitForFunction(noted, false);
      assert.deepEqual(tabs[i].errors, []);
    }
  });

  it('a view that is opened meanwhile asks again, and says nothing more of it', async () => {
    await daemon.send('PUT', '/v1/gauges-in-use/G-1', { calibration_due: '2027-03-31' });
    await daemon.send('PUT', '/v1/uncertainties/bore', { contributions: [{ name: 'gauge', standard_uncertainty: 0.0005 }] });
    await daemon.send('PUT', '/v1/studies/first', { gauge: 'G-1', at: '2026-11-27', kind: 'type1', input: { values: [25.001, 25.002, 25.003], reference: 25.002, tolerance: 0.021 } });
    await daemon.send('PUT', '/v1/catalogues/turning', { causes: ['worn'], measures: [] });
    await daemon.send('PUT', '/v1/plans/4711', { characteristics: [{ name: 'bore', designation: '25 H7' }] });
    const views = [
      ['tables/shaft?find=g6', '.grid tbody tr'], ['tables/iso492', '.standard tbody tr'],
      ['gauges/G-1?budget=bore', '.gauges-in-use tbody tr', '.of-gauge form', '.budgets option[value="bore"]', '.budgets tbody tr', '.stored-studies tbody tr'],
      ['plans', '.plans-there tbody tr', '.catalogues li button'], ['plans/4711', '.editor:not([hidden]) .characteristic'],
    ];
    page = await open(browser, daemon, '#/gauge');
    const tabs = [];
    for (const [address, ...shown] of views) {
      const tab = await openIn(page.context(), daemon, `#/${address}`);
      for (const each of shown) await tab.waitForSelector(each, { state: 'attached' });
      await tab.evaluate(() => { location.hash = '#/gauge'; });
      await tab.waitForSelector('#value');
      tabs.push(tab);
    }
    await daemon.kill();
    const noted = (wanted) => [...document.querySelectorAll('.desk :is(.note, .done)')].some(({ textContent }) => textContent !== '') === wanted;
    for (const [i, [address]] of views.entries()) {
      await tabs[i].evaluate((hash) => { location.hash = hash; }, `#/${address}`);
      await tabs[i].waitForFunction(noted, true);
    }
    await daemon.start();
    for (const [i, [address, ...shown]] of views.entries()) {
      for (const each of shown) await tabs[i].waitForSelector(each, { state: 'attached' });
      await tabs[i].waitForFunction(noted, false);
      assert.deepEqual(tabs[i].errors, [], address);
    }
  });

  it('a new build replaces what was kept', async () => {
    page = await open(browser, daemon, '#/gauge/25H7', { serviceWorkers: 'allow' });
    await kept('/app.js');
    await page.evaluate(async () => (await caches.open('page')).put('/web/0123456789ab/app.js', new Response('old')));
    await page.reload();
    await page.waitForFunction(async () => !(await (await caches.open('page')).match('/web/0123456789ab/app.js')));
    await kept('/app.js');
  });

  it('no tab writes over what another says of the values that arrive', async () => {
    page = await open(browser, daemon, '#/gauge/25H7', { serviceWorkers: 'allow' });
    const tabs = [page, await openIn(page.context(), daemon, '#/gauge/25H7')];
    for (const tab of tabs) await tab.waitForSelector('.echo .figures');
    await daemon.kill();
    for (let i = 0; i < 40; ++i) await scan(tabs[i % 2], (25.03 + i / 10000).toFixed(4));
    for (const tab of tabs) await tab.waitForSelector('.link[data-state="away"]');
    await daemon.start();
    for (const tab of tabs) {
      await tab.waitForSelector('.link[data-state="up"]');
      await tab.waitForFunction(() => /^40 stored after the outage: 40 reject/.test(document.querySelector('.arrived')?.textContent));
      assert.equal(await tab.$$eval('.arrived li', (items) => items.length), 40);
      assert.deepEqual(tab.errors, []);
    }
    await tabs[1].close();
  });

  it('a scanner types 60 values into two tabs, the service is killed three times: each is stored once, none unseen', async () => {
    page = await open(browser, daemon, '#/gauge/25H7', { serviceWorkers: 'allow' });
    const tabs = [page, await openIn(page.context(), daemon, '#/gauge/25H7')];
    for (const tab of tabs) await tab.waitForSelector('.echo .figures');
    const values = Array.from({ length: 60 }, (_, i) => (25 + (i % 7 === 3 ? 0.03 : 0) + i / 10000).toFixed(4));
    let starting = null;
    for (const [i, value] of values.entries()) {
      if (i === 50) tabs.push(await openIn(page.context(), daemon, '#/gauge/25H7')); // takes over what waits as well
      await scan(tabs[i % 2], value);
      if (i % 20 === 4) {
        await starting;
        await daemon.kill();
      }
      if (i % 20 === 16) {
        for (const tab of tabs.slice(0, 2)) await tab.waitForSelector('.link[data-state="away"]');
        starting = daemon.start();
      }
    }
    await starting;
    for (const tab of tabs) await tab.waitForSelector('.link[data-state="up"]');
    const stored = (await daemon.stored()).map((record) => record.measured_mm.toFixed(4));
    assert.deepEqual([...stored].sort(), [...values].sort());
    // Every one stands in the list of its tab with its verdict.
    const rows = async (tab) => tab.$$eval('.recent li.stored', (items) => items.map((item) => [item.querySelector('.figure').textContent, item.querySelector('.mark-of').textContent]));
    for (const tab of tabs.slice(0, 2)) await tab.waitForFunction(() => document.querySelectorAll('.recent li.stored').length === 30);
    const seen = new Map([...await rows(tabs[0]), ...await rows(tabs[1])]);
    const expected = values.map((value) => [value.replace(/0$/, ''), Number(value) > 25.021 ? 'Reject' : 'Good']);
    assert.deepEqual([...seen].sort(), expected.sort());
    // Those of the outages are counted once for the station, whichever tab sent them, and named where they are bad.
    await eventually(async () => {
      const all = await Promise.all(tabs.map((tab) => tab.textContent('.arrived')));
      assert.equal(new Set(all).size, 1, all.join('\n'));
      assert.match(all[0], /^\d+ stored after the outage: \d+ good, \d+ reject/);
      const [total, good, reject] = all[0].match(/\d+/g).map(Number);
      assert.ok(total >= 33 && total <= 60 && good + reject === total, all[0]);
      assert.equal(await page.$$eval('.arrived li', (items) => items.length), reject);
    });
    await tabs[1].getByRole('button', { name: 'Seen' }).click();
    await page.waitForSelector('.arrived', { state: 'hidden' });
    for (const tab of tabs.slice(1)) assert.deepEqual(tab.errors, []);
  });
});
