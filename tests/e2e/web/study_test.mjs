/** Gauges with their calibrations, and the study of one: from a form, from records, on one master. */

import assert from 'node:assert/strict';
import { before, describe, it } from 'node:test';

import { browserName, close, drawn, findings, hashOf, hasZones, open, picture } from './support/browser.mjs';
import { holdAll } from './support/hold.mjs';
import { browser, daemon } from './support/stage.mjs';

/** Ten parts, three operators, three trials: parts 2 µm apart, an operator half a micrometre off, trials 0.3 µm apart. */
const PARTS = 10;
const OPERATORS = ['Kim', 'Jo', 'Li'];
const readingOf = (part, operator, trial) => (25 + part * 0.002 + operator * 0.0005 + [-0.0003, 0.0001, 0.0002][(part + trial + operator) % 3]).toFixed(4);
const ROUNDS = OPERATORS.flatMap((_, operator) => [0, 1, 2].map((trial) => [operator, trial]));

describe('a gauge', () => {
  before(async () => {
    await daemon.send('PUT', '/v1/uncertainties/bore-gauge', { contributions: [{ name: 'ring', standard_uncertainty: 0.3 }] });
    await daemon.send('PUT', '/v1/gauges-in-use/G-07', { uncertainty: 'bore-gauge', calibration_due: '2020-03-31' });
    await daemon.send('POST', '/v1/measurements', ROUNDS.flatMap(([operator, trial]) => Array.from({ length: PARTS }, (_, part) => (
      { designation: '25 H7', measured_mm: readingOf(part, operator, trial), part_id: `P${part + 1}`, operator: OPERATORS[operator], characteristic: 'study-G-07' }))));
  });

  it('is overdue until its calibration is recorded, in a table with a form; another is added', async () => {
    const page = await open(browser, daemon, '#/overview', { viewport: { width: 1366, height: 768 } });
    await page.click('text=Gauges and gauge studies');
    await page.waitForFunction(() => /G-07.*overdue.*u = 0\.3 µm/.test(document.querySelector('.gauges .listed tbody')?.textContent));
    await page.click('.listed .quiet >> text=G-07');
    await page.waitForSelector('.of-gauge form');
    assert.match(hashOf(page), /gauges\/G-07/);
    await page.fill('[name="due"]', '2099-03-31');
    await page.fill('[name="certificate"]', 'K-1234');
    await page.fill('[name="laboratory"]', 'Lab');
    await page.click('.of-gauge .primary');
    await page.waitForFunction(() => /recorded/.test(document.querySelector('.gauges .note').textContent));
    assert.match(await page.textContent('.of-gauge tbody'), /31 Mar 2099in useK-1234Lab/);
    assert.match(await page.textContent('.gauges > section .listed tbody'), /in use/);
    const { calibrations } = await daemon.json('/v1/gauges-in-use/G-07/calibrations');
    assert.deepEqual(calibrations.map(({ due, certificate }) => [due, certificate]), [['2099-03-31', 'K-1234']]);
    await page.click('.of-gauge .primary'); // without a due date
    await page.waitForFunction(() => document.querySelector('.gauges .note').textContent !== '' && !/recorded/.test(document.querySelector('.gauges .note').textContent));
    await page.click('.add-gauge summary');
    await page.fill('[name="gauge"]', 'G-08');
    await page.fill('[name="calibration_due"]', '2098-01-31');
    await page.click('.add-gauge .primary');
    await page.waitForFunction(() => /G-08/.test(document.querySelector('.of-gauge h2')?.textContent));
    assert.equal((await daemon.json('/v1/gauges-in-use/G-08')).calibration_due, '2098-01-31');
    assert.deepEqual(await findings(page), []);
    await picture(page, 'gauges');
    await close(page);
  });

  it('gets the calibration of its own form, once, and keeps what is not typed anew', async () => {
    for (const name of ['C-1', 'C-2']) await daemon.send('PUT', `/v1/gauges-in-use/${name}`, { calibration_due: '2099-03-31', uncertainty: 'bore-gauge' });
    const page = await open(browser, daemon, '#/gauges/C-2');
    const recorded = () => page.waitForFunction(() => /recorded/.test(document.querySelector('.gauges .note').textContent));
    const typed = () => Promise.all(['due', 'certificate', 'status'].map((name) => page.inputValue(`.of-gauge [name="${name}"]`)));
    await page.waitForSelector('.of-gauge form');
    await page.fill('.of-gauge [name="due"]', '2099-05-31');
    await page.fill('.of-gauge [name="certificate"]', 'K-OF-2');
    await page.selectOption('.of-gauge [name="status"]', 'blocked');
    const go = await holdAll(page, /gauges-in-use$/);
    await page.click('.listed .quiet >> text=C-1');
    assert.equal(await page.$('.of-gauge form'), null);
    go();
    await page.waitForFunction(() => /C-1/.test(document.querySelector('.of-gauge h2')?.textContent));
    assert.deepEqual(await typed(), ['', '', 'in_use']);
    await page.fill('.of-gauge [name="due"]', '2099-06-30');
    await page.selectOption('.of-gauge [name="status"]', 'blocked');
    const record = await holdAll(page, '**/C-1/calibrations');
    await page.dblclick('.of-gauge .primary');
    record();
    await recorded();
    assert.deepEqual(await typed(), ['', '', 'in_use']);
    const stored = async (name) => (await daemon.json(`/v1/gauges-in-use/${name}/calibrations`)).calibrations.map(({ due, status }) => [due, status]);
    assert.deepEqual([await stored('C-1'), await stored('C-2')], [[['2099-06-30', 'blocked']], []]);
    await page.click('.add-gauge summary');
    await page.fill('[name="gauge"]', 'C-2');
    await page.fill('[name="calibration_due"]', '2098-01-31');
    await page.click('.add-gauge .primary');
    await page.waitForFunction(() => /C-2/.test(document.querySelector('.of-gauge h2')?.textContent));
    assert.deepEqual(await daemon.json('/v1/gauges-in-use/C-2'), { uncertainty: 'bore-gauge', calibration_due: '2098-01-31' });
    await close(page);
  });

  it('has a study whose verdict is of the readings beside it, and which replaces none unasked', async () => {
    const study = { gauge: 'G-07', at: '2026-01-01', kind: 'type1', input: { reference: 25, tolerance: 0.021, values: [25, 25.001, 25.0005, 25.0002, 25.0001, 25, 25, 25.001, 25.0003, 25] } };
    await daemon.send('PUT', '/v1/studies/Q3', study);
    const page = await open(browser, daemon, '#/gauges');
    await page.selectOption('.study [name="kind"]', 'type1');
    for (const [name, value] of [['tolerance', '0.021'], ['reference', '25'], ['values', '25.001 25.002 25.001 25.002 25.001 25.002 25.001 25.002 25.001 25.002']]) await page.fill(`.study [name="${name}"]`, value);
    const compute = async () => {
      await page.click('.study .primary');
      await page.waitForSelector('.study-verdict');
    };
    await compute();
    await page.fill('.study [name="reference"]', '25.001');
    assert.equal(await page.$('.study-verdict'), null);
    await page.selectOption('.study [name="kind"]', 'grr');
    await page.fill('[name="parts"]', '2');
    await page.fill('[name="operators"]', 'Kim, Jo');
    await page.fill('[name="trials"]', '2');
    for (const [i, value] of ['25.01', '25.02', '25.011', '25.021', '25.012', '25.022', '25.01', '25.02'].entries()) await page.fill(`.study-grid td >> nth=${i} >> input`, value);
    await compute();
    await page.fill('.study-grid td input >> nth=0', '25.013');
    assert.equal(await page.$('.study-verdict'), null);
    await page.fill('[name="study-name"]', 'Q3');
    await page.fill('[name="study-gauge"]', 'G-07');
    await page.click('.stored-studies [type="submit"]');
    await page.waitForFunction(() => /Q3 already exists/.test(document.querySelector('.stored-studies .note').textContent));
    assert.equal((await daemon.json('/v1/studies/Q3')).kind, 'type1');
    await page.click('.stored-studies .note >> text=Store my version anyway');
    await page.waitForFunction(() => /Q3 is stored/.test(document.querySelector('.stored-studies [role="status"]').textContent));
    assert.equal((await daemon.json('/v1/studies/Q3')).kind, 'grr');
    await close(page);
  });

  it('is studied with what the station has recorded, and a reload keeps the readings', async () => {
    const page = await open(browser, daemon, '#/gauges', { viewport: { width: 1366, height: 768 } });
    await page.waitForFunction(() => document.querySelector('.study [name="characteristic"]').options.length > 1);
    await page.selectOption('.study [name="characteristic"]', 'study-G-07');
    await page.waitForFunction(() => document.querySelector('.study-grid tbody th').textContent === 'P1');
    assert.equal(await page.$$eval('.study-grid tbody input', (all) => all.length), 90);
    assert.equal(await page.inputValue('[name="tolerance"]'), '0.021');
    await page.reload();
    await page.waitForFunction(() => document.querySelector('.study-grid tbody th')?.textContent === 'P1');
    assert.equal(await page.$$eval('.study-grid tbody input', (all) => all.length), 90);
    await page.click('.study .primary');
    await page.waitForSelector('.study-verdict');
    const study = await (await daemon.send('POST', '/v1/statistics/grr', { tolerance: 0.021, measurements: ROUNDS.flatMap(([operator, trial]) => Array.from({ length: PARTS }, (_, part) => (
      { part: `P${part + 1}`, operator: OPERATORS[operator], trial, value: readingOf(part, operator, trial) }))) })).json();
    assert.match(await page.textContent('.study-verdict'), new RegExp(`uses ${study.tolerance_percent.grr.toFixed(1)} % of the tolerance.*${study.ndc} categories`));
    assert.match(await page.textContent('.study-result tbody'), new RegExp(`Repeatability${(study.ev * 1000).toFixed(2)}`));
    const pictures = await page.$$eval('.study-figures figure', (all) => all.map((figure) => [figure.querySelector('figcaption').textContent, figure.querySelectorAll('.reading').length, figure.querySelectorAll('svg.framed .mark').length]));
    assert.deepEqual(pictures, [['Components of variation', 0, 0], ['Averages by operator and part, mm', 0, 3 * PARTS], ['Ranges by operator and part, mm', 0, 3 * PARTS], ['Readings by part, mm', 90, PARTS], ['Readings by operator, mm', 90, 3], ['Means by part and operator, mm', 0, 3 * PARTS]]);
    // AIAG's limits by hand, for three trials: A2 = 1.023, D4 = 2.574, D3 = 0.
    const cells = OPERATORS.flatMap((_, operator) => Array.from({ length: PARTS }, (__, part) => [0, 1, 2].map((trial) => Number(readingOf(part, operator, trial)))));
    const means = cells.map((values) => values.reduce((sum, value) => sum + value) / 3);
    const ranges = cells.map((values) => Math.max(...values) - Math.min(...values));
    const [mean, range] = [means, ranges].map((all) => all.reduce((sum, value) => sum + value) / all.length);
    const said = await page.$$eval('.study-figures figure p.hint', (all) => all.map((one) => one.textContent));
    const limits = said.map((text) => /Limits ([\d.]+) to ([\d.]+) mm/.exec(text).slice(1).map(Number));
    const near = (found, wanted) => assert.ok(Math.abs(found - wanted) < 1e-4, `${found}, not ${wanted}`);
    [mean - 1.023 * range, mean + 1.023 * range, 0, 2.574 * range].forEach((wanted, i) => near(limits.flat()[i], wanted));
    const out = means.filter((value) => Math.abs(value - mean) > 1.023 * range).length;
    assert.match(said[0], new RegExp(`^${out} of 30 averages are beyond`));
    assert.match(said[1], /^Every range is within/);
    assert.deepEqual(await page.$$eval('.study-figures figure:nth-child(2) svg text[text-anchor="middle"]', (all) => all.map((text) => text.textContent)), OPERATORS);
    assert.match(await page.textContent('.study-figures figure:nth-child(2) .mark title'), new RegExp(`Kim · P1: ${means[0].toFixed(4)} mm`));
    assert.deepEqual(await findings(page), []);
    await page.$eval('.study-verdict', (verdict) => verdict.scrollIntoView());
    await picture(page, 'study');
    for (const width of [390, 3840]) {
      await page.setViewportSize({ width, height: 844 });
      await drawn(page);
      assert.ok(await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth), `${width}`);
      const least = await page.$$eval('.framed text', (texts) => Math.min(...texts.map((text) => parseFloat(getComputedStyle(text).fontSize) * text.ownerSVGElement.getScreenCTM().a)));
      assert.ok(least >= 12, `${width}: ${least}`);
    }
    if (browserName === 'chromium') await page.emulateMedia({ forcedColors: 'active', colorScheme: 'dark' });
    await picture(page, 'study-forced-colours');
    await close(page);
  });

  it('is studied with the records of parts whose numbers have commas, or of one that is a figure', async () => {
    const record = (characteristic, part_id, operator, i) => ({ designation: '25 H7', measured_mm: `25.01${i}`, part_id, operator, characteristic });
    await daemon.send('POST', '/v1/measurements', ['C,1', 'C,2'].flatMap((part) => ['Kim', 'Lee, J.'].flatMap((operator) => [0, 1].map((i) => record('study-commas', part, operator, i)))));
    await daemon.send('POST', '/v1/measurements', [0, 1].map((i) => record('study-17', '17', 'Kim', i)));
    const page = await open(browser, daemon, '#/gauges');
    await page.waitForSelector('.study option[value="study-17"]', { state: 'attached' });
    for (const [characteristic, parts] of [['study-commas', ['C,1', 'C,2']], ['study-17', ['17']]]) {
      await page.selectOption('.study [name="characteristic"]', characteristic);
      await page.waitForFunction((wanted) => [...document.querySelectorAll('.study-grid tbody th')].map(({ textContent }) => textContent).join(';') === wanted, parts.join(';'));
      assert.ok((await page.$$eval('.study-grid tbody input', (all) => all.map(({ value }) => value))).every((value) => /^25\.01\d?$/.test(value)), 'each place has its value');
    }
    await close(page);
  });

  it('is studied with the newest records of a time, without those set aside, and says that there are more', async () => {
    const content = { designation: '25 H7', measured_mm: '25.01', operator: 'Kim', characteristic: 'study-many' };
    await daemon.send('POST', '/v1/measurements', Array.from({ length: 1001 }, (_, i) => (
      { ...content, measured_mm: i > 800 ? '25.01' : '25.02', part_id: i ? `Q${1 + i % 10}` : 'OLD', measured_at: i < 10 ? '2026-03-01T12:00:00Z' : '2026-03-03T12:00:00Z' })));
    const { id } = await (await daemon.send('POST', '/v1/measurements', { ...content, part_id: 'ASIDE' })).json();
    await daemon.send('POST', `/v1/measurements/${id}/notes`, { cause: 'Slipped', measure: 'set aside' });
    const page = await open(browser, daemon, '#/gauges');
    await page.waitForSelector('.study option[value="study-many"]', { state: 'attached' });
    await page.selectOption('.study [name="characteristic"]', 'study-many');
    await page.waitForFunction(() => /the newest 200 readings that fit into a study; there are more/.test(document.querySelector('.study [role="status"]').textContent));
    const parts = async () => (await page.inputValue('[name="parts"]')).split(', ').sort();
    assert.deepEqual(await parts(), ['Q1', 'Q10', 'Q2', 'Q3', 'Q4', 'Q5', 'Q6', 'Q7', 'Q8', 'Q9']);
    assert.deepEqual(await page.$$eval('.study-grid tbody input', (all) => [all.length, ...new Set(all.map(({ value }) => value))]), [200, '25.01']); // 20 trials of each, the newest
    await page.fill('[name="records-to"]', '2026-03-01');
    await page.selectOption('.study [name="characteristic"]', 'study-many');
    await page.waitForFunction(() => /^OLD/.test(document.querySelector('[name="parts"]').value));
    assert.deepEqual(await parts(), ['OLD', 'Q10', 'Q2', 'Q3', 'Q4', 'Q5', 'Q6', 'Q7', 'Q8', 'Q9']);
    assert.equal(await page.textContent('.study [role="status"]'), '');
    await close(page);
  });

  it('is dated today as the day is here, and so is a calibration', { skip: !hasZones }, async () => {
    await daemon.send('PUT', '/v1/gauges-in-use/G-NIGHT', { calibration_due: '2099-03-31' });
    const page = await open(browser, daemon, '#/gauges/G-NIGHT', { at: '2026-03-31T22:30:00Z', timezoneId: 'Europe/Berlin' });
    await page.waitForSelector('.of-gauge [name="from"]');
    assert.deepEqual([await page.inputValue('[name="study-at"]'), await page.inputValue('.of-gauge [name="from"]')], ['2026-04-01', '2026-04-01']);
    assert.match(await page.textContent('.gauges-in-use .listed tbody'), /G-NIGHT31 Mar 2099/); // due on that day, east and west
    await daemon.send('POST', '/v1/gauges-in-use/G-NIGHT/calibrations', { from: '2026-01-31', due: '2099-05-31' });
    await daemon.send('PUT', '/v1/studies/night', { gauge: 'G-NIGHT', at: '2026-02-28', kind: 'type1', input: { values: [25.001, 25.002, 25.003], reference: 25.002, tolerance: 0.021 } });
    await close(page);
    const west = await open(browser, daemon, '#/gauges/G-NIGHT', { at: '2026-03-31T22:30:00Z', timezoneId: 'America/New_York' });
    await west.waitForSelector('.of-gauge tbody tr');
    assert.match(await west.textContent('.of-gauge tbody'), /31 Jan 202631 May 2099/);
    await west.waitForSelector('.stored-studies tbody tr');
    assert.match(await west.textContent('.stored-studies tbody'), /nightG-NIGHT.*28 Feb 2026/);
    await close(west);
  });

  it('keeps its time where it is stored again, and is not shown or stored in part', async () => {
    const at = '2026-03-30T14:05:00Z';
    const readings = (parts, trials) => Array.from({ length: parts * trials * 2 }, (_, i) => (
      { part: `P${i % parts}`, operator: i < parts * trials ? 'Kim' : 'Jo', trial: String(1 + Math.floor(i / parts) % trials), value: 25 + (i * 7 % 11) / 1000 + (i % parts) / 100 }));
    const study = (parts, trials) => ({ gauge: 'G-1', at, kind: 'grr', input: { measurements: readings(parts, trials) } });
    for (const name of ['G-1', 'G-2']) await daemon.send('PUT', `/v1/gauges-in-use/${name}`, { calibration_due: '2099-03-31' });
    for (const [name, parts, trials] of [['timed', 3, 2], ['many parts', 101, 2], ['many trials', 2, 21]]) await daemon.send('PUT', `/v1/studies/${name}`, study(parts, trials));
    const page = await open(browser, daemon, '#/gauges');
    const opened = async (name) => {
      await page.click(`.stored-studies .quiet >> text="${name}"`);
      await page.waitForFunction((wanted) => document.querySelector('[name="study-name"]').value === wanted, name);
    };
    await opened('timed');
    await page.waitForSelector('.study-result table');
    await page.fill('[name="study-gauge"]', 'G-2');
    await page.click('.stored-studies [type="submit"]');
    await page.waitForFunction(() => /timed is stored/.test(document.querySelector('.stored-studies [role="status"]').textContent));
    const { gauge, at: stored } = await daemon.json('/v1/studies/timed');
    assert.deepEqual([gauge, stored], ['G-2', at]);
    for (const name of ['many parts', 'many trials']) {
      await opened(name);
      await page.waitForFunction(() => /at most 100 parts, 20 operators and 20 trials/.test(document.querySelector('.study form .note').textContent));
      assert.equal(await page.$('.study-result table'), null);
      await page.click('.stored-studies [type="submit"]');
      await page.waitForFunction(() => /at most 100 parts/.test(document.querySelector('.stored-studies .note').textContent));
      assert.deepEqual((await daemon.json(`/v1/studies/${name}`)).input.measurements.length, readings(name === 'many parts' ? 101 : 2, name === 'many parts' ? 2 : 21).length);
    }
    await close(page);
  });

  it('is studied in a grid that Enter goes down, which says what is missing or no value', async () => {
    const page = await open(browser, daemon, '#/gauges');
    await page.fill('[name="parts"]', '2');
    await page.fill('[name="operators"]', 'Kim, Jo');
    await page.fill('[name="trials"]', '2');
    await page.fill('[name="tolerance"]', '25 H7');
    await page.focus('.study-grid tbody input');
    for (const value of ['25.0101', '25.0151', '25,0102', '01A+00025.0150', '25.0102', '25.0151', 'x']) await page.keyboard.type(`${value}\n`);
    await page.click('.study .primary');
    await page.waitForFunction(() => /“x” is not a value/.test(document.querySelector('.study .note').textContent));
    await page.fill('.study-grid tbody tr:first-child td:last-child input', '25.0102');
    await page.click('.study .primary'); // a trial of the second part is missing
    await page.waitForSelector('.study-verdict');
    assert.equal(await page.$$eval('.study-figures figure:nth-child(2) .reading', (all) => all.length), 7);
    assert.equal(await page.$('.study-result .tiles'), null);
    assert.match(await page.textContent('.study-result'), /need two trials or more, equally many/);
    await page.route('**/v1/statistics/chart', (route) => route.abort());
    await page.fill('.study-grid tbody tr:last-child td:last-child input', '25.0151');
    await page.click('.study .primary');
    await page.waitForFunction(() => /^The charts of averages and ranges are missing: ./.test(document.querySelector('.study .note').textContent));
    assert.equal(await page.$$eval('.study-figures figure:nth-child(2) .reading', (all) => all.length), 8);
    assert.doesNotMatch(await page.textContent('.study-result'), /need two trials or more/);
    await page.unroute('**/v1/statistics/chart');
    await page.fill('.study-grid tbody tr:last-child td:last-child input', '');
    await page.click('.study details summary');
    for (const [name, value] of [['resolution', '0.0002'], ['u_cal', '0,0001'], ['u_bi', '0.0001'], ['u_evr', '0.0001']]) await page.fill(`[name="${name}"]`, value);
    await page.click('.study .primary');
    await page.waitForSelector('.study-result .tiles');
    await page.fill('[name="study-name"]', 'G-08 of March');
    await page.fill('[name="study-gauge"]', 'G-08');
    await page.fill('[name="study-at"]', '2026-03-31');
    await page.click('.stored-studies [type="submit"]');
    await page.waitForFunction(() => /G-08 of March is stored/.test(document.querySelector('.stored-studies [role="status"]').textContent));
    const { gauge, at, kind, input, result } = await daemon.json('/v1/studies/G-08 of March');
    assert.deepEqual([gauge, at, kind, input.measurements.length, input.measuring_process.u_cal], ['G-08', '2026-03-31', 'grr', 7, 0.0001]);
    const { ev } = result.intervals;
    assert.match(await page.textContent('.study-result tbody .ev'), new RegExp(`${(ev.lower * 1000).toFixed(2)} – ${(ev.upper * 1000).toFixed(2)}`));
    const { re_percent, q_ms_percent, q_mp_percent } = result.measuring_process;
    for (const figure of [re_percent, q_ms_percent, q_mp_percent]) assert.match(await page.textContent('.study-result .tiles'), new RegExp(`${figure.toFixed(1)} %`));
    assert.deepEqual(await findings(page), []);
    await picture(page, 'study-stored', { fullPage: true });
    await page.click('.study .actions button:last-child');
    assert.equal(await page.inputValue('.study-grid tbody input'), '');
    await page.click('.stored-studies .quiet >> text=G-08 of March');
    await page.waitForSelector('.study-result .tiles');
    assert.match(await page.textContent('.stored-studies tbody'), /G-08.*Repeatability.*31 Mar 2026/);
    assert.equal(await page.inputValue('.study-grid tbody input'), '25.0101');
    assert.equal(await page.inputValue('.study-grid tbody tr:last-child td:last-child input'), '');
    await page.fill('[name="study-gauge"]', 'G-99');
    await page.click('.stored-studies [type="submit"]');
    await page.waitForFunction(() => document.querySelector('.stored-studies .note').textContent !== '');
    await page.selectOption('.study [name="kind"]', 'type1');
    await page.fill('[name="reference"]', '25,0104');
    await page.fill('[name="values"]', ['25.0104', '25.0106', '25.0102', '25.0104', '25.0106', '25.0102', '25.0104'].join('\n'));
    await page.click('.study .primary');
    await page.waitForFunction(() => /Cg \d+\.\d\d, Cgk/.test(document.querySelector('.study-verdict')?.textContent));
    assert.equal(await page.$$eval('.framed .mark', (all) => all.length), 7);
    await picture(page, 'study-master', { fullPage: true });
    await close(page);
  });
});
