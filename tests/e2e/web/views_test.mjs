/** Fit, trend, programs and tables. */

import assert from 'node:assert/strict';
import fs from 'node:fs';
import { after, afterEach, before, describe, it } from 'node:test';

import { close, launch, open, openIn, picture } from './support/browser.mjs';
import { Daemon, sleep } from './support/daemon.mjs';
import { Gate } from './support/gate.mjs';

const EXAMPLE = 'clients/nc/8255';
const PROGRAM = 'nc_prog/8255/8255.h';
const LOGGING = `BEGIN PGM LOG MM
TOOL CALL 30 Z
TCH PROBE 444 PROBING IN 3-D ~
    Q263=+50 ~
    Q264=+40 ~
    Q294=+0 ~
    Q581=+0 ~
    Q582=+0 ~
    Q583=+1 ~
    Q320=+0 ~
    Q260=+50 ~
    QS400="0.1-0.1" ~
    Q309=+0
END PGM LOG MM
`;
const PLATE = { workpiece: { features: [{ type: 'block', min_mm: [0, 0, -40], max_mm: [100, 80, 0.02] }] } };

let browser;
let daemon;
let page;

before(async () => {
  browser = await launch();
  daemon = await new Daemon().start();
});
after(async () => {
  await browser.close();
  await daemon.cleanup();
});
afterEach(() => close(page));

const hash = () => decodeURIComponent(new URL(page.url()).hash);

describe('the fit', () => {
  it('shows the zones, the clearances and a measured pair, and the URL is the state', async () => {
    page = await open(browser, daemon, '#/fit/25H7/g6?hole=25.013&shaft=24,985');
    await page.waitForSelector('.limits .mark-of');
    assert.equal(await page.textContent('.fit .headline'), 'Clearance fit');
    assert.deepEqual(await page.$$eval('.zones .um', (texts) => texts.map((text) => text.textContent)), ['+21', '0', '−7', '−20']);
    assert.deepEqual(await page.$$eval('.fit dd', (values) => values.map((value) => value.textContent)), ['41 µm', '7 µm', '11.7 … 36.3 µm', '28 µm']);
    assert.equal((await page.$$('.zones .measured')).length, 2);
    await page.click('.preferred button:has-text("H7/s6")');
    await page.waitForFunction(() => document.querySelector('.fit .headline')?.textContent === 'Interference fit');
    assert.equal(hash(), '#/fit/25H7/s6?hole=25.013&shaft=24,985');
    await page.goBack();
    await page.waitForFunction(() => document.querySelector('.fit .headline')?.textContent === 'Clearance fit');
  });

  it('is found by the clearance it must have, and copied for a drawing', async () => {
    page = await open(browser, daemon, '#/fit/25H7/k6', { permissions: ['clipboard-read', 'clipboard-write'] });
    await page.waitForSelector('.limits');
    await page.fill('#find-least', '5');
    await page.fill('#find-greatest', '45');
    await page.click('.finder button[type="submit"]');
    // ISO 286-2: of 25 mm, H7 is 0 to +21 and g6 -20 to -7, so their clearance is 7 to 41.
    await page.waitForFunction(() => /^H7\/g6\+7 … \+41 µm/.test([...document.querySelectorAll('.found li')].find((item) => /^H7\/g6/.test(item.textContent))?.textContent ?? ''));
    await page.click('.found button:text-is("H7/g6")');
    await page.waitForFunction(() => document.querySelector('.headline').textContent === 'Clearance fit');
    assert.match(hash(), /25H7\/g6/);
    // Tolerances 21 and 13 about a mean of 24: their root of squares is 24.7.
    assert.match(await page.textContent('.result dl'), /Probable, 99.73 %11\.7 … 36\.3 µm/);
    for (const [feature, text] of [['H7', '⌀25 H7 (+0.021/0)'], ['g6', '⌀25 g6 (-0.007/-0.020)']]) {
      await page.click(`.limits button[aria-label="Copy 25 ${feature} for a drawing"]`);
      await page.waitForFunction((wanted) => document.querySelector('.side .note').textContent === `${wanted} is copied.`, text);
      assert.equal(await page.evaluate(() => navigator.clipboard.readText()), text);
    }
    await page.fill('#find-greatest', 'wide');
    await page.click('.finder button[type="submit"]');
    await page.waitForFunction(() => /Type two numbers/.test(document.querySelector('.found-note').textContent));
    await picture(page, 'fit-found', { fullPage: true });
  });

  it('draws a zone where the deviations say, to scale', async () => {
    page = await open(browser, daemon, '#/fit/25H7/k6');
    await page.waitForSelector('.zones .shaft rect');
    const [hole, shaft, zero] = await page.$$eval('.zones .hole rect, .zones .shaft rect, .zones .zero',
      (shapes) => shapes.map((shape) => shape.getBBox()).map(({ y, height }) => ({ y, height })));
    assert.ok(Math.abs(hole.y + hole.height - zero.y) < 0.2); // H begins at zero
    assert.ok(Math.abs(shaft.height / hole.height - 13 / 21) < 0.01);
    assert.ok(Math.abs((zero.y - shaft.y - shaft.height) / hole.height - 2 / 21) < 0.01);
  });

  it('offers every class of the size, also by the arrow keys', async () => {
    page = await open(browser, daemon, '#/fit/25H7/g6');
    await page.waitForSelector('.class-zones :checked');
    await page.focus('.class-map:nth-child(2) input:checked');
    await page.keyboard.press('ArrowRight');
    await page.waitForFunction(() => decodeURIComponent(location.hash) === '#/fit/25H7/h6');
    await page.waitForFunction(() => document.activeElement.value === 'h6');
    await page.fill('#fit', '132,5 P7/h6');
    await page.press('#fit', 'Enter');
    await page.waitForFunction(() => document.querySelector('.fit .headline')?.textContent === 'Interference fit');
    assert.equal(hash(), '#/fit/132.5P7/h6');
    await page.fill('#fit', '25 H7');
    await page.press('#fit', 'Enter');
    assert.notEqual(await page.textContent('.fit .note'), '');
  });
});

describe('answers that come late', () => {
  it('never overwrite a newer one, nor the next view', async () => {
    page = await open(browser, daemon, '#/fit/25H7/g6');
    await page.waitForSelector('.fit .headline');
    await page.route('**/v1/fits/25H7/s6', async (route) => {
      await new Promise((resolve) => setTimeout(resolve, 1200));
      await route.continue().catch(() => {});
    });
    await page.click('.preferred button:has-text("H7/s6")');
    await page.click('.preferred button:has-text("H7/h6")');
    await page.waitForFunction(() => decodeURIComponent(location.hash).startsWith('#/fit/25H7/h6'));
    await page.waitForTimeout(1500);
    assert.equal(await page.textContent('.fit .headline'), 'Clearance fit');
    await page.fill('#fit', 'nonsense');
    await page.press('#fit', 'Enter');
    assert.equal(await page.$('.fit .headline'), null);

    await page.route('**/v1/measurements?**', async (route) => {
      await new Promise((resolve) => setTimeout(resolve, 800));
      await route.continue().catch(() => {});
    });
    await page.goto(`${daemon.url}/#/trend`);
    await page.goto(`${daemon.url}/#/gauge/25H7`);
    await page.waitForSelector('.entry');
    await page.waitForTimeout(1200);
    assert.ok(hash().startsWith('#/gauge/25H7'), hash());
  });
});

describe('the trend', () => {
  let gate;
  before(async () => { gate = await new Gate(daemon).open(); });
  after(() => gate.close());
  const untilStreams = async (count) => {
    for (let i = 0; i < 100 && gate.streams !== count; ++i) await sleep(50);
    assert.equal(gate.streams, count);
  };

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
    await page.waitForFunction(() => document.querySelectorAll('.point').length === 1);
  });

  it('shares one stream among all tabs of a browser: eight of them load and go on', async () => {
    page = await open(browser, gate, '#/trend?designation=32 H7');
    await untilStreams(1);
    const tabs = [];
    for (let i = 0; i < 7; ++i) tabs.push(await openIn(page.context(), gate, '#/trend?designation=32 H7'));
    for (const tab of tabs) await tab.waitForSelector('.trend .empty');
    await untilStreams(1);
    await daemon.send('POST', '/v1/measurements', { designation: '32 H7', measured_mm: '32.002' });
    for (const tab of [page, ...tabs]) await tab.waitForFunction(() => document.querySelectorAll('.point').length === 1);
    for (const tab of tabs) await tab.close();
    await untilStreams(1);
  });

  it('asks once for the newest, however much older there is', async () => {
    const old = Array.from({ length: 3000 }, (_, i) => ({ designation: '33 H7', measured_mm: '33.01', characteristic: 'old', measured_at: `2026-01-0${1 + i % 9}T08:00:00Z` }));
    await daemon.send('POST', '/v1/measurements', old);
    await daemon.send('POST', '/v1/measurements', ['33.001', '33.002'].map((measured_mm) => ({ designation: '33 H7', measured_mm, characteristic: 'old' })));
    const asked = [];
    page = await open(browser, daemon, '');
    page.on('request', (request) => request.url().includes('/v1/measurements?') && asked.push(request.url()));
    await page.goto(`${daemon.url}/#/trend?characteristic=old&count=50`);
    await page.waitForFunction(() => document.querySelectorAll('.point').length === 50);
    assert.equal(asked.length, 1);
    assert.match(await page.textContent('.trend tbody tr'), /33\.002 mm/);
  });

  it('shows the last values and those that come', async () => {
    const values = Array.from({ length: 30 }, (_, i) => (25.001 + i / 1000).toFixed(3));
    await daemon.send('POST', '/v1/measurements', values.map((text) => ({ designation: '25 H7', measured_mm: text, characteristic: 'bore-A' })));
    await daemon.send('POST', '/v1/measurements', { designation: '10 f7', measured_mm: '9.98' });
    page = await open(browser, daemon, '#/trend?characteristic=bore-A&count=50');
    await page.waitForFunction(() => document.querySelectorAll('.point').length === 30);
    const counts = () => page.$$eval('.tiles dd', (tiles) => tiles.slice(0, 3).map((tile) => Number(tile.textContent)));
    assert.deepEqual(await counts(), [21, 0, 9]);
    await daemon.send('POST', '/v1/measurements', [
      { designation: '25 H7', measured_mm: '24.999', characteristic: 'bore-A' },
      { designation: '25 H7', measured_mm: '24.998', characteristic: 'bore-B' }]);
    await page.waitForFunction(() => document.querySelectorAll('.point').length === 31);
    assert.deepEqual(await counts(), [21, 1, 9]);
    const [corrected] = (await daemon.json('/v1/measurements?characteristic=bore-A&verdict=rework')).measurements;
    await daemon.send('POST', `/v1/measurements/${corrected.id}/corrections`, { measured_mm: '25.01', reason: 'test' });
    await page.waitForFunction(() => document.querySelector('.tiles dd').textContent === '22');
    assert.deepEqual(await counts(), [22, 0, 9]);
    await picture(page, 'trend', { fullPage: true });
  });

  it('is a control chart: limits, broken rules by number, indices that are grey while they mean nothing', async () => {
    // Montgomery, Introduction to Statistical Quality Control, the individuals of example 6.5 (viscosity of
    // primer paint), as micrometres above 33 mm; the book has centre 33.52, MR 0.48, limits 34.80 and 32.24.
    const viscosity = [33.75, 33.05, 34.00, 33.81, 33.46, 34.02, 33.68, 33.27, 33.49, 33.20, 33.62, 33.00, 33.54, 33.12, 33.84];
    await daemon.send('POST', '/v1/measurements', viscosity.map((value, i) => ({
      nominal_mm: 33, feature: 'hole', upper_um: 36, lower_um: 31, measured_mm: (33 + value / 1000).toFixed(5), characteristic: 'paint', part_id: `P-${i + 1}`,
    })));
    page = await open(browser, daemon, '#/trend?characteristic=paint');
    await page.waitForFunction(() => document.querySelectorAll('.point').length === 15);
    const texts = () => page.$$eval('.control-chart text', (all) => all.map((text) => text.textContent));
    for (const label of ['33.52', '34.8', '32.24', '0.48']) assert.ok((await texts()).some((text) => Math.abs(Number(text) - Number(label)) < 0.011), `${label} in ${await texts()}`);
    assert.equal(await page.$('.control-chart .broken'), null);
    assert.match(await page.textContent('.stability.doubt'), /n = 15/);
    await page.click('.rules button');
    await page.waitForFunction(() => /centre=33\.5/.test(location.hash));
    await daemon.send('POST', '/v1/measurements', { nominal_mm: 33, feature: 'hole', upper_um: 36, lower_um: 31, measured_mm: '33.0358', characteristic: 'paint', part_id: 'P-16' });
    await page.waitForSelector('.control-chart .broken');
    assert.match(await page.textContent('.stability.doubt'), /Not stable: rule 1 at P-16/);
    assert.ok((await texts()).some((text) => Math.abs(Number(text) - 33.52) < 0.011), 'frozen limits stay');
    assert.ok(await page.$('.tiles.in-doubt'));
    await page.focus('.trend figure');
    await page.keyboard.press('ArrowLeft');
    assert.match(await page.textContent('.detail'), /P-16.*breaks rule 1/);
    await page.uncheck('.rules input[value="1"]');
    await page.waitForFunction(() => !document.querySelector('.control-chart .broken'));
    await picture(page, 'trend-control', { fullPage: true });
  });

  it('charts the means of subgroups, and leaves out one that is still being measured', async () => {
    // Piston rings (Montgomery), 25 samples of five, as R's qcc has them: means 74.001176 between 73.98805 and
    // 74.01431, ranges 0.02276 below 0.04812; with s 0.00924 below 0.0193.
    const samples = fs.readFileSync('tests/reference/piston_rings.txt', 'utf8').trim().split('\n').slice(0, 25).map((line) => line.trim().split(/\s+/));
    const ring = (measured_mm, subgroup) => ({ nominal_mm: 74, feature: 'hole', upper_um: 50, lower_um: -50, measured_mm, characteristic: 'ring', subgroup });
    await daemon.send('POST', '/v1/measurements', [...samples.flatMap((sample, i) => sample.map((value) => ring(value, `S-${i + 1}`))), ring('74.001', 'S-26')]);
    page = await open(browser, daemon, '#/trend?characteristic=ring&count=200');
    await page.waitForFunction(() => document.querySelectorAll('.point').length === 126);
    const near = (label) => page.waitForFunction((wanted) => [...document.querySelectorAll('.control-chart text')]
      .some((text) => Math.abs(Number(text.textContent.replace('−', '-')) - wanted) < 0.06), label);
    await page.selectOption('#trend-kind', 'xbar_r');
    await page.waitForFunction(() => document.querySelectorAll('.point').length === 25);
    for (const label of [1.18, 14.31, -11.95, 22.76, 48.12]) await near(label);
    assert.match(await page.textContent('.detail'), /1 values of incomplete subgroups/);
    assert.ok(await page.$('.ranges .unit:text("R")'));
    await page.focus('.trend figure');
    await page.keyboard.press('ArrowLeft');
    await page.waitForFunction(() => /S-25.*74\.013/.test(document.querySelector('.detail').textContent));
    await picture(page, 'trend-means', { fullPage: true });
    await page.selectOption('#trend-kind', 'xbar_s');
    for (const label of [1.18, 14.36, -12.01, 9.24, 19.3]) await near(label);
    assert.match(hash(), /kind=xbar_s/);
    await daemon.send('POST', '/v1/measurements', ['74.002', '74.003', '74.001', '74.0'].map((value) => ring(value, 'S-26')));
    await page.waitForFunction(() => document.querySelectorAll('.point').length === 26);
    await close(page);
    page = await open(browser, daemon, '#/trend?characteristic=ring&count=200&kind=xbar_s');
    await page.waitForFunction(() => document.querySelectorAll('.point').length === 26);
  });
});

describe('the overview', () => {
  it('shows every characteristic of a machine or a plan, the worst first, as the values come in', async () => {
    const values = (characteristic, middle, spread, count = 40) => Array.from({ length: count }, (_, i) => ({
      designation: '25 H7', measured_mm: (middle + spread * Math.sin(i * 2.4)).toFixed(4), characteristic, machine: 'OV-1' }));
    await daemon.send('POST', '/v1/measurements', [...values('ov-fine', 25.0105, 0.002), ...values('ov-edge', 25.019, 0.003), ...values('ov-few', 25.01, 0.001, 5)]);
    await daemon.send('PUT', '/v1/plans/OV-PLAN', { characteristics: ['ov-fine', 'ov-new'].map((name) => ({ name, designation: '25 H7' })) });
    page = await open(browser, daemon, '#/overview?machine=OV-1');
    const order = (names) => page.waitForFunction((wanted) => [...document.querySelectorAll('.overview tbody th')].map((cell) => cell.textContent).join() === wanted, names.join());
    await order(['ov-edge', 'ov-fine', 'ov-few']);
    const { ppk } = await daemon.json('/v1/measurements/capability?characteristic=ov-edge&machine=OV-1');
    assert.match(await page.textContent('.overview tbody tr'), new RegExp(`^ov-edge40[^]*${ppk.value.toFixed(2)}`.replace('.', '\\.')));
    assert.ok(await page.$('.overview tbody tr:last-child .index.in-doubt'), 'five values are no index');
    await picture(page, 'overview', { fullPage: true });
    await daemon.send('POST', '/v1/measurements', Array.from({ length: 5 }, () => ({ designation: '25 H7', measured_mm: '25.09', characteristic: 'ov-fine', machine: 'OV-1' })));
    await page.waitForFunction(() => /ov-fine45/.test(document.querySelector('.overview tbody tr').textContent));
    assert.match(await page.textContent('.overview tbody tr'), /Not stable/);
    await page.selectOption('#overview-plan', 'OV-PLAN');
    await order(['ov-fine', 'ov-new']);
    assert.match(await page.textContent('.overview tbody tr:last-child'), /No values yet/);
    await page.click('.overview tbody a');
    await page.waitForFunction(() => document.querySelectorAll('.point').length === 45);
    assert.match(hash(), /^#\/trend\?characteristic=ov-fine/);
  });
});

describe('the parts', () => {
  it('answer show me part SN-17: every characteristic with its corrections, and a certificate', async () => {
    const record = await (await daemon.send('POST', '/v1/measurements', { designation: '25 H7', measured_mm: '25.05', part_id: 'SN-17', characteristic: 'bore-A', order: 'WO-9', gauge: 'G-07', uncertainty_um: '0.8' })).json();
    await daemon.send('POST', '/v1/measurements', Array.from({ length: 70 }, (_, i) => ({ designation: '25 H7', measured_mm: '25.01', part_id: `SN-1${i}x`, order: 'WO-9' })));
    await daemon.send('POST', `/v1/measurements/${record.id}/corrections`, { measured_mm: '25.005', reason: 'slipped' });
    await daemon.send('POST', '/v1/measurements', { nominal_mm: 8, feature: 'hole', upper_um: 36, lower_um: 0, measured_mm: '8.05', part_id: 'SN-17', characteristic: 'slot', order: 'WO-9' });
    page = await open(browser, daemon, '#/parts?order=WO-9');
    await page.waitForFunction(() => document.querySelectorAll('.records tbody tr').length === 50);
    await page.click('.parts button:has-text("Show more")');
    await page.waitForFunction(() => document.querySelectorAll('.records tbody tr').length === 72);
    assert.match(await page.textContent('.records tbody tr'), /SN-17slot/); // the newest first
    await page.click('.records a:has-text("SN-17")');
    await page.waitForFunction(() => document.querySelectorAll('.records tbody tr').length === 3);
    assert.equal(hash(), '#/parts?part_id=SN-17&history=all');
    const history = await page.$$eval('.records tbody tr', (all) => all.map((row) => [row.className, row.textContent]));
    assert.deepEqual(history.map(([name]) => name), ['', '', 'corrected']);
    assert.match(history[1][1], /correction.*slipped/);
    assert.match(history[2][1], /Reject.*25\.050/);
    await page.click('.parts button:has-text("Certificate")');
    await page.waitForSelector('.certificate tbody tr');
    const rows = await page.$$eval('.certificate tbody tr', (all) => all.map((row) => row.textContent));
    assert.equal(rows.length, 2); // what was corrected is not certified
    assert.match(rows.find((text) => /bore-A/.test(text)), /Ø 25 H7.*25\.000 to 25\.021.*25\.005\+5 µmGood/);
    assert.match(rows.find((text) => /slot/.test(text)), /8\.000 to 8\.036.*8\.050\+50 µmReject/);
    await page.setViewportSize({ width: 660, height: 900 });
    await page.emulateMedia({ media: 'print' });
    assert.equal(await page.isVisible('.records'), false);
    assert.equal(await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth), true);
    await picture(page, 'certificate-print', { fullPage: true });
  });
});

describe('what is saved as a file', () => {
  it('is saved with the key where one is needed', async () => {
    const locked = await new Daemon('--auth', 'read-open').start();
    try {
      const key = await locked.key('quality', 'operator');
      await fetch(`${locked.url}/v1/measurements`, {
        method: 'POST', body: '{"designation":"25 H7","measured_mm":25.02,"part_id":"SN-1"}', headers: { 'Content-Type': 'application/json', Authorization: `Bearer ${key}` } });
      page = await open(browser, locked, '#/parts');
      await page.fill('dialog input', key);
      await page.press('dialog input', 'Enter');
      await page.waitForSelector('.records tbody tr');
      for (const [view, link, what] of [['parts', 'a:has-text("All of it as CSV")', /SN-1/], ['tables', '#whole-table', /H7/]]) {
        await page.click(`#views a[href^="#/${view}"]`);
        await page.waitForSelector('.records tbody tr, .grid td');
        const [download] = await Promise.all([page.waitForEvent('download'), page.click(link)]);
        assert.match(fs.readFileSync(await download.path(), 'utf8'), what);
      }
    } finally {
      await locked.cleanup();
    }
  });
});

describe('the programs', () => {
  before(() => daemon.send('PUT', '/v1/setups/hole-good', fs.readFileSync(`${EXAMPLE}/setups/hole-good.json`, 'utf8')));

  it('are uploaded, checked and run, and show what they did', async () => {
    page = await open(browser, daemon, '#/programs');
    await page.waitForSelector('.files .aside');
    await page.fill('.upload input[type="text"]', 'nc_prog/8255');
    await page.setInputFiles('.upload input[type="file"]', ['8255.h', '82551.h', '82552.a'].map((name) => `${EXAMPLE}/${name}`));
    await page.waitForFunction(() => document.querySelectorAll('.source li').length > 10);
    const stored = await (await fetch(`${daemon.url}/v1/files/${PROGRAM}`)).text();
    assert.equal(stored, fs.readFileSync(`${EXAMPLE}/8255.h`, 'utf8'));
    await page.click('.program .actions button');
    await page.waitForFunction(() => document.querySelector('.program .note').textContent !== '');
    assert.equal((await page.$$('.finding')).length, 0);
    await page.selectOption('.run select', 'hole-good');
    await page.fill('.run .pair textarea', 'Q1 = 25\nQS1 = H7');
    await page.click('.run button[type="submit"]');
    await page.waitForSelector('.path-view .contact');
    assert.match(await page.textContent('.screen'), /STATUS OF THE FIT: GOOD/);
    assert.equal(await page.textContent('.report .mark-of'), 'Good');
    assert.equal((await page.$$('.path-view:first-of-type .contact')).length, 8); // four touches, in two views
    assert.match(hash(), /run=r\d+/);
    const again = await openIn(page.context(), daemon, new URL(page.url()).hash);
    await again.waitForSelector('.path-view .contact');
    await picture(again, 'programs', { fullPage: true });
    await again.close();
  });

  it('are not deleted or replaced without a question, and say why an upload is refused', async () => {
    const text = 'BEGIN PGM KEEP MM\nEND PGM KEEP MM\n';
    await daemon.send('PUT', '/v1/files/nc_prog/keep.h', text, 'text/plain');
    page = await open(browser, daemon, '#/programs/nc_prog/keep.h');
    await page.waitForFunction(() => document.querySelectorAll('.source li').length === 2);
    const there = async () => (await fetch(`${daemon.url}/v1/files/nc_prog/keep.h`)).text();
    await page.click('button:has-text("Delete")');
    await page.click('dialog button:has-text("Cancel")');
    assert.equal(await there(), text);
    await page.setInputFiles('.upload input[type="file"]', { name: 'KEEP.H', mimeType: 'text/plain', buffer: Buffer.from('new') });
    await page.click('dialog button:has-text("Cancel")');
    assert.equal(await there(), text);
    await page.click('button:has-text("Delete")');
    await page.click('dialog button:has-text("Delete")');
    await page.waitForSelector('.empty:not([hidden])');
    await page.setInputFiles('.upload input[type="file"]', { name: 'big.h', mimeType: 'text/plain', buffer: Buffer.alloc(8 * 1024 * 1024 + 1, 32) });
    await page.waitForFunction(() => document.querySelector('.program .note').textContent !== '');
    assert.ok(await page.isVisible('.program .note'));
  });

  it('carry what a check finds in their text', async () => {
    await daemon.send('PUT', '/v1/files/nc_prog/bad.h', 'BEGIN PGM BAD MM\n1 CALL LBL 7\n2 FOO\nEND PGM BAD MM\n', 'text/plain');
    page = await open(browser, daemon, '#/programs/nc_prog/bad.h');
    await page.waitForFunction(() => document.querySelectorAll('.source li').length === 4);
    await page.click('.run button[type="submit"]'); // a run is refused for the same reasons
    await page.waitForSelector('.finding');
    const found = () => page.$$eval('.source li.error', (lines) => lines.map((line) => line.querySelector('code').textContent));
    assert.deepEqual(await found(), ['1 CALL LBL 7', '2 FOO']);
    await page.click('.program .actions button');
    await page.waitForFunction(() => /2/.test(document.querySelector('.program .note').textContent));
    assert.deepEqual(await found(), ['1 CALL LBL 7', '2 FOO']);
    assert.equal((await page.textContent('.source li:nth-child(3) .caret')).indexOf('^'), 2);
  });

  it('show the log of cycle 444 in a frame that may do nothing', async () => {
    await daemon.send('PUT', '/v1/files/nc_prog/log.h', LOGGING, 'text/plain');
    await daemon.send('PUT', '/v1/setups/plate', PLATE);
    page = await open(browser, daemon, '#/programs/nc_prog/log.h?setup=plate');
    await page.waitForFunction(() => document.querySelector('.run select')?.value === 'plate');
    await page.click('.run button[type="submit"]');
    await page.click('.report .actions button');
    const frame = await (await page.waitForSelector('.report iframe')).contentFrame();
    await frame.waitForSelector('table');
    assert.equal(await page.getAttribute('.report iframe', 'sandbox'), '');
    assert.match(await page.getAttribute('.report iframe', 'src'), /^\/v1\/runs\/r\d+-[0-9a-f]{16}\/files\/TCHPR444/i);
    await picture(page, 'programs-444', { fullPage: true });
  });
});

describe('the tables', () => {
  it('are searched by size and class, and copied as CSV', async () => {
    page = await open(browser, daemon, '#/tables/hole?find=25+H7', { permissions: ['clipboard-read', 'clipboard-write'] });
    await page.waitForSelector('.grid td');
    assert.deepEqual(await page.$$eval('.grid tbody tr', (rows) => rows.map((row) => row.textContent)), ['2430+210']);
    await page.click('text=Copy as CSV');
    await page.waitForFunction(() => document.querySelector('.tables .note').textContent !== '');
    assert.equal(await page.evaluate(() => navigator.clipboard.readText()), 'over_mm,up_to_mm,H7_upper_um,H7_lower_um\n24,30,21,0\n');
    await page.fill('#find', 'JS');
    await page.waitForFunction(() => document.querySelectorAll('.grid thead th').length === 22);
    assert.equal((await page.$$('.grid tbody tr')).length, 41);
    await page.fill('#find', 'Q9');
    await page.waitForFunction(() => !document.querySelector('.grid'));
  });

  it('keep the case of a class: g6 is no hole', async () => {
    page = await open(browser, daemon, '#/tables/hole?find=25g6');
    await page.waitForFunction(() => /g6 is a shaft class/.test(document.querySelector('.tables .note').textContent));
    assert.equal(await page.$('.grid'), null);
    await page.click('text=Shafts');
    await page.waitForSelector('.grid td');
    assert.deepEqual(await page.$$eval('.grid tbody tr', (rows) => rows.map((row) => row.textContent)), ['2430−7−20']);
  });

  it('ask before a class of the standard is replaced, and mark it afterwards', async () => {
    page = await open(browser, daemon, '#/tables/hole?find=25+H8');
    await page.waitForSelector('.own-list');
    await page.click('.own summary');
    await page.fill('.own input', 'H8');
    await page.fill('.own textarea', '18; 30; +100; -100');
    await page.click('.own button[type="submit"]');
    await page.click('dialog button:has-text("Cancel")');
    assert.equal((await daemon.json('/v1/limits/25H8')).basis, 'iso286');
    await page.click('.own button[type="submit"]');
    await page.click('dialog button:has-text("Replace the ISO class")');
    await page.waitForSelector('.own-list >> text=H8');
    await page.waitForSelector('.grid .own-column');
    assert.equal((await daemon.json('/v1/limits/25H8')).basis, 'custom');
    await page.click('.own-list [aria-label]');
    await page.waitForFunction(() => !/H8/.test(document.querySelector('.own-list').textContent));
    assert.equal((await daemon.json('/v1/limits/25H8')).basis, 'iso286');
  });

  it('change on every screen when a column is stored elsewhere', async () => {
    const screens = [
      ['#/gauge/25H9', () => /25\.000 to 25\.052/.test(document.querySelector('.echo')?.textContent), () => /24\.900 to 25\.100/.test(document.querySelector('.echo')?.textContent)],
      ['#/fit/25H9/h6', () => /\+52 \/ 0/.test(document.querySelector('.result')?.textContent), () => /\+100 \/ −100/.test(document.querySelector('.result')?.textContent)],
      ['#/tables/hole?find=25+H9', () => document.querySelector('.grid td span')?.textContent === '+52', () => document.querySelector('.grid td span')?.textContent === '+100'],
    ];
    const pages = [];
    for (const [address, standard] of screens) {
      pages.push(await open(browser, daemon, address));
      await pages.at(-1).waitForFunction(standard);
    }
    const column = { rows: [{ over_mm: 18, up_to_mm: 30, upper_um: 100, lower_um: -100 }] };
    await daemon.send('PUT', '/v1/tables/hole/classes/H9', column);
    for (const [i, [, , changed]] of screens.entries()) await pages[i].waitForFunction(changed);
    await daemon.send('DELETE', '/v1/tables/hole/classes/H9');
    for (const [i, [, standard]] of screens.entries()) await pages[i].waitForFunction(standard);
    page = pages.pop();
    for (const other of pages) await close(other);
  });

  it('take columns of the shop’s own and give them back', async () => {
    page = await open(browser, daemon, '#/tables/shaft');
    await page.waitForSelector('.own-list');
    await page.click('.own summary');
    await page.fill('.own input', 'press1');
    await page.fill('.own textarea', '18; 30; -3,5; -10\n30; 50; oops; 1');
    await page.click('.own button[type="submit"]');
    await page.waitForFunction(() => /oops/.test(document.querySelector('.own .note').textContent));
    await page.fill('.own textarea', '18; 30; -3,5; -10\n30\t50\t-4\t-12');
    await page.click('.own button[type="submit"]');
    await page.waitForSelector('.own-list >> text=press1');
    const limits = await daemon.json('/v1/limits/25press1');
    assert.deepEqual([limits.upper_deviation_um, limits.lower_deviation_um, limits.basis], [-3.5, -10, 'custom']);
    await page.click('.own-list [aria-label]');
    await page.waitForFunction(() => !/press1/.test(document.querySelector('.own-list').textContent));
    assert.equal((await fetch(`${daemon.url}/v1/limits/25press1`)).status, 404);
  });
});
