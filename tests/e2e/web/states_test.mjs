/** Tokens and components in one place; what every view shows while it waits, when there is nothing, and when the service fails. */

import assert from 'node:assert/strict';
import { describe, it } from 'node:test';

import { browserName, close, findings, open, picture } from './support/browser.mjs';
import { browser, daemon } from './support/stage.mjs';

const VIEWS = ['trend', 'overview', 'overview?look=heat', 'overview?look=wall', 'parts', 'plans', 'gauges', 'programs', 'tables/hole', 'connections'];
/** Text that somebody sees in the view, without its controls. */
const said = (page) => page.evaluate(() => [...document.querySelectorAll('main .note, main .empty, main .aside')].filter((one) => one.checkVisibility()).map(({ textContent }) => textContent.trim()).filter(Boolean));
/** The least type of the texts in sight, in px, and where. */
const least = (page, within) => page.evaluate((selector) => {
  const texts = document.createTreeWalker(document.querySelector(selector), NodeFilter.SHOW_TEXT);
  let found = [Infinity, ''];
  for (let node = texts.nextNode(); node; node = texts.nextNode()) {
    const element = node.parentElement;
    if (!node.textContent.trim() || !element.checkVisibility() || element.closest('svg, .unseen, datalist')) continue;
    const size = parseFloat(getComputedStyle(element).fontSize);
    if (size < found[0]) found = [size, element.outerHTML.slice(0, 80)];
  }
  return found;
}, within);

describe('the page', () => {
  it('has its tokens and components in one place, in every mode', async () => {
    const page = await open(browser, daemon, '#/style', { viewport: { width: 1366, height: 768 } });
    await page.waitForSelector('.tokens .swatches');
    assert.ok(await page.$$eval('.swatches .aside', (all) => all.every(({ textContent }) => textContent)));
    assert.deepEqual(await findings(page), []);
    const modes = { light: { colorScheme: 'light' }, dark: { colorScheme: 'dark' }, ...(browserName === 'chromium' && { forced: { forcedColors: 'active' } }) };
    for (const [mode, media] of Object.entries(modes)) {
      await page.emulateMedia(media);
      for (const width of [1366, 390]) {
        await page.setViewportSize({ width, height: 768 });
        await page.waitForFunction(() => document.documentElement.scrollWidth <= innerWidth);
        await picture(page, `style-${width}-${mode}`, { fullPage: true });
      }
    }
    await close(page);
  });

  for (const view of VIEWS) {
    it(`says of ${view} that it is loading, that there is nothing, and that the service fails`, async () => {
      const page = await open(browser, daemon, '#/fit/25H7/g6', { viewport: { width: 1366, height: 768 } });
      let hold;
      const held = new Promise((resolve) => { hold = resolve; });
      await page.route('**/v1/**', async (route) => {
        if (route.request().method() !== 'GET' || /events|stream/.test(route.request().url())) return route.fallback();
        await held;
        return route.continue().catch(() => {});
      });
      await page.evaluate((name) => { location.hash = `#/${name}`; }, view);
      await page.waitForFunction(() => document.getElementById('loading').textContent === 'Loading …');
      hold();
      await page.waitForFunction(() => document.getElementById('loading').textContent === '');
      if (!['tables/hole', 'connections'].includes(view)) await page.waitForFunction(() => [...document.querySelectorAll('main .note, main .empty')].some((one) => one.checkVisibility() && one.textContent.trim()));
      await page.unrouteAll({ behavior: 'ignoreErrors' });
      await page.route('**/v1/**', (route) => (/events|stream/.test(route.request().url()) ? route.fallback() : route.fulfill({ status: 500, contentType: 'application/problem+json', body: '{"title":"broken","status":500,"detail":"The disk is gone.","code":"internal"}' })));
      await page.evaluate(() => { location.hash = '#/fit/30H7/g6'; });
      await page.waitForFunction(() => location.hash.startsWith('#/fit'));
      await page.evaluate((name) => { location.hash = `#/${name}`; }, view);
      await page.waitForFunction(() => [...document.querySelectorAll('main :is(.note, .done)')].some((one) => one.checkVisibility() && one.textContent.trim()))
        .catch(async () => assert.fail(`nothing is said: ${await said(page)}`));
      await page.unrouteAll({ behavior: 'ignoreErrors' });
      await close(page);
    });
  }

  it('has no type below 16 px at the station, and 13 px in tables and maps of classes alone', async () => {
    await daemon.send('PUT', '/v1/plans/WO-1', { characteristics: [{ name: 'bore-A', designation: '25 H7', gauge: 'G-07' }] });
    const page = await open(browser, daemon, '#/gauge/25H7?part_id=SN-1&characteristic=bore-A', { viewport: { width: 1366, height: 768 } });
    await page.waitForSelector('.echo .figures');
    await page.focus('#value');
    await page.keyboard.type('25.0131\n');
    await page.waitForSelector('.recent .mark-of');
    assert.ok((await least(page, '.gauge'))[0] >= 16, String(await least(page, '.gauge')));
    await picture(page, 'station-type');
    for (const view of ['parts', 'trend', 'overview', 'fit/25H7/g6', 'plans']) {
      await page.evaluate((name) => { location.hash = `#/${name}`; }, view);
      await page.waitForFunction((name) => document.querySelector('main h1') && location.hash.includes(name), view);
      if (view.startsWith('fit')) await page.waitForSelector('.class-zones .um');
      const small = await page.evaluate(() => [...document.querySelectorAll('main *')].filter((one) => one.checkVisibility() && !one.closest('table, svg, .unseen') && [...one.childNodes].some((node) => node.nodeType === 3 && node.textContent.trim())
        && parseFloat(getComputedStyle(one).fontSize) < (one.closest('.class-zones') ? 13 : 14)).map((one) => one.outerHTML.slice(0, 90)));
      assert.deepEqual(small, [], view);
    }
    await close(page);
  });
});
