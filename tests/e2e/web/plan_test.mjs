/**
 * What the station knows beforehand: plans and gauges in use.
 *
 * Tried, and held here:
 * - Another gauge, with a guard band: none until that of this gauge is known
 * - Scan a plan while the service has too much to do, or fails: what it said, and another scan asks again
 */

import assert from 'node:assert/strict';
import { before, describe, it } from 'node:test';

import { close, findings, launch, open, picture } from './support/browser.mjs';
import { Daemon, sleep } from './support/daemon.mjs';
import { eventually } from './support/eventually.mjs';
import { patient } from './support/hold.mjs';
import { answer } from './support/reactions.mjs';
import { PAIR_MS, scan, scanUnasked } from './support/scanner.mjs';

describe('a plan', () => {
  let browser;
  let daemon;
  let page;
  const PLAN = { name: 'Housing', characteristics: [
    { name: 'bore-A', designation: '25 H7', gauge: 'G-07', reaction: 'Stop and tell the setter' },
    { name: 'slot', nominal_mm: 8, feature: 'hole', upper_um: 36, lower_um: -4 },
    { name: 'journal', nominal_mm: '30', tolerance_class: 'k6', rule: 'guard_band', uncertainty_um: 1 },
  ] };

  before(async () => {
    browser = await launch();
    daemon = await new Daemon().start();
    await daemon.send('PUT', '/v1/plans/4711-A', PLAN);
  });

  const line = (text) => scan(page, text);
  const progress = (text) => page.waitForFunction((wanted) => document.querySelector('.plan:not([aria-busy]) .progress')?.textContent === wanted, text);
  const verdict = (word) => page.waitForSelector(`.verdict[data-verdict="${word}"]:not([data-provisional])`);

  it('is taken up by a scan of its part number, and each value steps on', async () => {
    page = await open(browser, daemon, '#/gauge?gauge=own-gauge');
    await page.waitForSelector('.plan select:visible');
    await line('4711-A'); // without a touch: a station with plans begins with a scan
    await progress('1 of 3');
    await page.waitForFunction(() => document.querySelector('.echo strong')?.textContent === 'Ø 25 H7');
    assert.equal(await page.inputValue('[name="part_id"]'), '');
    await line('SN-00017');
    assert.equal(await page.inputValue('[name="part_id"]'), 'SN-00017');
    assert.match(await page.textContent('.verdict .word'), /SN-00017 · bore-A/);
    await line('25.03');
    await verdict('reject');
    await progress('2 of 3');
    assert.match(await page.textContent('.verdict'), /SN-00017 · bore-A/);
    assert.match(await page.textContent('.reactions'), /Reject.*SN-00017 · bore-A.*Stop and tell the setter/);
    await picture(page, 'gauge-plan');
    await page.keyboard.type('8'); // the next value begins: the verdict of the one before is taken back
    await verdict('idle');
    await line('.02'); // and is not taken before the plan's reaction is done
    assert.match(await page.textContent('#entry-note'), /Not stored.*Stop and tell the setter/);
    assert.equal((await daemon.stored()).length, 1);
    await answer(page, 'Done');
    assert.ok(await page.isHidden('.reactions'));
    await sleep(PAIR_MS);
    await page.keyboard.press('Enter'); // what was typed is still there
    await verdict('good');
    await progress('3 of 3');
    await line('30.003');
    await progress('All 3 measured');
    await verdict('reject'); // that of the part
    assert.match(await page.textContent('.verdict'), /Part SN-00017 · bore-A Reject · journal Indeterminate.*journal 30\.003 mm · Indeterminate/);
    await line('SN-00018');
    await progress('1 of 3');
    assert.equal(await page.$$eval('.tiles-of-plan .shape', (shapes) => shapes.length), 0);
    await page.setViewportSize({ width: 300, height: 844 });
    assert.deepEqual(await page.$$eval('.tiles-of-plan button', (tiles) => tiles.filter((tile) => tile.scrollWidth > tile.clientWidth).map(({ textContent }) => textContent)), []);
    await page.setViewportSize({ width: 1280, height: 800 });
    const records = await daemon.stored();
    assert.deepEqual(records.map(({ part_id, characteristic, verdict: word, gauge }) => [part_id, characteristic, word, gauge]), [
      ['SN-00017', 'bore-A', 'reject', 'G-07'], ['SN-00017', 'slot', 'good', 'own-gauge'], ['SN-00017', 'journal', 'indeterminate', 'own-gauge']]);
    assert.deepEqual([records[1].basis, records[1].upper_limit_mm, records[1].lower_limit_mm], ['explicit', 8.036, 7.996]);
    await close(page);
  });

  it('measures against one limit, with the service and without', async () => {
    await daemon.send('PUT', '/v1/plans/FLAT-1', { characteristics: [
      { name: 'flange', nominal_mm: 2, feature: 'shaft', upper_um: 50 }, { name: 'depth', nominal_mm: 12, feature: 'hole', lower_um: -100 }] });
    page = await open(browser, daemon, '#/gauge?plan=FLAT-1');
    await progress('1 of 2');
    assert.deepEqual(await page.$$eval('.tiles-of-plan .aside', (all) => all.map((each) => each.textContent)), ['≤ 2.050 mm', '≥ 11.900 mm']);
    const measure = async (name, value, word, provisional = ':not([data-provisional])') => {
      await page.waitForFunction((wanted) => document.querySelector('.tiles-of-plan [aria-current]')?.textContent.includes(wanted), name);
      await line(value);
      await page.waitForSelector(`.verdict[data-verdict="${word}"]${provisional}`);
    };
    await measure('flange', '2.012', 'good');
    assert.match(await page.textContent('.verdict'), /38 µm below the upper limit/);
    await picture(page, 'gauge-one-limit');
    await measure('depth', '11.899', 'rework');
    await page.click('.tiles-of-plan li:first-child button');
    await daemon.stop();
    await measure('flange', '2.051', 'rework', '[data-provisional="away"]');
    await page.click('.tiles-of-plan li:last-child button');
    await measure('depth', '11.9', 'rework', '[data-provisional="away"]'); // of the part: its flange is to be reworked
    await page.waitForFunction(() => /flange Rework.*depth 11\.900 mm · Good/.test(document.querySelector('.verdict').textContent));
    await daemon.start();
    await page.waitForSelector('.link[data-state="up"]');
    assert.deepEqual((await daemon.stored()).slice(-4).map(({ characteristic, verdict: word }) => [characteristic, word]),
      [['flange', 'good'], ['depth', 'rework'], ['flange', 'rework'], ['depth', 'good']]);
    assert.doesNotMatch(await page.textContent('main'), /NaN|undefined|Infinity/);
    page.errors.length = 0;
    await close(page);
  });

  it('judges by its own rule and factor, which the record has too', async () => {
    await daemon.send('PUT', '/v1/plans/RULES-1', { characteristics: [
      { name: 'wide', designation: '25 H7', rule: 'guard_band', uncertainty_um: 1, coverage_factor: 3 },
      { name: 'likely', designation: '25 H7', rule: 'conformance', uncertainty_um: 1 }] });
    page = await open(browser, daemon, '#/gauge?plan=RULES-1');
    await progress('1 of 2');
    await page.waitForSelector('.echo .figures');
    const before = (await daemon.stored()).length;
    // 2.5 and 1.8 u below the limit: within 3 u of it, and above 95 % to be good.
    await line('25.0185');
    await verdict('indeterminate');
    await progress('2 of 2');
    await page.waitForSelector('.echo .figures');
    await line('25.0192');
    await page.waitForFunction(() => /likely 25\.0192 mm · Good/.test(document.querySelector('.verdict').textContent));
    await verdict('indeterminate'); // that of the part
    assert.deepEqual((await daemon.stored()).slice(before).map(({ rule, coverage_factor, verdict: word }) => [rule, coverage_factor, word]),
      [['guard_band', 3, 'indeterminate'], ['conformance', undefined, 'good']]);
    await close(page);
  });

  it('takes no value for something else while it is being fetched, and the last that was asked for counts', async () => {
    await daemon.send('PUT', '/v1/plans/OTHER-1', { characteristics: [{ name: 'journal', designation: '25 k6' }] });
    page = await open(browser, daemon, '#/gauge/25H7');
    await page.waitForSelector('.plan select:visible');
    await page.waitForSelector('.echo .figures');
    const before = (await daemon.stored()).length;
    const held = {};
    await patient(page);
    await page.route('**/v1/plans/*', async (route) => {
      await new Promise((resolve) => { held[route.request().url().split('/').at(-1)] = resolve; });
      await route.continue().catch(() => {});
    });
    const asked = async (part) => { while (!held[part]) await page.waitForTimeout(5); };
    await scanUnasked(page, '4711-A');
    await asked('4711-A');
    await scanUnasked(page, '25.01');
    assert.match(await page.textContent('#entry-note'), /Not stored: the characteristic is being loaded/);
    await scanUnasked(page, 'OTHER-1');
    await asked('OTHER-1');
    held['OTHER-1']();
    await progress('1 of 1');
    held['4711-A']();
    await page.waitForFunction(() => /25 k6/.test(document.querySelector('.echo strong')?.textContent));
    await line('25.01');
    await verdict('good');
    assert.deepEqual((await daemon.stored()).slice(before).map(({ characteristic, measured_mm }) => [characteristic, measured_mm]), [['journal', 25.01]]);
    assert.equal(await page.textContent('.plan .progress'), 'All 1 measured');
    await close(page);
  });

  it('is not said to be gone by a service that cannot answer', async () => {
    page = await open(browser, daemon, '#/gauge/25H7');
    await page.waitForSelector('.plan select:visible');
    await page.route('**/v1/plans/4711-A', (route) => route.fulfill({
      status: 429, contentType: 'application/problem+json', body: JSON.stringify({ status: 429, title: 'Busy', code: 'service.overloaded', detail: 'too much work' }),
    }));
    await scanUnasked(page, '4711-A');
    await page.waitForFunction(() => (document.querySelector('.of-plan')?.textContent ?? '') !== '');
    assert.doesNotMatch(await page.textContent('.of-plan'), /no plan/);
    await page.unroute('**/v1/plans/4711-A');
    await scanUnasked(page, '4711-A');
    await page.waitForSelector('.tiles-of-plan li');
  });

  it('demands its reaction over a reload and an outage, once for each value', async () => {
    page = await open(browser, daemon, '#/gauge?plan=4711-A');
    await progress('1 of 3');
    await page.waitForFunction(() => document.querySelector('.echo strong')?.textContent === 'Ø 25 H7');
    const before = (await daemon.stored()).length;
    await daemon.stop();
    await line('25.03');
    await page.waitForSelector('.reactions button');
    await daemon.start();
    await page.waitForSelector('.link[data-state="up"]');
    assert.equal(await page.$$eval('.reactions .line', (all) => all.length), 1);
    await page.reload();
    await progress('2 of 3');
    await page.click('.tiles-of-plan li:first-child button');
    await page.waitForFunction(() => document.querySelector('.echo strong')?.textContent === 'Ø 25 H7');
    await line('25.01');
    assert.match(await page.textContent('#entry-note'), /Stop and tell the setter/);
    await answer(page, 'Done');
    await line('25.01');
    await page.waitForFunction(() => document.querySelector('.recent li.stored'));
    await page.waitForSelector('.link[data-state="up"]');
    assert.deepEqual((await daemon.stored()).slice(before).map((record) => record.measured_mm), [25.03, 25.01]);
    assert.ok(await page.isHidden('.reactions')); // a good value demands nothing
    page.errors.length = 0;
    await close(page);
  });

  it('demands a cause and a measure of its catalogue, which become a note beside the record', async () => {
    await daemon.send('PUT', '/v1/catalogues/turning', { causes: ['Insert worn', 'Clamped askew'], measures: ['Insert changed', 'Scrapped'] });
    await daemon.send('PUT', '/v1/plans/SHAFT', { characteristics: [{ name: 'seat', designation: '25 H7', catalogue: 'turning' }] });
    page = await open(browser, daemon, '#/gauge?plan=SHAFT&operator=Kim');
    await progress('1 of 1');
    await page.waitForFunction(() => document.querySelector('.echo strong')?.textContent === 'Ø 25 H7');
    await line('25.03');
    await verdict('reject');
    const buttons = () => page.$$eval('.choices-of button', (all) => all.map((one) => [one.textContent, one.getBoundingClientRect().height >= 64]));
    await eventually(async () => assert.deepEqual(await buttons(), [['Insert worn', true], ['Clamped askew', true]])); // as soon as the catalogue is there
    await picture(page, 'gauge-cause');
    assert.deepEqual(await findings(page), []);
    await line('25.01');
    assert.match(await page.textContent('#entry-note'), /Not stored.*cause and action/);
    await answer(page, 'Insert worn');
    assert.deepEqual(await buttons(), [['Insert changed', true], ['Scrapped', true]]);
    await page.reload(); // and what was said already stands
    await page.waitForFunction(() => document.querySelector('.echo strong')?.textContent === 'Ø 25 H7');
    await answer(page, 'Insert changed');
    assert.ok(await page.isHidden('.reactions'));
    await page.waitForSelector('.recent .noted');
    assert.equal(await page.textContent('.recent .noted'), 'Insert worn → Insert changed');
    await page.waitForSelector('.link[data-state="up"]');

    await daemon.stop(); // the notes wait with their values, in order, also over a reload
    await line('25.04');
    await answer(page, 'Clamped askew');
    await page.fill('[name="measure"]', 'Turned anew');
    await page.press('[name="measure"]', 'Enter');
    await line('25.05');
    await answer(page, 'Insert worn', 'Scrapped');
    await daemon.start();
    await page.waitForSelector('.link[data-state="up"]');
    const noted = (await daemon.stored('characteristic=seat&notes=only')).map((record) => [record.measured_mm, ...record.notes.map((one) => [one.cause, one.measure, one.operator])]);
    assert.deepEqual(noted, [[25.03, ['Insert worn', 'Insert changed', 'Kim']], [25.04, ['Clamped askew', 'Turned anew', 'Kim']], [25.05, ['Insert worn', 'Scrapped', 'Kim']]]);
    assert.ok(await page.isVisible('.arrived'));

    await page.evaluate(() => { location.hash = '#/parts?cause=Insert+worn'; });
    await page.waitForFunction(() => document.querySelectorAll('.records tbody tr').length === 2);
    assert.match(await page.textContent('.records tbody tr'), /Insert worn → Scrapped · Kim/);
    await page.click('.records tbody tr:last-child >> text=Note');
    await page.click('dialog button.primary');
    assert.match(await page.textContent('dialog .note'), /a cause, an action or a text/);
    await page.fill('dialog [name="text"]', 'the whole batch was looked through');
    assert.deepEqual(await findings(page), []);
    await page.click('dialog button.primary');
    await page.waitForFunction(() => /the whole batch was looked through/.test(document.querySelector('.records tbody tr:last-child')?.textContent ?? ''));
    page.errors.length = 0;
    await close(page);
  });

  it('shows the picture of what is measured next beside it, with a key too', async () => {
    const png = Buffer.from('iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAYAAAAfFcSJAAAADUlEQVR42mP8z8BQDwAEhQGAhKmMIQAAAABJRU5ErkJggg==', 'base64');
    const pictured = { characteristics: [{ name: 'bore', designation: '25 H7', picture: 'pictures/bore.png' }, { name: 'slot', designation: '8 H9' }] };
    const locked = await new Daemon('--auth', 'read-open').start();
    const key = await locked.key('setter', 'admin');
    for (const [to, given] of [[daemon, {}], [locked, { Authorization: `Bearer ${key}` }]]) {
      const put = (path, type, body) => fetch(`${to.url}/v1/${path}`, { method: 'PUT', headers: { ...given, 'Content-Type': type }, body });
      assert.ok((await put('files/pictures/bore.png', 'image/png', png)).ok);
      assert.ok((await put('plans/PIC', 'application/json', JSON.stringify(pictured))).ok);
    }
    page = await open(browser, daemon, '#/gauge?plan=PIC&part_id=SN-1');
    await page.waitForFunction(() => document.querySelector('.verdict[data-verdict="idle"] img.picture:not([hidden])')?.naturalWidth === 1);
    assert.equal(await page.getAttribute('.verdict .picture', 'alt'), 'Picture of bore');
    assert.deepEqual(await findings(page), []);
    await line('25.01');
    await verdict('good');
    await progress('2 of 2');
    assert.equal(await page.$('.verdict .picture'), null);
    await page.keyboard.type('8');
    await verdict('idle');
    assert.equal(await page.$('.verdict .picture'), null, 'none of the slot');
    await close(page);
    page = await open(browser, locked, '#/gauge/25H7');
    await page.waitForSelector('.echo .figures');
    await line(key);
    await page.waitForSelector('.plan select:visible');
    await line('PIC');
    await page.waitForFunction(() => {
      const canvas = document.querySelector('.verdict[data-verdict="idle"] canvas.picture:not([hidden])');
      return canvas?.width === 1 && canvas.getContext('2d').getImageData(0, 0, 1, 1).data[3] > 0;
    });
    await close(page);
    await locked.cleanup();
  });

  for (const catalogue of ['nowhere', 'empty']) it(`takes a cause in words of one's own where its catalogue is ${catalogue}`, async () => {
    await daemon.send('PUT', '/v1/catalogues/empty', { causes: [], measures: [] });
    await daemon.send('PUT', '/v1/plans/ODD', { characteristics: [{ name: catalogue, designation: '25 H7', catalogue }] });
    page = await open(browser, daemon, '#/gauge?plan=ODD');
    await page.waitForFunction((name) => document.querySelector('.echo strong')?.textContent === 'Ø 25 H7' && (name === 'nowhere' || localStorage.getItem(`fitgauge.catalogue.${name}`)), catalogue);
    await line('25.03');
    await verdict('reject');
    for (const [name, text] of [['cause', 'Insert worn'], ['measure', 'None']]) {
      await page.fill(`.reactions [name="${name}"]`, text);
      await page.press(`.reactions [name="${name}"]`, 'Enter');
    }
    await page.waitForSelector('.reactions', { state: 'hidden' });
    await page.waitForSelector('.link[data-state="up"]');
    const [record] = await daemon.stored(`characteristic=${catalogue}&notes=shown`);
    assert.deepEqual([record.notes[0].cause, record.notes[0].measure], ['Insert worn', 'None']);
    await close(page);
  });

  it('comes back with the address, also while the service is away, and its steps can be chosen', async () => {
    page = await open(browser, daemon, '#/gauge?plan=4711-A');
    await progress('1 of 3');
    await page.click('.tiles-of-plan li:nth-child(2) button');
    await progress('2 of 3');
    await page.waitForFunction(() => /8/.test(document.querySelector('.echo')?.textContent));
    await page.focus('#value');
    await daemon.stop();
    await line('8.036');
    await page.waitForSelector('.verdict[data-provisional="away"]');
    await progress('3 of 3');
    await daemon.start();
    await page.waitForSelector('.link[data-state="up"]');
    assert.equal((await daemon.stored()).at(-1).characteristic, 'slot');
    page.errors.length = 0;
    await close(page);
  });

  it('takes values of 0 and less where a deviation or a position is asked, and of no size', async () => {
    await daemon.send('PUT', '/v1/plans/4711-Z', { characteristics: [
      { name: 'bore', designation: '25 H7' },
      { name: 'flatness', nominal_mm: 0, quantity: 'deviation', upper_um: 50 },
      { name: 'seat', nominal_mm: -50, quantity: 'position', upper_um: 100, lower_um: -100 },
    ] });
    page = await open(browser, daemon, '#/gauge');
    await page.waitForSelector('.plan select:visible');
    await line('4711-Z');
    await progress('1 of 3');
    await line('Z-00001');
    const shows = (selector, text) => page.waitForFunction(([of, wanted]) => document.querySelector(of)?.textContent.includes(wanted), [selector, text]);
    await line('-25.01');
    await shows('#entry-note', 'is not a value');
    await page.keyboard.press('Escape');
    await line('25.01');
    await progress('2 of 3');
    await shows('.echo', '0≤ 0.050 mm'); // not those of the bore
    await line('0');
    await progress('3 of 3');
    await shows('.echo', '−50.100 to −49.900 mm');
    await line('-50.02');
    await progress('All 3 measured');
    await page.waitForFunction(() => document.querySelectorAll('.recent li.stored').length === 3);
    const records = (await daemon.stored()).filter(({ part_id: part }) => part === 'Z-00001');
    assert.deepEqual(records.map(({ characteristic, measured_mm: mm, verdict: word }) => [characteristic, mm, word]),
      [['bore', 25.01, 'good'], ['flatness', 0, 'good'], ['seat', -50.02, 'good']]);
    await close(page);
  });
});

describe('a gauge in use', () => {
  let browser;
  let daemon;

  before(async () => {
    browser = await launch();
    daemon = await new Daemon().start();
    await daemon.send('PUT', '/v1/uncertainties/plug', { contributions: [{ name: 'ring', standard_uncertainty: 0.3 }, { name: 'repeatability', standard_uncertainty: 0.4 }] });
    await daemon.send('PUT', '/v1/gauges-in-use/G-07', { uncertainty: 'plug', calibration_due: '2099-03-31' });
    await daemon.send('PUT', '/v1/gauges-in-use/G-08', { calibration_due: '2020-03-31' });
    await daemon.send('PUT', '/v1/gauges-in-use/G-10', { calibration_due: '2020-03-31' });
    await daemon.send('POST', '/v1/gauges-in-use/G-10/calibrations', { from: '2020-04-01', due: '2099-03-31' });
    await daemon.send('PUT', '/v1/gauges-in-use/G-11', { calibration_due: '2099-03-31' });
    await daemon.send('POST', '/v1/gauges-in-use/G-11/calibrations', { from: '2026-05-01', status: 'blocked' });
  });

  it('is offered, says until when it is calibrated, and gives a guard band its uncertainty', async () => {
    const page = await open(browser, daemon, '#/gauge/25H7?gauge=G-07&rule=guard_band');
    const says = (text) => page.waitForFunction((wanted) => document.querySelector('.gauge-note')?.textContent === wanted, text);
    await says('G-07 calibrated until 31 Mar 2099 · u = 0.5 µm');
    assert.equal(await page.inputValue('[name="uncertainty_um"]'), '0.5');
    await page.waitForSelector('.echo .figures');
    await page.focus('#value');
    await page.keyboard.type('25.0205\n'); // nearer to the limit than 2 u
    await page.waitForSelector('.verdict[data-verdict="indeterminate"]:not([data-provisional])');
    await page.click('.more summary');
    await page.waitForFunction(() => [...document.querySelectorAll('#offered-gauge option')].map((name) => name.value).join() === 'G-07,G-08,G-10,G-11');
    await page.fill('[name="gauge"]', 'G-08');
    await page.keyboard.press('Tab');
    await says('Calibration of G-08 was due on 31 Mar 2020.');
    assert.ok(await page.$('.gauge-note.overdue'));
    assert.equal(await page.inputValue('[name="uncertainty_um"]'), '', 'that of G-07 is none of G-08');
    await page.focus('#value');
    await page.keyboard.type('25.0131\n');
    await page.waitForFunction(() => /uncertainty/.test(document.querySelector('#entry-note')?.textContent));
    await page.keyboard.press('Escape');
    await page.click('.more summary');
    for (const [gauge, text] of [['G-10', 'G-10 calibrated until 31 Mar 2099'], ['G-11', 'G-11 has been blocked since 1 May 2026.']]) {
      await page.fill('[name="gauge"]', gauge);
      await page.keyboard.press('Tab');
      await says(text);
    }
    await page.fill('[name="gauge"]', 'some other');
    await page.keyboard.press('Tab');
    await says('');
    await close(page);
  });

  it('and what was recorded before are in pick lists, for which nobody is asked for a key', async () => {
    const locked = await new Daemon('--auth', 'read-open').start();
    const key = await locked.key('station', 'admin');
    const headers = { 'Content-Type': 'application/json', Authorization: `Bearer ${key}` };
    const send = (method, target, body) => fetch(locked.url + target, { method, body: JSON.stringify(body), headers });
    await send('PUT', '/v1/gauges-in-use/G-09', { calibration_due: '2099-03-31' });
    await send('PUT', '/v1/plans/4711', { characteristics: [{ name: 'bore-A', designation: '25 H7' }] });
    await send('POST', '/v1/measurements', { designation: '25 H7', measured_mm: '25.01', machine: 'M3', operator: 'Ada' });
    const page = await open(browser, locked, '#/gauge/25H7?gauge=G-09');
    const asked = ['plans', 'gauges-in-use/G-09'].map((name) => page.waitForResponse((answer) => answer.url().includes(name)));
    await page.reload();
    await Promise.all(asked);
    await page.waitForSelector('.echo .figures');
    assert.equal(await page.$('dialog'), null);
    await page.keyboard.type('25.01\n');
    await page.fill('dialog input', key);
    await page.press('dialog input', 'Enter');
    await page.waitForSelector('.verdict[data-verdict="good"]:not([data-provisional])');
    await page.waitForSelector('.plan select:visible');
    await page.waitForFunction(() => /G-09 calibrated/.test(document.querySelector('.gauge-note')?.textContent));
    await page.click('.more summary');
    for (const [name, value] of [['gauge', 'G-09'], ['machine', 'M3'], ['operator', 'Ada']]) await page.waitForSelector(`#offered-${name} option[value="${value}"]`, { state: 'attached' });
    page.errors.length = 0;
    await close(page);
  });
});
