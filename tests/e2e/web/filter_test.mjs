/** One filter bar for Trend, Overview and Parts: what is shown in one is shown in the next. */

import assert from 'node:assert/strict';
import { before, describe, it } from 'node:test';

import { periodOf } from '../../../clients/web/filter_bar.js';
import { isOfPattern, nameIn, notWords } from '../../../clients/web/gauge/reading.js';
import { close, hashOf, open, picture } from './support/browser.mjs';
import { untilPoints } from './support/chart.mjs';
import { Daemon } from './support/daemon.mjs';
import { browser, daemon } from './support/stage.mjs';

describe('a line in a field', () => {
  it('is a name without what a scanner and the shop write before it, or none of this field', () => {
    for (const [line, field, name] of [['P:SN-1', 'part_id', 'SN-1'], [' ]C1p:SN-1', 'part_id', 'SN-1'], [']Q3SN-1', 'part_id', 'SN-1'], ['SN-1', 'order', 'SN-1'], ['25 H7', 'part_id', '25 H7'],
      ['O:WO-1', 'part_id', null], ['P:SN-1', 'order', null], ['', 'part_id', '']]) assert.equal(nameIn(line, field), name, line);
    assert.equal(nameIn('#SN-1', 'part_id', { part_id: '#' }), 'SN-1');
  });

  it('is of a pattern of parts, which no number of stars keeps from an end', () => {
    for (const [text, pattern, is] of [['SN-0042', 'sn-####', true], ['SN-42', 'SN-####', false], ['SN-#', 'SN-#', false], ['a.b', 'a?b', true], ['axb', 'a.b', false], ['', '*', true], ['x', '', true],
      ['A-17/B', 'A*#*B', true], ['aab', '*ab', true], ['abc', '*ab', false], ['a*b', 'a*b**', true]]) assert.equal(isOfPattern(text, pattern), is, `${text} of ${pattern}`);
    // Whoever tries every way to share the text among the stars never ends.
    for (const pattern of ['*#', '*?', '*1']) assert.equal(isOfPattern('1'.repeat(200), `${pattern.repeat(60)}x`), false);
  });

  it('is words unless a gauge or a scanner has sent it', () => {
    for (const line of ['25.012', '25,012 mm', '01A+00025.012', '0.98 in', 'ERR 1', '4711']) assert.equal(notWords(line), 'value', line);
    for (const [line, burst] of [['P:SN-1'], [']C1SN-1'], ['K-17', true], ['25H7', true]]) assert.equal(notWords(line, { burst }), 'scan', line);
    for (const [line, burst] of [['Insert worn'], ['Insert 3 worn', true], ['M: chatter'], ['K-17'], ['12A'], ['see 25.012']]) assert.equal(notWords(line, { burst }), '', line);
  });
});

describe('the filter bar', () => {
  /** No midnight is near. */
  const NOW = new Date(2026, 2, 10, 12);

  before(async () => {
    const at = (days) => new Date(NOW - days * 86400000).toISOString();
    await daemon.send('POST', '/v1/measurements', Array.from({ length: 40 }, (_, i) => ({
      designation: '25 H7', measured_mm: `25.0${10 + i % 7}`, part_id: `SN-${i}`, characteristic: 'bore-A',
      machine: i < 30 ? 'M1' : 'M2', operator: 'Kim', order: 'WO-1', measured_at: at(i < 20 ? 9 : 0) })));
    // Too few, and without spread: nobody asks for figures of these.
    await daemon.send('POST', '/v1/measurements', { designation: '25 H7', measured_mm: '25.01', characteristic: 'lone', machine: 'M2' });
  });

  it('goes from the overview of a machine to the chart of that machine', async () => {
    const page = await open(browser, daemon, '#/overview?machine=M2');
    const refused = [];
    page.on('response', (answer) => answer.status() >= 400 && refused.push(answer.url()));
    await page.waitForSelector('.overview .scroll[data-settled]');
    assert.equal(await page.inputValue('[name="machine"]'), 'M2');
    await page.click('.overview tbody >> text=bore-A');
    await untilPoints(page, 10);
    assert.match(hashOf(page), /machine=M2/);
    await daemon.send('POST', '/v1/measurements', [{ designation: '25 H7', measured_mm: '25.01', characteristic: 'bore-A', machine: 'M1' }, { designation: '25 H7', measured_mm: '25.012', characteristic: 'bore-A', machine: 'M2' }]);
    await untilPoints(page, 11);
    await page.fill('[name="machine"]', '');
    await page.press('[name="machine"]', 'Tab');
    await untilPoints(page, 42);
    await picture(page, 'trend-filtered');
    assert.deepEqual(refused, []);
    await close(page);
  });

  it('has today and this shift at a touch, in the address', async () => {
    const page = await open(browser, daemon, '#/trend?characteristic=bore-A', { at: NOW });
    await untilPoints(page, 42);
    await page.click('.chips >> text=Yesterday');
    await page.waitForSelector('.empty');
    assert.match(hashOf(page), /period=yesterday/);
    await page.click('.chips >> text=Yesterday');
    await untilPoints(page, 42);
    await page.evaluate(() => { location.hash = '#/parts?period=yesterday'; });
    await page.waitForFunction(() => /No measurements match/.test(document.querySelector('.parts .note')?.textContent));
    assert.equal(await page.getAttribute('.chips >> text=Yesterday', 'aria-pressed'), 'true');
    await close(page);
  });

  it('takes one row of a small screen in every language, and names what is folded', async () => {
    const page = await open(browser, daemon, '#/parts?tool=T1&from=2026-05-04&confirmed=false', { viewport: { width: 1366, height: 768 } });
    assert.ok(await page.isVisible('[name="tool"]'), 'what is chosen is in sight');
    assert.equal(await page.textContent('.of-more summary'), 'More filters · Tool T1 · From 4 May 2026 · Without confirmed values');
    await page.fill('[name="tool"]', '');
    await page.press('[name="tool"]', 'Tab');
    assert.equal(await page.textContent('.of-more summary'), 'More filters · From 4 May 2026 · Without confirmed values');
    for (const view of ['parts', 'trend', 'overview']) {
      await page.evaluate((hash) => { location.hash = hash; }, `#/${view}`);
      await page.waitForSelector(`.desk.${view} .of-more:not([open])`);
      for (const language of ['de', 'nl', 'it', 'en']) {
        await page.selectOption('#language', language);
        await page.waitForFunction((wanted) => document.documentElement.lang === wanted && document.title.startsWith(document.querySelector('.bar [aria-current]').textContent), language);
        const height = await page.$eval('.desk > form', (form) => form.getBoundingClientRect().height);
        assert.ok(height < 100, `${view} in ${language}: ${height}`);
      }
    }
    await close(page);
  });

  it('finds the values of an operator by the name that the list shows, also that of a key', async () => {
    const own = await new Daemon().start();
    const keys = { Kim: await own.key('Kim', 'operator'), Lee: await own.key('Lee', 'operator') };
    const measure = (key, record) => fetch(`${own.url}/v1/measurements`, {
      method: 'POST', body: JSON.stringify({ designation: '25 H7', measured_mm: '25.01', characteristic: 'by', ...record }), headers: { 'Content-Type': 'application/json', Authorization: `Bearer ${keys[key]}` } });
    for (let i = 0; i < 3; ++i) await measure('Kim', { part_id: `K-${i}` });
    await measure('Lee', { part_id: 'L-1' });
    await measure('Lee', { part_id: 'L-2', operator: 'Lee' });
    const page = await open(browser, own, '#/parts?operator=Kim');
    const parts = (...wanted) => page.waitForFunction((names) => [...document.querySelectorAll('.records tbody tr')].map((row) => row.cells[0].textContent).join() === names, wanted.join());
    await parts('K-2', 'K-1', 'K-0');
    assert.match(hashOf(page), /^#\/parts\?caller=Kim/);
    assert.equal(await page.textContent('.of-more summary'), 'More filters · Operator Kim · key');
    assert.deepEqual(await page.$$eval('#filter-operator option', (all) => all.map(({ value }) => value)), ['Lee', 'Kim · key', 'Lee · key']);
    const find = async (name) => { await page.fill('[name="operator"]', name); await page.press('[name="operator"]', 'Enter'); };
    await find('Lee');
    await parts('L-2');
    await find('Lee · key');
    await parts('L-2', 'L-1');
    await find('Kim');
    await parts('K-2', 'K-1', 'K-0');
    await page.evaluate(() => { location.hash = '#/trend?characteristic=by&caller=Kim'; });
    await untilPoints(page, 3);
    await measure('Lee', {});
    await measure('Kim', {});
    await untilPoints(page, 4);
    await close(page);
  });

  it('asks for no figures of values that are all equal, in the chart either', async () => {
    await daemon.send('POST', '/v1/measurements', Array.from({ length: 3 }, () => ({ designation: '25 H7', measured_mm: '25.01', characteristic: 'equal' })));
    const page = await open(browser, daemon, '#/fit/25H7/g6');
    const refused = [];
    page.on('response', (answer) => answer.status() >= 400 && refused.push(answer.url()));
    await page.evaluate(() => { location.hash = '#/trend?characteristic=equal'; });
    await untilPoints(page, 3);
    assert.match(await page.textContent('.indices'), /two different values/);
    assert.deepEqual(refused, []);
    await close(page);
  });

  it('knows when a day and a shift begin, also over midnight', () => {
    const at = (hour, day = 10) => new Date(2026, 4, day, hour, 30);
    assert.deepEqual(periodOf('today', at(7)), [new Date(2026, 4, 10), null]);
    assert.deepEqual(periodOf('yesterday', at(7)), [new Date(2026, 4, 9), new Date(2026, 4, 10)]);
    assert.deepEqual([5, 6, 14, 23].map((hour) => periodOf('shift', at(hour))[0]), [new Date(2026, 4, 9, 22), new Date(2026, 4, 10, 6), new Date(2026, 4, 10, 14), new Date(2026, 4, 10, 22)]);
  });
});
