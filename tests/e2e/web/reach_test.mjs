/**
 * Everybody reaches everything: on a phone, by the keyboard, on paper, in every language.
 *
 * Tried, and held here:
 * - Print every view: whole, with what, where and when
 * - Fit at 1024 pixels; Italian on a tablet: the wide column, 12 px and more; one line
 * - Every view on a phone, in every language: fits 390 pixels
 * - Enter on a view, a fit, a file by the keyboard: on the heading, or where it was; tiles are silent
 */

import assert from 'node:assert/strict';
import fs from 'node:fs';
import { before, describe, it } from 'node:test';

import { browserName, close, drawn, launch, open, picture } from './support/browser.mjs';
import { leastLettering, openChart } from './support/chart.mjs';
import { Daemon } from './support/daemon.mjs';
import { known } from './support/scanner.mjs';

const SMALLEST_LETTERING = 12;
const PHONE = { width: 390, height: 844 };
const LANGUAGES = ['en', 'de', 'nl', 'it'];
const VIEWS = {
  gauge: '#/gauge/25H7?part_id=SN-1&order=WO-17&operator=42', fit: '#/fit/25H7/k6?hole=25.013', trend: '#/trend', overview: '#/overview', parts: '#/parts?order=WO-17',
  programs: '#/programs/nc_prog/8255.h?setup=bore', tables: '#/tables/hole?find=25+H', plans: '#/plans/WO-17',
};
const READY = { gauge: '.echo .figures', fit: '.class-zones :checked', trend: '.control-chart', overview: '.overview [data-settled]', parts: '.records tbody tr', programs: '.cm-line', tables: '.grid', plans: '.editor:not([hidden]) .characteristic' };

describe('the reach of the page', () => {
  let browser;
  let daemon;

  before(async () => {
    browser = await launch();
    daemon = await new Daemon().start();
    for (const name of ['8255.h', '82551.h']) {
      await daemon.send('PUT', `/v1/files/nc_prog/${name}`, fs.readFileSync(`clients/nc/8255/${name}`, 'utf8'), 'text/plain');
    }
    await daemon.send('PUT', '/v1/plans/WO-17', { characteristics: [{ name: 'bore-A', designation: '25 H7', reaction: 'Stop, tell the setter' }, { name: 'slot', nominal_mm: 8, feature: 'hole', upper_um: 36, lower_um: -4 }] });
    await daemon.send('POST', '/v1/measurements', Array.from({ length: 40 }, (_, i) => (
      { designation: '25 H7', measured_mm: `25.00${i % 10}`, part_id: `SN-${i}`, characteristic: 'bore-A', order: 'WO-17', operator: '42' })));
  });

  async function openView(view, options) {
    const page = await (view === 'trend' ? openChart : open)(browser, daemon, VIEWS[view], options);
    await page.waitForSelector(READY[view]);
    return page;
  }

  /** Changes the language, which draws the view anew. */
  async function speak(page, language) {
    await page.selectOption('#language', language);
    await page.waitForFunction((wanted) => document.documentElement.lang === wanted, language);
  }

  for (const view of Object.keys(VIEWS)) {
    it(`${view} fits a phone in every language, with lettering one can read`, async () => {
      const page = await openView(view, { viewport: PHONE });
      for (const locale of LANGUAGES) {
        await speak(page, locale);
        await page.waitForSelector(READY[view]);
        assert.equal(await page.evaluate(() => document.documentElement.scrollWidth), PHONE.width, locale);
        const names = await page.$$eval('#views a', (links) => links.map((link) => link.getBoundingClientRect()).map(({ left, right }) => ({ left, right })));
        assert.deepEqual(await page.$$eval('#views a, main button:not(.unseen)', (links) => links.filter((link) => link.scrollWidth > link.clientWidth).map((link) => link.textContent)), [], `${locale}: names wider than their place`);
        for (let i = 1; i < names.length; ++i) assert.ok(names[i].left >= names[i - 1].right, `${locale}: view ${i} lies over the one before`);
        const small = await page.$$eval('main svg text', (texts, least) => texts
          .filter((text) => text.getBoundingClientRect().width > 0)
          .map((text) => ({ text: text.textContent, size: parseFloat(getComputedStyle(text).fontSize) * text.ownerSVGElement.getScreenCTM().a }))
          .filter(({ size }) => size < least - 0.05), SMALLEST_LETTERING);
        assert.deepEqual(small, [], locale);
        if (view === 'trend') assert.ok(await leastLettering(page) >= SMALLEST_LETTERING, `${locale}: the chart`);
        const cut = await page.evaluate(() => [...document.querySelectorAll('.class-zones')]
          .filter((strip) => {
            const place = strip.querySelector(':checked')?.parentElement.getBoundingClientRect();
            const frame = strip.getBoundingClientRect();
            return place && (place.left < frame.left || place.right > frame.right);
          }).length);
        assert.equal(cut, 0, `${locale}: the chosen class is off screen`);
      }
      await close(page);
    });
  }

  it('gives the fit’s figure the wide column where there are two, in lettering one can read', async () => {
    const page = await openView('fit', {});
    for (const width of [768, 1023, 1024, 1025, 1366]) {
      await page.setViewportSize({ width, height: 768 });
      await drawn(page);
      const [figure, side] = await page.$$eval('.fit figure, .fit .side', (all) => all.map((each) => each.getBoundingClientRect()).map((box) => ({ left: box.left, top: box.top, width: box.width })));
      if (Math.abs(figure.left - side.left) > 100) assert.ok(figure.width > side.width, `${width}: figure ${figure.width}, form ${side.width}`);
      const least = await page.$$eval('.fit figure svg text', (texts) => Math.min(...texts.map((text) => parseFloat(getComputedStyle(text).fontSize) * text.ownerSVGElement.getScreenCTM().a)));
      assert.ok(least >= SMALLEST_LETTERING - 0.05, `${width}: ${least}`);
    }
    await close(page);
  });

  it('has its views in one line on tablets and desks, in every language', async () => {
    const page = await openView('tables', {});
    for (const locale of LANGUAGES) {
      await speak(page, locale);
      for (const width of [768, 1024, 1366]) {
        await page.setViewportSize({ width, height: 768 });
        const { height } = await page.$eval('.bar', (bar) => bar.getBoundingClientRect().toJSON());
        assert.ok(height < 80, `${locale}, ${width} pixels: the bar is ${height} high`);
      }
    }
    await close(page);
  });

  it('has both corrections of a value in one line at 1366 pixels, in every language', async () => {
    const page = await openView('gauge', { viewport: { width: 1366, height: 768 } });
    await page.keyboard.type('25.0131\n');
    await page.waitForSelector('.recent .fix');
    for (const locale of LANGUAGES) {
      await speak(page, locale);
      await page.waitForSelector('.recent .fix');
      const [one, other] = await page.$$eval('.recent .fix button', (all) => all.map((button) => button.getBoundingClientRect().top));
      assert.equal(one, other, locale);
    }
    await close(page);
  });

  it('hides no value of a list behind what is done with it, nor beyond the edge of a phone', async () => {
    const parts = await openView('parts', { viewport: PHONE });
    const cells = await parts.$$eval('.records tbody tr:first-child > *', (all) => all.map((cell) => cell.getBoundingClientRect()).map(({ left, right }) => [left, right]));
    for (let i = 1; i < cells.length; ++i) assert.ok(cells[i][0] >= cells[i - 1][1] - 1, `cell ${i} lies over the one before: ${cells}`);
    await close(parts);
    const trend = await openView('trend', { viewport: PHONE });
    const ends = await trend.$$eval('.trend > .scroll tbody td', (all) => all.map((cell) => cell.getBoundingClientRect().right));
    assert.ok(ends.length >= 5 && ends.every((right) => right <= PHONE.width), String(ends));
    await close(trend);
  });

  it('shows a whole verdict on a phone', async () => {
    const page = await openView('gauge', { viewport: PHONE });
    await page.keyboard.type('25.0131\n');
    await page.waitForSelector('.verdict[data-verdict="good"]:not([data-provisional])');
    const { bottom } = await page.$eval('.verdict', (panel) => panel.getBoundingClientRect().toJSON());
    assert.ok(bottom <= PHONE.height, `${bottom}`);
    const { lines, right } = await page.$eval('.verdict .measured', (one) => {
      const range = document.createRange();
      range.selectNodeContents(one);
      return { lines: new Set([...range.getClientRects()].map(({ top }) => top)).size, right: range.getBoundingClientRect().right };
    });
    assert.ok(lines === 1 && right <= PHONE.width, `${lines} lines to ${right}`);
    // One left edge for all of the station.
    await page.waitForSelector('.recent li.stored');
    const edges = await page.$$eval('.job, .entry, .verdict, .recent h2, .recent li', (all) => all.map((one) => one.getBoundingClientRect().left + parseFloat(getComputedStyle(one).paddingLeft)));
    assert.deepEqual([...new Set(edges)], [16]);
    await close(page);
  });

  it('shows a whole verdict below a plan on a low screen, and above the number pad on a phone', async () => {
    await daemon.send('PUT', '/v1/plans/LOW', { name: 'Flange', characteristics: [{ name: 'bore-1', designation: '25 H7' }, { name: 'bore-2', designation: '30 H7' }, { name: 'journal', designation: '40 k6' }] });
    for (const [viewport, pad] of [[{ width: 1024, height: 700 }, false], [{ width: 1024, height: 700 }, true], [PHONE, true]]) {
      const page = await open(browser, daemon, `#/gauge/25H7?plan=LOW&part_id=SN-${viewport.width}-${pad}&characteristic=bore-1`, { viewport });
      await page.waitForSelector('.echo .figures');
      if (pad) {
        await page.click('.more summary');
        await page.check('.choices label:has-text("Number pad") input');
        await page.click('.more summary');
        await page.evaluate(() => scrollTo(0, 0));
      }
      await known(page);
      await page.focus('#value');
      await page.keyboard.type('25.0305\n');
      await page.waitForSelector('.verdict[data-verdict="reject"]:not([data-provisional]) .distance');
      const bottom = (selector) => page.$eval(selector, (element) => element.getBoundingClientRect().bottom);
      const free = viewport === PHONE ? await page.$eval('.pad', (element) => element.getBoundingClientRect().top) : viewport.height;
      if (viewport !== PHONE) assert.ok(await page.evaluate(() => scrollY) === 0);
      assert.ok(await bottom('.verdict .distance') <= free, `${viewport.width}: ${await bottom('.verdict .distance')} of ${free}`);
      if (viewport !== PHONE) assert.ok(await bottom('.verdict') <= free, `${viewport.width}: ${await bottom('.verdict')}`);
      if (viewport === PHONE) assert.ok(await bottom('.pad') <= viewport.height);
      await picture(page, `station-${viewport.width}-${pad ? 'pad' : 'plan'}`);
      await close(page);
    }
  });

  it('shows a whole verdict, and a question with its answers, above the number pad of a small phone', async () => {
    for (const height of [740, 640]) {
      const page = await open(browser, daemon, `#/gauge/25H7?part_id=SN-${height}`, { viewport: { width: 360, height }, hasTouch: true, isMobile: browserName === 'chromium' });
      await page.waitForSelector('.echo .figures');
      if (await page.isHidden('.pad')) {
        await page.click('.more summary');
        await page.check('.choices label:has-text("Number pad") input');
      }
      const isWhole = (selector) => page.waitForFunction((wanted) => {
        const { top, bottom } = document.querySelector(wanted).getBoundingClientRect();
        return top >= 0 && bottom <= Math.min(innerHeight, document.querySelector('.pad').getBoundingClientRect().top);
      }, selector);
      for (const text of ['25.0131', '25.0305']) {
        await page.focus('#value');
        await page.keyboard.type(`${text}\n`);
        await page.waitForSelector('.verdict:not([data-provisional]) .distance');
        await isWhole('.verdict');
      }
      await page.keyboard.type('2009\n');
      await page.waitForSelector('.answers');
      await isWhole('.answers');
      await picture(page, `station-360-${height}`);
      await close(page);
    }
  });

  it('breaks long names of parts, characteristics and plans on a phone, and cuts none', async () => {
    const [part, characteristic, plan] = [41, 62, 60].map((length) => 'W'.repeat(length));
    const own = await new Daemon().start();
    await own.send('PUT', `/v1/plans/${plan}`, { characteristics: [{ name: characteristic, designation: '25 H7' }] });
    const page = await open(browser, own, `#/gauge/25H7?part_id=${part}&characteristic=${characteristic}`, { viewport: { width: 360, height: 740 } });
    await page.waitForSelector('.echo .figures');
    const wide = () => page.evaluate(() => [document.documentElement.scrollWidth, ...[...document.querySelectorAll('.recent, .recent li')].map((one) => one.scrollWidth - one.clientWidth)]);
    assert.deepEqual(await wide(), [360, 0]);
    await page.keyboard.type('25.0131\n');
    await page.waitForSelector('.recent li.stored .fix');
    assert.deepEqual(await wide(), [360, 0, 0]);
    await page.goto(`${own.url}/#/plans/${plan}`);
    await page.waitForSelector(READY.plans);
    assert.deepEqual(await wide(), [360]);
    await page.goto(`${own.url}/#/parts?part_id=${part}`);
    await page.waitForSelector('.part-verdict');
    assert.deepEqual(await wide(), [360]);
    await close(page);
    await own.cleanup();
  });

  it('breaks the longest names at the station of a phone, in tiles, reasons and corrections', async () => {
    const own = await new Daemon().start();
    const [part, plan, ...names] = ['W', 'P', 'C', 'D'].map((letter) => letter.repeat(199));
    await own.send('PUT', `/v1/plans/${plan}`, { characteristics: names.map((name) => ({ name, designation: '25 H7', reaction: 'R'.repeat(199) })) });
    const page = await open(browser, own, `#/gauge?plan=${plan}&part_id=${part}`, { viewport: { width: 360, height: 740 } });
    await page.waitForSelector('.tiles-of-plan li');
    await page.waitForSelector('.echo .figures');
    const fits = async (when) => assert.equal(await page.evaluate(() => document.documentElement.scrollWidth), 360, when);
    await fits('before the first value');
    for (const [i] of names.entries()) {
      await page.focus('#value');
      await page.keyboard.type('25.03\n');
      await page.waitForSelector(`.recent li.stored:nth-child(${i + 1})`);
      await fits(`value ${i + 1}`);
      await page.click('.reactions .primary');
    }
    assert.ok(await page.$$eval('.tiles-of-plan li', (tiles) => tiles.every((tile) => tile.clientWidth <= 330)), 'a tile is seen whole');
    await page.focus('#value');
    await page.keyboard.type('25.01\n'); // the part is measured
    await page.waitForFunction(() => /Not stored/.test(document.querySelector('#entry-note').textContent));
    await fits('a refusal');
    await page.keyboard.press('Escape');
    await page.getByRole('button', { name: /^Correct the part/ }).first().click();
    await page.waitForSelector('.entry.correcting');
    await fits('a correction');
    await close(page);
    await own.cleanup();
  });

  it('prints lists with long names whole', async () => {
    const own = await new Daemon().start();
    const [part_id, characteristic, operator, machine] = ['W', 'C', 'O', 'M'].map((letter) => letter.repeat(41));
    await own.send('POST', '/v1/measurements', Array.from({ length: 12 }, (_, i) => ({ designation: '25 H7', measured_mm: 25 + i / 1000, part_id, characteristic, operator, machine })));
    const page = await open(browser, own, '#/parts');
    await page.emulateMedia({ media: 'print' });
    await page.setViewportSize({ width: 657, height: 986 }); // A4 less its margins
    for (const [at, ready] of [['#/parts', '.records tbody tr'], ['#/trend', '.trend > .scroll tbody tr'], ['#/overview', '.overview tbody tr'], ['#/gauges', '.budgets tbody tr']]) {
      await page.evaluate((hash) => { location.hash = hash; }, at);
      await page.waitForSelector(ready);
      await drawn(page);
      assert.deepEqual(await page.$$eval('#main table', (tables) => tables.map((table) => table.getBoundingClientRect().right).filter((right) => right > innerWidth + 1)), [], at);
    }
    await close(page);
    await own.cleanup();
  });

  it('shows the state of the service where colours are forced', async () => {
    if (browserName !== 'chromium') return;
    const page = await openView('tables', { viewport: { width: 1024, height: 768 }, forcedColors: 'active' });
    const [sign, ground] = await page.evaluate(() => [getComputedStyle(document.querySelector('.link'), '::before'), getComputedStyle(document.body)].map(({ backgroundColor }) => backgroundColor));
    assert.notEqual(sign, ground);
    await close(page);
  });

  it('keeps the focus where it was, and moves it to a new view', async () => {
    const page = await openView('gauge');
    const focused = () => page.evaluate(() => document.activeElement.textContent || document.activeElement.tagName);
    for (const [view, title] of [['fit', 'Fit'], ['tables', 'Tables'], ['overview', 'Overview'], ['parts', 'Parts'], ['programs', 'Programs'], ['trend', 'Trend']]) {
      await page.focus(`#views a[href^="#/${view}"]`);
      await page.keyboard.press('Enter');
      await page.waitForFunction((name) => document.querySelector('main h1')?.textContent === name, title);
      assert.deepEqual([await focused(), await page.evaluate(() => document.activeElement.tagName)], [title, 'H1']);
    }
    await page.goto(`${daemon.url}/${VIEWS.fit}`);
    await page.waitForSelector(READY.fit);
    await page.focus('.preferred button:has-text("H7/s6")');
    await page.keyboard.press('Enter');
    await page.waitForFunction(() => document.querySelector('.fit .headline')?.textContent === 'Interference fit');
    assert.equal(await focused(), 'H7/s6');
    await page.goto(`${daemon.url}/${VIEWS.tables}`);
    await page.waitForSelector(READY.tables);
    await page.focus('.switch button:last-child');
    await page.keyboard.press('Enter');
    await page.waitForSelector('.switch button:last-child[aria-pressed="true"]');
    assert.equal(await focused(), 'Shafts');
    await page.goto(`${daemon.url}/${VIEWS.programs}`);
    await page.waitForSelector(READY.programs);
    await page.focus('.files button:has-text("82551.h")');
    await page.keyboard.press('Enter');
    await page.waitForFunction(() => document.querySelector('.title')?.textContent === '82551.h');
    assert.equal(await focused(), '82551.h');
    await close(page);
  });

  it('says on paper of which list it is, not at which place of it', async () => {
    const page = await open(browser, daemon, '#/parts?order=WO-17&at=20', { viewport: { width: 1366, height: 768 } });
    await page.waitForFunction(() => /at=\d/.test(location.hash) && document.querySelector('.records')?.scrollTop > 0 && !document.querySelector('.records').ariaBusy);
    const [address, text] = await page.evaluate(() => {
      dispatchEvent(new Event('beforeprint'));
      return [location.hash, document.getElementById('printed').textContent];
    });
    assert.match(address, /at=\d+/);
    assert.match(text, /^PartsOrder WO-17127/);
    await close(page);
  });

  it('prints whole, and says of what, where and when', async () => {
    for (const view of Object.keys(VIEWS)) {
      const page = await openView(view, { viewport: { width: 1366, height: 768 }, timezoneId: 'Europe/Berlin' });
      if (view === 'tables') await page.fill('#find', 'H'); // every size, which no screen holds
      if (view === 'tables') await page.waitForFunction(() => document.querySelectorAll('.grid tbody tr').length > 30);
      await page.setViewportSize({ width: 660, height: 900 }); // the inside of A4 at 96 pixels an inch
      await page.evaluate(() => dispatchEvent(new Event('beforeprint')));
      await page.emulateMedia({ media: 'print' });
      await page.waitForFunction(() => document.querySelector('#printed').checkVisibility());
      assert.match(await page.textContent('#printed'), /127\.0\.0\.1.*20\d\d, \d\d:\d\d:\d\d CES?T$/, view);
      if (view === 'gauge') assert.match(await page.textContent('#printed'), /Order WO-17.*Operator 42/);
      await drawn(page); // figures too, anew for the width of the paper
      const cut = await page.evaluate(() => [...document.querySelectorAll('main *')]
        .filter((element) => element.checkVisibility() && !element.closest('.unseen, svg, .grid'))
        .filter((element) => element.getBoundingClientRect().right > innerWidth + 1 || (element.scrollHeight > element.clientHeight + 1 && getComputedStyle(element).overflowY !== 'visible'))
        .map((element) => element.outerHTML.slice(0, 100)));
      assert.deepEqual(cut, [], view);
      await close(page);
    }
  });
});
