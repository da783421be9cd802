/** What a control chart draws and says of its values, on the screen and on paper. */

import assert from 'node:assert/strict';
import fs from 'node:fs';
import { afterEach, describe, it } from 'node:test';

import { browserName, close, findings, hashOf, hasZones, open, picture } from './support/browser.mjs';
import { leastLettering, lettering, marksOf, openChart, untilPoints } from './support/chart.mjs';
import { eventually } from './support/eventually.mjs';
import { browser, daemon } from './support/stage.mjs';

let page;

afterEach(() => close(page));

const hash = () => hashOf(page);

describe('a control chart', () => {
  it('is a control chart: limits, broken rules by number, indices that are grey while they mean nothing', async () => {
    // Montgomery, Introduction to Statistical Quality Control, the individuals of example 6.5 (viscosity of
    // primer paint), as micrometres above 33 mm; the book has centre 33.52, MR 0.48, limits 34.80 and 32.24.
    const viscosity = [33.75, 33.05, 34.00, 33.81, 33.46, 34.02, 33.68, 33.27, 33.49, 33.20, 33.62, 33.00, 33.54, 33.12, 33.84];
    await daemon.send('POST', '/v1/measurements', viscosity.map((value, i) => ({
      nominal_mm: 33, feature: 'hole', upper_um: 36, lower_um: 31, measured_mm: (33 + value / 1000).toFixed(5), characteristic: 'paint', part_id: `P-${i + 1}`,
    })));
    page = await openChart(browser, daemon, '#/trend?characteristic=paint');
    await untilPoints(page, 15);
    const near = (texts, value) => texts.some((text) => Math.abs(parseFloat(text.replace(/^[UL]?CL /, '')) - value) < 0.011);
    for (const value of [33.52, 34.8, 32.24, 0.48]) {
      assert.ok(near(await lettering(page), value), `${value} in ${await lettering(page)}`);
      assert.ok(near(await page.$$eval('.in-figures td', (cells) => cells.map((cell) => cell.textContent)), value), `${value} in figures`);
    }
    const broken = async () => Number(/\d+$/.exec(await page.textContent('.in-figures summary')));
    assert.equal(await broken(), 0);
    assert.ok(!(await lettering(page)).includes('1'));
    assert.match(await page.textContent('.stability.doubt'), /n = 15/);
    await page.click('.rules button');
    await page.waitForFunction(() => /centre=33\.5/.test(location.hash));
    await daemon.send('POST', '/v1/measurements', { nominal_mm: 33, feature: 'hole', upper_um: 36, lower_um: 31, measured_mm: '33.0358', characteristic: 'paint', part_id: 'P-16' });
    await untilPoints(page, 16); // the chart is drawn a turn after its figures
    assert.equal(await broken(), 1);
    assert.ok((await lettering(page)).includes('1'), 'the rule stands at the point');
    assert.match(await page.textContent('.stability.doubt'), /Not stable: rule 1 at P-16/);
    assert.ok(near(await lettering(page), 33.52), 'frozen limits stay');
    assert.ok(await page.$('.tiles.in-doubt'));
    await page.focus('.trend figure');
    await page.keyboard.press('ArrowLeft');
    assert.match(await page.textContent('.detail'), /P-16.*breaks rule 1/);
    await page.keyboard.press('ArrowLeft');
    assert.match(await page.textContent('.detail'), /P-15/);
    await page.click('.in-figures summary');
    assert.match(await page.textContent('.in-figures .scroll tbody'), /P-16\+35\.8 µm1/);
    assert.deepEqual(await findings(page), []);
    await picture(page, 'trend-in-figures', { fullPage: true });
    await page.click('.in-figures button');
    assert.match(await page.textContent('.detail'), /P-16.*breaks rule 1/);
    await page.uncheck('.rules input[value="1"]');
    await page.waitForFunction(() => /0$/.test(document.querySelector('.in-figures summary')?.textContent));
    await eventually(async () => assert.ok(!(await lettering(page)).includes('1')));
    await picture(page, 'trend-control', { fullPage: true });
  });

  it('names the distribution and the model behind an index, and says why there is none', async () => {
    const spread = (of) => Array.from({ length: 100 }, (_, i) => of((((i * 37) % 100) + 0.5) / 100));
    const CASES = {
      'fit-weibull': spread((share) => 5 * (-Math.log(1 - share)) ** (1 / 1.3)), 'fit-none': spread((share) => (share < 0.5 ? 1 : 20)),
      'fit-few': [3, 4, 5, 4, 3, 5],
    };
    for (const [characteristic, all] of Object.entries(CASES)) {
      await daemon.send('POST', '/v1/measurements', all.map((um) => ({ designation: '25 H7', measured_mm: (25 + um / 1000).toFixed(6), characteristic })));
    }
    const said = async (characteristic) => {
      page = await open(browser, daemon, `#/trend?characteristic=${characteristic}`);
      await page.waitForSelector('.indices .stability');
      const found = await page.$$eval('.indices .fitted', (all) => all.map((one) => one.textContent));
      const tiles = await page.$$eval('.indices dl > div', (all) => all.map((one) => one.textContent));
      const values = (await daemon.stored(`characteristic=${characteristic}`)).map(({ deviation_um: um }) => um);
      const { model, distribution } = await (await daemon.send('POST', '/v1/statistics/capability', { values, lower: 0, upper: 21 })).json();
      return { found, tiles, model, distribution };
    };
    const fitted = await said('fit-weibull');
    assert.deepEqual(fitted.found, [`Distribution: Weibull · fit p = ${fitted.distribution.p.toFixed(3)} · indices by its percentiles`, 'Model A2: location and dispersion constant, not normal (ISO 22514-2)']);
    assert.equal(fitted.model.name, 'A2');
    assert.deepEqual(await findings(page), []);
    await picture(page, 'trend-fitted');
    await close(page);
    const none = await said('fit-none');
    assert.equal(none.found[0], 'No distribution of ISO 22514-2 fits the values: no index.');
    assert.deepEqual(none.tiles, ['Cp–', 'Cpk–', 'Pp–', 'Ppk–']);
    await close(page);
    const few = await said('fit-few');
    assert.deepEqual([few.found, few.tiles.length], [[], 4]);
  });

  it('rings where values begin to break rules, and counts those that fall together among many', async () => {
    const post = (characteristic, count, mmOf) => daemon.send('POST', '/v1/measurements', Array.from({ length: count }, (_, i) => ({ designation: '25 H7', measured_mm: mmOf(i).toFixed(4), characteristic })));
    const rings = async () => (await lettering(page)).filter((text) => /^[1-4](,[1-4])*$|^\d+×$/.test(text));
    // Two levels far apart: each value breaks rule 1, and others come and go along the way.
    await post('two-levels', 30, (i) => (i < 15 ? 25.004 : 25.016) + (i % 2) * 0.0005);
    page = await openChart(browser, daemon, '#/trend?characteristic=two-levels');
    await untilPoints(page, 30);
    assert.deepEqual(await rings(), ['1']);
    assert.doesNotMatch(await page.textContent('.detail'), /3×/);
    await close(page);
    // The first value beyond a limit, though the one before it breaks another rule.
    await post('far-after-trend', 31, (i) => (i === 30 ? 25.0205 : i < 20 ? 25.01 + (i % 2) * 0.001 : 25.009));
    page = await openChart(browser, daemon, '#/trend?characteristic=far-after-trend');
    await untilPoints(page, 31);
    assert.match((await rings()).at(-1), /^1/);
    await close(page);
    // Rule 4 begins at the eighth value on one side, where rule 3 is broken already.
    await post('far-side', 40, (i) => (i < 28 ? 25.01 + (i % 2) * 0.002 : 25.0135 + (i % 2) * 0.0002));
    page = await openChart(browser, daemon, '#/trend?characteristic=far-side');
    await untilPoints(page, 40);
    const { violations, charts: [{ name }] } = await daemon.json('/v1/measurements/chart?characteristic=far-side&rules=1,2,3,4');
    const broken = violations.filter(({ chart }) => chart === name);
    const fourth = Math.min(...broken.filter(({ rule }) => rule === 4).map(({ index }) => index));
    assert.ok(broken.some(({ index, rule }) => index === fourth - 1 && rule !== 4) && broken.every(({ rule }) => rule !== 1), JSON.stringify(broken));
    assert.ok((await rings()).some((text) => /4/.test(text)), String(await rings()));
    await close(page);
    await post('pairs-out', 1200, (i) => (i % 40 === 0 || i % 40 === 2 ? 25.018 : 25.01 + (i % 2) * 0.001));
    page = await openChart(browser, daemon, '#/trend?characteristic=pairs-out&count=5000&rules=1');
    await untilPoints(page, 1200);
    const counted = await rings();
    assert.ok(counted.length > 10 && counted.every((text) => text === '2×'), String(counted));
    assert.match(await page.textContent('.detail'), /3×: three places/);
  });

  it('draws a range far beyond its limit at the edge with its size, so that the others are seen', async () => {
    await daemon.send('POST', '/v1/measurements', Array.from({ length: 60 }, (_, i) => ({ designation: '25 H7', measured_mm: i === 30 ? '25.09' : `25.01${i % 2}`, characteristic: 'one-slip' })));
    page = await openChart(browser, daemon, '#/trend?characteristic=one-slip');
    await untilPoints(page, 60);
    assert.deepEqual((await lettering(page)).filter((text) => text.startsWith('▲')), ['▲ +90', '▲ 79']);
  });

  it('names centre and control limits at the edge where an outlier has moved them beyond it', async () => {
    await daemon.send('POST', '/v1/measurements', Array.from({ length: 60 }, (_, i) => ({ designation: '25 H7', measured_mm: i === 30 ? '2009' : `25.01${i % 2}`, characteristic: 'outlier', confirmed: i === 30 || undefined })));
    page = await openChart(browser, daemon, '#/trend?characteristic=outlier');
    await untilPoints(page, 60);
    const { charts: [{ centre, upper_limit: upper, lower_limit: lower }] } = await daemon.json('/v1/measurements/chart?characteristic=outlier');
    const named = (await lettering(page)).filter((text) => /^[▲▼] [UL]?CL /.test(text));
    const um = (mm) => String(Math.round((mm - 25) * 1000)).replace('-', '\u2212');
    assert.deepEqual(named.slice(0, 3), [`▲ UCL ${um(upper)}`, `▲ CL ${um(centre)}`, `▼ LCL ${um(lower)}`]);
    await picture(page, 'trend-outlier');
  });

  it('writes the last values, and Parts its rows, with the decimals that most of them have, or more', async () => {
    await daemon.send('POST', '/v1/measurements', ['25.0101', '25.0112', '25.012', '25.013001'].map((measured_mm) => ({ designation: '25 H7', measured_mm, characteristic: 'decimals' })));
    const newest = ['25.013001', '25.0120', '25.0112', '25.0101'];
    page = await openChart(browser, daemon, '#/trend?characteristic=decimals');
    await untilPoints(page, 4);
    assert.deepEqual(await page.$$eval('.trend > .scroll tbody td:nth-child(2)', (all) => all.map(({ textContent }) => textContent)), newest.map((text) => `${text} mm`));
    await page.evaluate(() => { location.hash = '#/parts?characteristic=decimals'; });
    await page.waitForFunction(() => document.querySelectorAll('.records tbody tr').length === 4);
    assert.deepEqual(await page.$$eval('.records tbody td:nth-child(4)', (all) => all.map(({ textContent }) => textContent)), newest);
  });

  it('writes the day and the time of a value as they are here, in the form of the language', { skip: !hasZones }, async () => {
    await daemon.send('POST', '/v1/measurements', ['25.01', '25.011'].map((measured_mm) => ({ designation: '25 H7', measured_mm, characteristic: 'at-night', measured_at: '2026-03-31T22:30:00Z' })));
    page = await openChart(browser, daemon, '#/trend?characteristic=at-night', { locale: 'de-DE', timezoneId: 'Europe/Berlin' });
    await untilPoints(page, 2);
    const texts = await lettering(page);
    assert.ok(texts.includes('01.04. 00:30'), String(texts));
  });

  it('marks where a note was added, a value was corrected or another tool came', async () => {
    const content = { designation: '25 H7', characteristic: 'events' };
    const stored = [];
    for (const [i, mm] of ['25.010', '25.012', '25.011', '25.013'].entries()) {
      stored.push(await (await daemon.send('POST', '/v1/measurements', { ...content, measured_mm: mm, part_id: `E-${i}`, tool: i < 2 ? 'T1' : 'T2' })).json());
    }
    page = await openChart(browser, daemon, '#/trend?characteristic=events');
    await untilPoints(page, 4);
    assert.deepEqual((await lettering(page)).filter((text) => /^([NC]|TC)$/.test(text)), ['TC']);
    await daemon.send('POST', `/v1/measurements/${stored[1].id}/notes`, { cause: 'Insert worn', measure: 'Insert changed' });
    await daemon.send('POST', `/v1/measurements/${stored[3].id}/corrections`, { measured_mm: '25.014', operator: 'Kim', reason: 'Misread' });
    await close(page);
    page = await openChart(browser, daemon, '#/trend?characteristic=events');
    await untilPoints(page, 4);
    assert.deepEqual((await lettering(page)).filter((text) => /^([NC]|TC)$/.test(text)), ['N', 'TC', 'C']);
    assert.match(await page.textContent('.detail'), /N: a note, C: a corrected value, TC: another tool/);
    await page.focus('.trend figure');
    await page.keyboard.press('ArrowLeft');
    assert.match(await page.textContent('.detail'), /E-3.*corrected/);
    await page.keyboard.press('ArrowLeft');
    await page.keyboard.press('ArrowLeft');
    assert.match(await page.textContent('.detail'), /E-1.*Insert worn → Insert changed/);
  });

  it('shows 10,000 values, a stretch of them that is drawn across, and the record of a point in it', async () => {
    const size = (i) => (25.01 + ((i * 7919) % 1000) / 200_000 + (i === 9000 ? 0.02 : 0)).toFixed(6);
    await daemon.send('POST', '/v1/measurements', Array.from({ length: 10_000 }, (_, i) => ({ designation: '25 H7', measured_mm: size(i), characteristic: 'many', part_id: `T-${i}` })));
    page = await openChart(browser, daemon, '#/trend?characteristic=many&count=10000');
    await untilPoints(page, 10_000);
    assert.equal(await page.textContent('.tiles dd'), '9999');
    assert.equal((await marksOf(page, 'reject')).length, 1);
    assert.equal((await marksOf(page, 'good')).length, 0); // where they are dense the good are a line
    assert.ok(await page.isHidden('.stretch'));
    const texts = await lettering(page);
    assert.deepEqual(['µm', 'U +21', 'L 0', 'T +10.5'].filter((text) => !texts.includes(text)), []);
    const plot = await (await page.$('.control-chart .u-over')).boundingBox();
    const drawAcross = async (from, to) => {
      const y = plot.y + plot.height / 2;
      await page.mouse.move(plot.x + from * plot.width, y);
      await page.mouse.down();
      await page.mouse.move(plot.x + to * plot.width, y, { steps: 3 });
      assert.ok((await (await page.$('.control-chart .u-select')).boundingBox()).width > 5, 'what is chosen is shown');
      await page.mouse.up();
    };
    await drawAcross(0.875, 0.9);
    await page.waitForSelector('.stretch:visible');
    const [from, to, of] = (await page.textContent('.stretch span')).match(/\d+/g).map(Number);
    assert.ok(of === 10_000 && from < 9001 && to > 9001 && to - from < 500, `${from} ${to}`);
    await untilPoints(page, to - from + 1);
    const [point] = await marksOf(page, 'reject');
    await page.mouse.click(point.x, point.y);
    await page.waitForFunction(() => /T-9000/.test(document.querySelector('.detail')?.textContent));
    assert.match(await page.textContent('.detail'), /Reject25\.03\d* mm/);
    await page.$eval('.stretch input', (slider) => { slider.value = 0; slider.dispatchEvent(new Event('input')); });
    await page.waitForFunction(() => /^1 to/.test(document.querySelector('.stretch span')?.textContent));
    assert.deepEqual(await findings(page), []);
    await picture(page, 'trend-stretch', { fullPage: true });
    await page.getByRole('button', { name: 'Show all' }).click();
    await page.waitForSelector('.stretch', { state: 'hidden' });
  });

  it('is drawn in the colours of the page, and anew where these change', async () => {
    await daemon.send('POST', '/v1/measurements', Array.from({ length: 30 }, (_, i) => ({ designation: '25 H7', measured_mm: i % 10 ? '25.01' : '25.03', characteristic: 'colours' })));
    page = await openChart(browser, daemon, '#/trend?characteristic=colours', { colorScheme: 'light' });
    await untilPoints(page, 30);
    const marks = async () => [(await marksOf(page, 'good')).length, (await marksOf(page, 'reject')).length];
    assert.deepEqual(await marks(), [27, 3]);
    await page.emulateMedia({ colorScheme: 'dark' });
    await eventually(async () => assert.deepEqual(await marks(), [27, 3]));
    if (browserName === 'chromium') {
      await page.emulateMedia({ forcedColors: 'active' });
      await eventually(async () => assert.ok((await marks())[1] >= 3, 'in the text colour of the system'));
      assert.deepEqual(await findings(page), []);
      await picture(page, 'trend-forced', { fullPage: true });
    }
  });

  it('prints in black and white with the dots of a printer, and fits A4 and Letter', async () => {
    page = await openChart(browser, daemon, '#/trend?characteristic=colours', { colorScheme: 'dark' });
    await untilPoints(page, 30);
    // Looked up within: a change of the window draws on a new canvas.
    const look = () => page.evaluate(() => {
      const canvas = document.querySelector('.control-chart canvas');
      const { data } = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height);
      let colour = 0;
      for (let at = 0; at < data.length; at += 4) if (data[at + 3] === 255) colour = Math.max(colour, Math.abs(data[at] - data[at + 1]), Math.abs(data[at + 1] - data[at + 2]));
      const { left, right } = canvas.closest('.control-chart').getBoundingClientRect();
      return { dots: canvas.width / canvas.getBoundingClientRect().width, hasColour: colour > 40, left, right, inside: document.querySelector('.trend figure').getBoundingClientRect().right };
    });
    const onScreen = await look();
    assert.ok(onScreen.dots === 1 && onScreen.hasColour, JSON.stringify(onScreen));
    for (const [format, width] of [['A4', 658], ['Letter', 680]]) {
      await page.setViewportSize({ width, height: 900 });
      await page.evaluate(() => dispatchEvent(new Event('beforeprint')));
      await page.emulateMedia({ media: 'print' });
      const printed = await look();
      assert.ok(printed.dots >= 4 && !printed.hasColour, JSON.stringify(printed));
      // The driver of Firefox does not put a page on paper.
      if (browserName === 'chromium') assert.ok(printed.left >= 0 && printed.right <= printed.inside && printed.inside <= width, `${format}: ${JSON.stringify(printed)}`);
      assert.ok(await leastLettering(page) >= 12, `${await leastLettering(page)} pixels`);
      assert.equal((await marksOf(page, 'reject')).length >= 3, true);
      await picture(page, `trend-on-${format}`, { fullPage: true });
      await page.emulateMedia({ media: 'screen' });
      await page.evaluate(() => dispatchEvent(new Event('afterprint')));
    }
    await page.setViewportSize({ width: 1280, height: 800 });
    await page.waitForFunction((right) => document.querySelector('.control-chart').getBoundingClientRect().right === right, onScreen.right);
    await eventually(async () => assert.deepEqual(await look(), onScreen));
  });

  it('shows the next offset of one machine below the chart, with its interval and where it is from; none for several', async () => {
    const wear = (machine) => Array.from({ length: 40 }, (_, i) => ({
      designation: '25 H7', measured_mm: (25.004 + i * 0.0004 + (i % 3) * 0.0005).toFixed(4), characteristic: 'offset', machine }));
    await daemon.send('POST', '/v1/measurements', wear('M-9'));
    page = await openChart(browser, daemon, '#/trend?characteristic=offset');
    await untilPoints(page, 40);
    const found = await daemon.json('/v1/measurements/compensation?characteristic=offset&machine=M-9');
    await page.waitForFunction(() => /Next offset/.test(document.querySelector('.offset:not([hidden])')?.textContent));
    assert.equal(await page.getAttribute('.offset [data-state]', 'data-state'), found.state);
    const shown = await page.textContent('.offset');
    assert.ok(shown.includes(found.clause) && shown.includes(found.reason), shown);
    assert.ok(shown.includes(`\u2212${Math.abs(found.offset_um).toFixed(1)} µm`) && shown.includes(found.next_in_parts === 1 ? 'with the next part' : `in ${found.next_in_parts} parts`), shown);
    assert.deepEqual(await findings(page), []);
    await picture(page, 'trend-offset', { fullPage: true });
    await page.route('**/v1/measurements/compensation?*', (route) => route.fulfill({ json: { ...found, next_in_parts: 1 } }));
    await page.uncheck('.rules input[value="4"]'); // computes, and asks anew
    await page.waitForFunction(() => /with the next part/.test(document.querySelector('.offset')?.textContent));
    await page.unroute('**/v1/measurements/compensation?*');
    await daemon.send('POST', '/v1/measurements', wear('M-10'));
    await untilPoints(page, 80);
    await page.waitForSelector('.offset', { state: 'hidden' });
    await page.fill('[name="machine"]', 'M-10');
    await page.press('[name="machine"]', 'Enter');
    await page.waitForSelector('.offset:not([hidden])');
  });

  it('draws a drawing with one limit', async () => {
    await daemon.send('POST', '/v1/measurements', Array.from({ length: 30 }, (_, i) => ({ nominal_mm: 8, feature: 'hole', upper_um: 36, measured_mm: `8.0${10 + (i * 7) % 20}`, characteristic: 'one-limit' })));
    page = await openChart(browser, daemon, '#/trend?characteristic=one-limit');
    await untilPoints(page, 30);
    const texts = await lettering(page);
    assert.deepEqual(texts.slice(texts.indexOf('µm')).slice(0, 2), ['µm', 'U +36']);
    assert.deepEqual(texts.filter((text) => /^[ULT] /.test(text)), ['U +36'], 'no lower limit, no target');
    const named = await page.textContent('.in-figures table');
    assert.ok(/Upper limit/.test(named) && !/Lower limit/.test(named), named);
    assert.match(await page.textContent('.indices'), /Cpk/);
    assert.doesNotMatch(await page.textContent('.trend'), /NaN|undefined|Infinity/);
  });

  it('draws values without limits, with a nominal size or none, as values: no limits, no index, no question for one', async () => {
    const of = (characteristic, i, more) => ({ quantity: 'position', measured_mm: `40.0${10 + (i * 7) % 20}`, characteristic, machine: 'FREE', part_id: `F-${i}`, ...more });
    await daemon.send('POST', '/v1/measurements', Array.from({ length: 30 }, (_, i) => [of('no-limits', i, { nominal_mm: 40 }), of('no-nominal', i)]).flat());
    page = await openChart(browser, daemon, '#/trend?characteristic=none-yet'); // what is asked of other values is not counted
    await page.waitForSelector('.empty');
    const refused = [];
    page.on('response', (answer) => answer.status() >= 400 && refused.push(answer.url()));
    for (const [name, size, mean] of [['no-limits', '40 mm', '18.83'], ['no-nominal', '– mm', '40018.83']]) {
      await page.evaluate((address) => { location.hash = address; }, `#/trend?characteristic=${name}`);
      await page.waitForFunction((wanted) => document.querySelector('#trend-designation')?.selectedOptions[0]?.textContent === wanted, size);
      await untilPoints(page, 30);
      assert.match(hash(), new RegExp(`designation=${size.replace(' ', '.')}`));
      const texts = await lettering(page);
      assert.deepEqual(texts.filter((text) => /^[ULT] /.test(text)), [], 'no limits, no target');
      assert.deepEqual(['CL', 'UCL', 'LCL'].filter((line) => !texts.some((text) => text.startsWith(`${line} `))), []);
      assert.match(await page.textContent('.indices'), /No capability: the values have no limits/);
      assert.match(await page.textContent('.tiles'), new RegExp(`^Not judged30Mean\\+${mean}`));
      assert.equal((await marksOf(page, 'edge')).length > 0, true, 'each value has a mark');
      assert.match(await page.textContent('.trend > .scroll tbody tr'), /^Not judged40\.0\d\d mm/);
      assert.doesNotMatch(await page.textContent('.trend'), /NaN|undefined|Infinity/);
    }
    await picture(page, 'trend-no-limits', { fullPage: true });
    await page.evaluate(() => { location.hash = '#/overview?machine=FREE'; });
    await page.waitForFunction(() => /no-limits30.*no-nominal30/.test(document.querySelector('.overview tbody')?.textContent));
    assert.match(await page.textContent('.overview'), /the values have no limits/);
    assert.doesNotMatch(await page.textContent('.overview'), /NaN|undefined|Infinity/);
    assert.deepEqual(refused, []);
  });

  it('charts the means of subgroups, and leaves out one that is still being measured', async () => {
    // Piston rings (Montgomery), 25 samples of five, as R's qcc has them: means 74.001176 between 73.98805 and
    // 74.01431, ranges 0.02276 below 0.04812; with s 0.00924 below 0.0193.
    const samples = fs.readFileSync('tests/reference/piston_rings.txt', 'utf8').trim().split('\n').slice(0, 25).map((line) => line.trim().split(/\s+/));
    const ring = (measured_mm, subgroup) => ({ nominal_mm: 74, feature: 'hole', upper_um: 50, lower_um: -50, measured_mm, characteristic: 'ring', subgroup });
    await daemon.send('POST', '/v1/measurements', [...samples.flatMap((sample, i) => sample.map((value) => ring(value, `S-${i + 1}`))), ring('74.001', 'S-26')]);
    page = await openChart(browser, daemon, '#/trend?characteristic=ring&count=200');
    await untilPoints(page, 126);
    const near = (label) => page.waitForFunction((wanted) => globalThis.lettering.get(document.querySelector('.control-chart canvas'))
      .some(({ text }) => Math.abs(Number(text.replace(/^[UL]?CL /, '').replace('−', '-')) - wanted) < 0.06), label);
    await page.selectOption('#trend-kind', 'xbar_r');
    await untilPoints(page, 25);
    for (const label of [1.18, 14.31, -11.95, 22.76, 48.12]) await near(label);
    assert.match(await page.textContent('.detail'), /1 values of incomplete subgroups/);
    assert.ok((await lettering(page)).includes('R'));
    await page.focus('.trend figure');
    await page.keyboard.press('ArrowLeft');
    await page.waitForFunction(() => /S-25.*74\.013/.test(document.querySelector('.detail')?.textContent));
    await picture(page, 'trend-means', { fullPage: true });
    await page.selectOption('#trend-kind', 'xbar_s');
    for (const label of [1.18, 14.36, -12.01, 9.24, 19.3]) await near(label);
    assert.match(hash(), /kind=xbar_s/);
    await daemon.send('POST', '/v1/measurements', ['74.002', '74.003', '74.001', '74.0'].map((value) => ring(value, 'S-26')));
    await untilPoints(page, 26);
    await close(page);
    page = await open(browser, daemon, '#/trend?characteristic=ring&count=200&kind=xbar_s');
    await untilPoints(page, 26);
  });
});
