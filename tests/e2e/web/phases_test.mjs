/** Values that are set aside with a reason, and phases of a process with limits of their own. */

import assert from 'node:assert/strict';
import { before, describe, it } from 'node:test';

import { close, findings, hashOf, open, picture } from './support/browser.mjs';
import { lettering, openChart, untilPoints } from './support/chart.mjs';
import { browser, daemon } from './support/stage.mjs';

/** Thirty values with one tool, thirty with the next, 8 µm higher; one far outside among the first, a note at value 45. */
const COUNT = 60;
const FAR = 10;
const NOTED = 45;
const values = Array.from({ length: COUNT }, (_, i) => (i === FAR ? 25.06 : Number((25.004 + (i < 30 ? 0 : 0.008) + 0.0015 * Math.sin(i * 2.1)).toFixed(4))));
const um = (value) => Math.round((value - 25) * 1e6) / 1e3;
const counted = values.filter((_, i) => i !== FAR);
const chartOf = async (row) => (await (await daemon.send('POST', '/v1/statistics/chart', { kind: 'i_mr', values: row.map(um), rules: [1, 2, 3, 4] })).json()).charts[0];

describe('a process', () => {
  before(async () => {
    const { measurements } = await (await fetch(`${daemon.url}/v1/measurements`, { method: 'POST', headers: { 'Content-Type': 'application/json', Prefer: 'return=representation' },
      body: JSON.stringify(values.map((measured_mm, i) => ({ designation: '25 H7', measured_mm, part_id: `SN-${100 + i}`, characteristic: 'bore-P', machine: 'M1', tool: i < 30 ? 'T1' : 'T2' }))) })).json();
    await daemon.send('POST', `/v1/measurements/${measurements[NOTED].id}/notes`, { cause: 'Coolant low', measure: 'Coolant filled' });
  });

  it('leaves out of its figures what is set aside with a reason, and shows it; another screen sees it at once', async () => {
    const page = await open(browser, daemon, '#/trend?characteristic=bore-P', { viewport: { width: 1366, height: 768 } });
    const other = await open(browser, daemon, '#/trend?characteristic=bore-P');
    for (const each of [page, other]) await untilPoints(each, COUNT);
    await page.click('.in-figures > summary');
    await page.click(`.in-figures .quiet >> text=SN-${100 + FAR}`);
    await page.waitForFunction(() => /25\.060 mm/.test(document.querySelector('.detail').textContent));
    await page.click('.detail .quiet >> text=Set aside');
    await page.click('dialog .primary');
    await page.waitForFunction(() => /Enter the reason/.test(document.querySelector('dialog .note').textContent));
    await page.fill('dialog [name="reason"]', '25.012');
    await page.click('dialog .primary');
    await page.waitForFunction(() => /is a value. Enter words/.test(document.querySelector('dialog .note').textContent));
    await page.fill('dialog [name="reason"]', 'Burr at the bore');
    await page.fill('dialog [name="operator"]', 'Kim');
    assert.deepEqual(await findings(page), []);
    await page.click('dialog .primary');
    await page.waitForSelector('.aside-values:not([hidden])');
    const { cp } = await (await daemon.send('POST', '/v1/statistics/capability', { values: counted.map(um), lower: 0, upper: 21 })).json();
    for (const each of [page, other]) {
      await each.waitForFunction(() => /Set aside: 1.*25\.060 mmSN-110Burr at the boreKim/.test(document.querySelector('.aside-values').textContent));
      await each.waitForFunction((wanted) => document.querySelector('.indices').textContent.includes(wanted), cp.value.toFixed(2));
      assert.match(await each.textContent('.sums .tiles'), /Reject0Set aside1/);
    }
    await page.evaluate(() => { location.hash = '#/overview'; });
    await page.waitForSelector('.overview .scroll[data-settled]');
    assert.match(await page.textContent('.overview tbody tr'), /^bore-P59Good 59/);
    await page.evaluate(() => { location.hash = '#/trend?characteristic=bore-P'; });
    await untilPoints(page, COUNT);
    await page.waitForSelector('.aside-values:not([hidden])');
    await picture(page, 'trend-aside', { fullPage: true });
    await page.setViewportSize({ width: 390, height: 844 });
    await page.waitForFunction(() => document.documentElement.scrollWidth <= innerWidth);
    await picture(page, 'trend-aside-390', { fullPage: true });
    await page.click('.aside-values .quiet >> text=Count again');
    await page.fill('dialog [name="reason"]', 'No burr was found');
    await page.click('dialog .primary');
    for (const each of [page, other]) await each.waitForFunction(() => document.querySelector('.aside-values').hidden && /Reject1/.test(document.querySelector('.sums .tiles').textContent));
    const notes = await daemon.json(`/v1/measurements?characteristic=bore-P&part_id=SN-${100 + FAR}&notes=shown`);
    assert.deepEqual(notes.measurements[0].notes.map(({ cause, measure, operator }) => [cause, measure, operator]), [['Burr at the bore', 'set aside', 'Kim'], ['No burr was found', 'counted again', undefined]]);
    await close(other);
    await close(page);
  });

  it('has phases that begin at another tool or after a note, each with limits of its own', async () => {
    const page = await openChart(browser, daemon, '#/trend?characteristic=bore-P&phases=tool', { viewport: { width: 1366, height: 768 } });
    await untilPoints(page, COUNT);
    await page.click('.in-figures > summary');
    const rows = () => page.$$eval('.in-figures .wide tbody tr', (all) => all.map((row) => [...row.children].map((cell) => cell.textContent)));
    await page.waitForFunction(() => document.querySelectorAll('.in-figures .wide tbody tr').length === 2);
    const [first, second] = await Promise.all([chartOf(values.slice(0, 30)), chartOf(values.slice(30))]);
    assert.deepEqual((await rows()).map(([name, why, count]) => [name, why, count]), [['1 · SN-100', '', '30'], ['2 · SN-130', 'tool T2', '30']]);
    for (const [i, chart] of [first, second].entries()) assert.ok(Math.abs(parseFloat((await rows())[i][4].replace('−', '-')) - chart.centre) < 0.006, chart.centre);
    assert.doesNotMatch(await page.textContent('.indices'), /SN-129/);
    await page.waitForFunction(() => /newest phase, 30 values/.test(document.querySelector('.indices').textContent));
    assert.ok((await lettering(page)).includes('2'));
    await picture(page, 'trend-phases', { fullPage: true });
    await page.check('.phases [value="note"]');
    await page.waitForFunction(() => document.querySelectorAll('.in-figures .wide tbody tr').length === 3);
    assert.match(hashOf(page), /phases=tool,note/);
    assert.deepEqual((await rows()).map(([name, why, count]) => [name, why, count])[2], [`3 · SN-${100 + NOTED + 1}`, 'a note', String(COUNT - NOTED - 1)]);
    assert.deepEqual(await findings(page), []);
    // What comes with an offset begins another phase.
    await daemon.send('POST', '/v1/measurements', [25.0045, 25.0052, 25.0049].map((measured_mm, i) => ({ designation: '25 H7', measured_mm, part_id: `SN-${200 + i}`, characteristic: 'bore-P', machine: 'M1', tool: 'T2', ...(i === 0 && { offset_um: -7 }) })));
    await untilPoints(page, COUNT + 3);
    await page.check('.phases [value="offset"]');
    await page.waitForFunction(() => /4 · SN-200offset −7 µm3/.test(document.querySelector('.in-figures .wide tbody tr:last-child').textContent));
    await page.click('.rules button >> text=Freeze');
    await page.waitForFunction(() => !document.querySelector('.in-figures .wide tbody'));
    await page.setViewportSize({ width: 390, height: 844 });
    await page.waitForFunction(() => document.documentElement.scrollWidth <= innerWidth);
    await close(page);
  });

  it('fits 1024 in Italian', async () => {
    const page = await open(browser, daemon, '#/trend?characteristic=bore-P&phases=tool,note', { viewport: { width: 1024, height: 768 }, locale: 'it-IT' });
    await page.waitForSelector('.control-chart');
    await page.waitForFunction(() => document.documentElement.scrollWidth <= innerWidth);
    await picture(page, 'trend-phases-it', { fullPage: true });
    await close(page);
  });
});
