/** The overview as a list, as a map of parts by characteristic and as a wall of small charts, which live as the values come. */

import assert from 'node:assert/strict';
import { before, describe, it } from 'node:test';

import { close, findings, hashOf, open, picture } from './support/browser.mjs';
import { untilPoints } from './support/chart.mjs';
import { browser, daemon } from './support/stage.mjs';

const NAMES = ['bore-A', 'bore-B', 'seat', 'slot', 'length', 'pin', 'collar', 'groove'];
const PARTS = 30;
const SIZES = [{ width: 1366, height: 768 }, { width: 390, height: 844 }];

/** Part 12 has a bore that is too large, part 20 one that is too small, part 25 lacks its slot. */
const valueOf = (part, i) => (i === 1 && part === 12 ? 25.024 : i === 0 && part === 20 ? 24.998 : 25.0105 + 0.006 * Math.sin(part * 1.7 + i) - 0.0005 * i);
const record = (part, i, more) => ({ designation: '25 H7', measured_mm: valueOf(part, i).toFixed(4), part_id: `SN-${1000 + part}`, characteristic: NAMES[i], machine: 'M1', ...more });

const settled = (page) => page.waitForSelector('.overview .scroll[data-settled]', { state: 'attached' });

describe('the overview', () => {
  before(async () => {
    const values = Array.from({ length: PARTS }, (_, part) => NAMES.map((_name, i) => record(part, i)).filter((_one, i) => !(part === 25 && i === 3))).flat();
    await daemon.send('POST', '/v1/measurements', values);
    await daemon.send('POST', '/v1/measurements', { ...record(0, 0), machine: 'M2', part_id: 'OTHER-1' });
  });

  it('shows every characteristic of a machine or a plan, the worst first, as the values come in', async () => {
    const values = (characteristic, middle, spread, count = 40) => Array.from({ length: count }, (_, i) => ({
      designation: '25 H7', measured_mm: (middle + spread * Math.sin(i * 2.4)).toFixed(4), characteristic, machine: 'OV-1' }));
    await daemon.send('POST', '/v1/measurements', [...values('ov-fine', 25.0105, 0.002), ...values('ov-edge', 25.019, 0.003), ...values('ov-few', 25.01, 0.001, 5)]);
    await daemon.send('PUT', '/v1/plans/OV-PLAN', { characteristics: ['ov-fine', 'ov-new'].map((name) => ({ name, designation: '25 H7' })) });
    const page = await open(browser, daemon, '#/overview?machine=OV-1');
    const order = (names) => page.waitForFunction((wanted) => [...document.querySelectorAll('.overview tbody th')].map((cell) => cell.textContent).join() === wanted, names.join());
    await order(['ov-edge', 'ov-fine', 'ov-few']);
    const { ppk } = await daemon.json('/v1/measurements/capability?characteristic=ov-edge&machine=OV-1');
    assert.match(await page.textContent('.overview tbody tr'), new RegExp(`^ov-edge40[^]*${ppk.value.toFixed(2)}`.replace('.', '\\.')));
    assert.ok(await page.$('.overview tbody tr:last-child .index.in-doubt'), 'five values are no index');
    await picture(page, 'overview', { fullPage: true });
    await daemon.send('POST', '/v1/measurements', Array.from({ length: 5 }, () => ({ designation: '25 H7', measured_mm: '25.09', characteristic: 'ov-fine', machine: 'OV-1' })));
    await page.waitForFunction(() => /ov-fine45/.test(document.querySelector('.overview tbody tr')?.textContent));
    assert.match(await page.textContent('.overview tbody tr'), /Not stable/);
    await page.selectOption('#overview-plan', 'OV-PLAN');
    await order(['ov-fine', 'ov-new']);
    assert.match(await page.textContent('.overview tbody tr:last-child'), /No values yet/);
    await page.click('.overview tbody a');
    await untilPoints(page, 45);
    assert.match(hashOf(page), /^#\/trend\?characteristic=ov-fine/);
    await close(page);
  });

  it('maps parts by characteristic: every value at its place, by keys, by touch and as a table', async () => {
    const page = await open(browser, daemon, '#/overview?machine=M1', { viewport: SIZES[0] });
    await settled(page);
    await page.click('.looks >> text=Parts by characteristic');
    assert.match(hashOf(page), /look=heat&machine=M1/);
    await page.waitForSelector('.heat .cell');
    const cells = (verdict) => page.$$eval(`.heat .picture .cell[data-verdict="${verdict}"]`, (all) => all.length);
    assert.deepEqual([await cells('reject'), await cells('rework'), await cells('none'), await cells('good')], [1, 1, 1, PARTS * NAMES.length - 3]);
    // A value near the upper limit stands above one near the lower limit.
    const order = await page.$$eval('.heat .legend .place', (all) => all.map((bar) => Number(bar.getAttribute('y'))));
    assert.ok(order[0] < order[1] && order[1] < order[2]);
    await page.focus('.heat .picture');
    await page.keyboard.press('ArrowLeft');
    await page.waitForFunction((part) => document.querySelector('.heat .detail').textContent.startsWith(part), `SN-${1000 + PARTS - 1}`);
    await page.keyboard.press('ArrowLeft');
    await page.waitForFunction((part) => document.querySelector('.heat .detail').textContent.startsWith(part), `SN-${1000 + PARTS - 2}`);
    const box = await page.$eval('.heat .picture .cell[data-verdict="reject"] > rect', (cell) => { cell.scrollIntoView({ block: 'center' }); const { x, y, width, height } = cell.getBoundingClientRect(); return [x + width / 2, y + height / 2]; });
    await page.mouse.click(...box);
    await page.waitForFunction(() => /SN-1012.*bore-B.*Reject.*25\.024 mm/.test(document.querySelector('.heat .detail').textContent));
    await page.click('.heat summary');
    await page.waitForFunction((count) => document.querySelectorAll('.heat tbody tr').length === count, PARTS);
    const rows = await page.$$eval('.heat tbody tr', (all) => all.map((row) => row.textContent));
    assert.match(rows.find((row) => row.startsWith('SN-1012')), /Reject 25\.024/);
    assert.match(rows.find((row) => row.startsWith('SN-1025')), /–/);
    assert.deepEqual(await findings(page), []);
    await page.click('.heat summary');
    for (const size of SIZES) {
      await page.setViewportSize(size);
      await page.waitForFunction((width) => document.querySelector('.heat svg').getBoundingClientRect().right <= width, size.width);
      await page.waitForFunction(() => document.documentElement.scrollWidth <= innerWidth);
      await picture(page, `overview-heat-${size.width}`, { fullPage: true });
    }
    await page.setViewportSize(SIZES[0]);
    await page.emulateMedia({ colorScheme: 'dark' });
    await picture(page, 'overview-heat-dark', { fullPage: true });
    await page.click('.heat .detail a >> text=bore-B');
    await page.waitForSelector('.control-chart');
    assert.match(hashOf(page), /characteristic=bore-B.*machine=M1/);
    await close(page);
  });

  it('is a wall of small charts of a machine, which a value that comes changes', async () => {
    const page = await open(browser, daemon, '#/overview?machine=M1&look=wall', { viewport: SIZES[0] });
    await page.waitForFunction((count) => document.querySelectorAll('.wall .spark').length === count, NAMES.length);
    assert.equal(await page.getAttribute('.looks >> text=Small charts', 'aria-pressed'), 'true');
    await daemon.send('POST', '/v1/measurements', [record(0, 6, { part_id: 'SN-2000', measured_mm: '25.031' }), record(0, 7, { machine: 'M2', part_id: 'OTHER-2' })]);
    await page.waitForFunction(() => /collar.*Reject25\.031 mmSN-2000/.test(document.querySelector('.wall').textContent));
    assert.ok(!(await page.textContent('.wall')).includes('OTHER-2'));
    assert.equal(await page.$$eval('.wall li:has(a[href*="collar"]) .spark .shape[data-verdict="reject"]', (all) => all.length), 1);
    assert.deepEqual(await findings(page), []);
    for (const size of SIZES) {
      await page.setViewportSize(size);
      await page.waitForFunction(() => document.documentElement.scrollWidth <= innerWidth);
      await picture(page, `overview-wall-${size.width}`, { fullPage: true });
    }
    await page.click('.looks >> text=List');
    await page.waitForFunction((count) => document.querySelectorAll('.overview tbody tr').length === count, NAMES.length);
    assert.ok(!hashOf(page).includes('look='));
    await close(page);
  });

  it('fits 1024 in Italian', async () => {
    const page = await open(browser, daemon, '#/overview?machine=M1&look=heat', { viewport: { width: 1024, height: 768 }, locale: 'it-IT' });
    await page.waitForSelector('.heat .picture .cell');
    await page.waitForFunction(() => document.documentElement.scrollWidth <= innerWidth);
    await picture(page, 'overview-heat-it', { fullPage: true });
    await close(page);
  });
});
