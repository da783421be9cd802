/**
 * Nothing false and nothing unseen gets into the record: scanners, parts, outages, corrections.
 *
 * Tried, and held here:
 * - Touch the verdict, scan `A25`, `SN-00017`, or let a gauge type `-25.013`: a note, nothing stored; a scan of
 *   letters and figures is the part
 * - Scan `SN-1` into *Part*, measure, scan `SN-2` into it: `SN-2`; no tap is needed at all
 * - Kill the service, type 20 values with three rejects, start it: each judged when it is typed; *20 stored: 17
 *   good, 3 reject* until it is touched
 * - 25.05 for 25 H7, then `30 k6` or the next part: *Measure SN-2*; the verdict names part and size
 * - Storage denied or damaged; `#/gauge/%E0%A4%A`: works, and forgets
 * - A wrong part, noticed a shift later: *Correct* at the station and among the parts, value or part
 * - A gauge that ends its values with Tab: two values
 * - A gauge types while the page asks for a key: a value
 * - A station three hours ahead, a value at once: by the clock of the service
 * - The service tells its time three seconds late: where both clocks may be right, they are
 */

import assert from 'node:assert/strict';
import { afterEach, beforeEach, describe, it } from 'node:test';

import { close, findings, open, openIn, picture } from './support/browser.mjs';
import { Daemon, sleep } from './support/daemon.mjs';
import { hold } from './support/hold.mjs';
import { scan as scanInto, typeSlowly } from './support/scanner.mjs';
import { begin, browser, daemon, storedSince } from './support/stage.mjs';

describe('a station with a scanner', () => {
  let page;

  beforeEach(async () => {
    await begin();
    page = await open(browser, daemon, '#/gauge/25H7');
    await page.waitForSelector('.echo .figures');
  });
  afterEach(() => close(page));

  const slow = (text) => typeSlowly(page, text);
  const stored = async () => (await storedSince()).map(({ part_id, measured_mm }) => [part_id, measured_mm]);
  const verdict = (word) => page.waitForSelector(`.verdict[data-verdict="${word}"]:not([data-provisional])`);
  const part = () => page.inputValue('[name="part_id"]');
  const settled = () => page.waitForSelector('.link[data-state="up"]');

  const scan = (text) => scanInto(page, text);
  const awayFromFields = () => page.click('.verdict');

  it('stores nothing when A25, SN-00017, a reading gone wrong is typed with the focus elsewhere', async () => {
    for (const text of ['A25', 'SN-00017', '-25.013', 'E25', '25.013in', '2.5013e1']) {
      await page.keyboard.press('Escape');
      await awayFromFields();
      await slow(text);
      await page.waitForFunction((typed) => {
        const note = document.getElementById('entry-note').textContent;
        return note.includes(typed) && note.includes('Not stored');
      }, text);
      assert.equal(await page.inputValue('#value'), text);
      assert.deepEqual(await stored(), []);
    }
  });

  it('takes a scan of letters and figures for the part, and never a reading gone wrong', async () => {
    for (const [text, expected] of [['SN-00017', 'SN-00017'], ['-25.013', 'SN-00017'], ['25.01in', 'SN-00017'], ['P:4711', '4711'], ['4711-A', '4711-A']]) {
      await awayFromFields();
      await scan(text);
      assert.equal(await part(), expected, text);
    }
    assert.deepEqual(await stored(), []);
  });

  it('goes scan, measure, scan, measure without a tap', async () => {
    for (const [name, value] of [['SN-1', '25.011'], ['SN-2', '25.012'], ['SN-3', '25.013']]) {
      await scan(name);
      assert.match(await page.textContent('.verdict'), new RegExp(`Measure ${name}`));
      await slow(value);
      await verdict('good');
      assert.match(await page.textContent('.verdict .about'), new RegExp(`${name} · Ø 25 H7`));
    }
    assert.deepEqual(await stored(), [['SN-1', 25.011], ['SN-2', 25.012], ['SN-3', 25.013]]);
    await picture(page, 'gauge-parts');
  });

  it('replaces the part when its field is scanned into again', async () => {
    for (const name of ['SN-1', 'SN-2']) {
      await page.click('[name="part_id"]');
      await page.keyboard.type(`${name}\n`);
    }
    assert.equal(await part(), 'SN-2');
  });

  it('takes another job, order and gauge from a scan', async () => {
    await slow('25.05');
    await verdict('reject');
    await scan('30k6');
    await page.waitForFunction(() => document.querySelector('.echo strong')?.textContent === 'Ø 30 k6');
    await verdict('idle');
    await scan('O:WO-17');
    await scan('g:G-07');
    await slow('30.01');
    await verdict('good');
    const [, record] = await storedSince();
    assert.deepEqual([record.designation, record.order, record.gauge], ['30 k6', 'WO-17', 'G-07']);
  });

  it('takes back a verdict when another part or size is gauged', async () => {
    await slow('25.05');
    await verdict('reject');
    await page.fill('#designation', '30 k6');
    await verdict('idle');
    await page.fill('#designation', '25 H7');
    await page.waitForFunction(() => document.querySelector('.echo strong')?.textContent === 'Ø 25 H7');
    await page.focus('#value');
    await slow('25.05');
    await verdict('reject');
    await page.fill('[name="part_id"]', 'SN-9');
    await page.focus('#value');
    await verdict('idle');
    assert.match(await page.textContent('.verdict'), /Measure SN-9/);
  });

  it('asks what a number far outside is, and takes it for the part when told so', async () => {
    await scan('30012345');
    await page.waitForSelector('.entry.asking');
    await page.getByRole('button', { name: 'Part 30012345' }).click();
    assert.equal(await part(), '30012345');
    assert.deepEqual(await stored(), []);
  });

  it('takes Tab for the end of a value', async () => {
    await page.focus('#value');
    for (const value of ['25.001', '25.002']) {
      await page.keyboard.type(value, { delay: 20 });
      await page.keyboard.press('Tab');
    }
    await settled();
    await page.waitForFunction(() => document.querySelectorAll('.recent li.stored').length === 2);
    assert.deepEqual((await stored()).map(([, value]) => value), [25.001, 25.002]);
    assert.ok(await page.evaluate(() => document.activeElement.id === 'value'));
  });

  it('says what became of the values of an outage until it is touched', async () => {
    await daemon.stop();
    const values = Array.from({ length: 20 }, (_, i) => ([2, 5, 6].includes(i) ? `25.03${i}` : `25.00${i % 10}`));
    for (const value of values) await page.keyboard.type(`${value}\n`);
    await page.waitForSelector('.verdict[data-provisional="away"]');
    await daemon.start();
    const text = /20 stored after the outage: 17 good, 3 reject/;
    await page.waitForFunction((source) => new RegExp(source).test(document.querySelector('.arrived')?.textContent), text.source);
    assert.deepEqual(await page.$$eval('.arrived .figure', (figures) => figures.map((each) => each.textContent)),
      ['25.032 mm', '25.035 mm', '25.036 mm']);
    await verdict('idle');
    await picture(page, 'gauge-arrived');
    // A reload hides nothing, a touch does.
    page = await openIn(page.context(), daemon, '#/gauge/25H7');
    assert.match(await page.textContent('.arrived'), text);
    await page.getByRole('button', { name: 'Seen' }).click();
    assert.ok(await page.isHidden('.arrived'));
    assert.equal((await stored()).length, 20);
  });

  it('judges by the limits it holds while the service is away, also on the limit', async () => {
    await daemon.stop();
    for (const [value, word] of [['25.021', 'good'], ['25.021001', 'reject'], ['25', 'good'], ['24.999999', 'rework']]) {
      await slow(value);
      await page.waitForSelector(`.verdict[data-provisional="away"][data-verdict="${word}"]`);
    }
    await daemon.start();
    await settled();
    assert.deepEqual((await storedSince()).map((record) => record.verdict), ['good', 'reject', 'good', 'rework']);
  });

  it('has a place for what the GO gauge said of a size with Ⓔ, of one part alone, and for the size operator', async () => {
    assert.ok(await page.isHidden('.envelope'));
    await scan('25 H7 (E)');
    await page.waitForFunction(() => /Ø 25 H7 \(E\)/.test(document.querySelector('.echo').textContent));
    await scan('SN-E1');
    await page.click('.envelope >> text=does not pass');
    assert.deepEqual(await findings(page), []);
    await picture(page, 'station-envelope');
    await scan('25.010'); // by its size it would be good
    await verdict('rework');
    const release = await hold(page, '**/corrections');
    await page.keyboard.press('Control+z');
    await page.waitForSelector('.entry.correcting');
    await scan('25.009'); // so would its correction
    await page.waitForSelector('.verdict[data-verdict="waiting"]');
    await release();
    await verdict('rework');
    await scan('SN-E2');
    await page.selectOption('[name="size_operator"]', 'GN');
    await page.getByRole('button', { name: 'passes', exact: true }).click();
    await scan('25.011');
    await verdict('good');
    await scan('25.012');
    await page.waitForFunction(() => document.querySelectorAll('.recent li.stored').length === 3);
    await page.click('.envelope >> text=does not pass');
    await scan('SN-E3'); // said of the part before
    await scan('25.013');
    await page.waitForFunction(() => document.querySelectorAll('.recent li.stored').length === 4);
    await page.waitForFunction(() => /envelope not verified/.test(document.querySelector('.verdict').textContent));
    assert.deepEqual(await page.$$eval('.recent li', (all) => all.map(({ textContent: text }) => text.includes('envelope not verified'))), [true, true, false, false, false]);
    const said = (await storedSince()).map(({ envelope, envelope_result: found, go_gauge: go, size_operator: operator, verdict: word }) => [envelope, found, go, operator, word]);
    assert.deepEqual(said, [['required', 'failed', 'fails', 'LP', 'rework'], ['required', 'failed', 'fails', 'LP', 'rework'], ['required', 'verified', 'passes', 'GN', 'good'], ['required', 'not_verified', undefined, 'GN', 'good'], ['required', 'not_verified', undefined, 'GN', 'good']]);
    await scan('30 k6');
    await page.waitForSelector('.envelope', { state: 'hidden' });
  });

  it('asks by its plan for a size operator and for the envelope of limits of a drawing', async () => {
    await daemon.send('PUT', '/v1/plans/E-1', { characteristics: [
      { name: 'e-bore', nominal_mm: 8, feature: 'hole', upper_um: 36, lower_um: 0, envelope: 'required', size_operator: 'GX' }, { name: 'e-pin', designation: '25 h7', size_operator: 'GG' }, { name: 'e-free', designation: '30 k6' }] });
    await page.reload(); // a plan that has come is known then
    await page.waitForSelector('.plan select:visible');
    await scan('E-1');
    await scan('SN-E9');
    await page.waitForSelector('.envelope:visible');
    await page.getByRole('button', { name: 'passes', exact: true }).click();
    await scan('8.01');
    await page.waitForFunction(() => document.querySelector('[name="size_operator"]').value === 'GG');
    assert.ok(await page.isHidden('.envelope >> text=does not pass'));
    await scan('24.99');
    await page.waitForSelector('.envelope', { state: 'hidden' });
    await scan('30.01');
    await page.waitForFunction(() => document.querySelectorAll('.recent li.stored').length === 3);
    const said = (await storedSince()).map(({ characteristic, envelope, go_gauge: go, size_operator: operator }) => [characteristic, envelope, go, operator]);
    assert.deepEqual(said, [['e-bore', 'required', 'passes', 'GX'], ['e-pin', undefined, undefined, 'GG'], ['e-free', undefined, undefined, 'LP']]);
    await scan('SN-E7'); // its GO gauge was tried at another station, and it fails
    await daemon.send('POST', '/v1/measurements', { nominal_mm: 8, feature: 'hole', upper_um: 36, lower_um: 0, envelope: 'required', go_gauge: 'fails', measured_mm: '8.01', part_id: 'SN-E7', characteristic: 'e-bore', measured_at: '2020-01-01T08:00:00Z' });
    for (const text of ['8.01', '24.99', '30.01']) {
      await scan(text);
      await page.waitForFunction((seen) => document.querySelector('.recent li.stored')?.textContent.includes(seen), text);
    }
    await page.waitForFunction(() => /Part SN-E7 · e-bore Rework/.test(document.querySelector('.verdict').textContent));
    await scan('SN-E6');
    await page.click('.envelope >> text=does not pass');
    for (const text of ['8.01', '24.99', '30.01']) {
      await scan(text);
      await page.waitForFunction((seen) => document.querySelector('.recent li.stored')?.textContent.includes(seen), text);
    }
    await page.click('.tiles-of-plan >> text=e-bore'); // measured again, and the gauge is not tried
    await scan('8.02');
    await page.waitForFunction(() => document.querySelector('.recent li.stored')?.textContent.includes('8.02'));
    await page.waitForFunction(() => /Part SN-E6 · e-bore Rework/.test(document.querySelector('.verdict').textContent));
    assert.equal(await page.textContent('.tiles-of-plan button >> nth=0 >> .unseen'), 'Rework');
    // Another station measures it without the gauge as well: it is named once, with its worst verdict.
    await daemon.send('POST', '/v1/measurements', { nominal_mm: 8, feature: 'hole', upper_um: 36, lower_um: 0, envelope: 'required', measured_mm: '8.03', part_id: 'SN-E6', characteristic: 'e-bore', machine: 'M2' });
    await page.waitForFunction(() => /Part SN-E6 · e-bore Reworke-bore 8.03/.test(document.querySelector('.verdict:not([data-provisional])')?.textContent));
    await scan('SN-E8');
    await page.waitForSelector('.envelope:visible');
    await scan('8.01');
    await page.waitForFunction(() => document.querySelector('[name="size_operator"]').value === 'GG');
    await page.selectOption('.plan select', ''); // what it asked ends with it
    await page.waitForSelector('.envelope', { state: 'hidden' });
    assert.equal(await page.inputValue('.designation'), '25 h7');
  });

  it('gauges the radius of an inside corner as its plan has it', async () => {
    await daemon.send('PUT', '/v1/plans/R-1', { characteristics: [{ name: 'r-groove', designation: 'R5 ISO 2768-m', inside_corner: true }, { name: 'r-edge', designation: 'R5 ISO 2768-m' }] });
    await page.reload();
    await page.waitForSelector('.plan select:visible');
    for (const text of ['R-1', 'SN-R1', '5.6']) await scan(text);
    await page.waitForFunction(() => document.querySelectorAll('.recent li.stored').length === 1);
    await scan('5.6');
    await page.waitForFunction(() => document.querySelectorAll('.recent li.stored').length === 2);
    assert.deepEqual((await storedSince()).map(({ characteristic, inside_corner: inside, verdict: word }) => [characteristic, inside, word]), [['r-groove', true, 'rework'], ['r-edge', undefined, 'reject']]);
  });

  it('corrects the part of a record', async () => {
    await scan('SN-1');
    await slow('25.011');
    await verdict('good');
    await page.getByRole('button', { name: 'Correct the part SN-1' }).click();
    await slow('SN-2');
    await page.waitForSelector('.recent .corrected'); // as soon as it is sent
    await settled();
    const [old, corrected] = await storedSince();
    assert.deepEqual([corrected.part_id, corrected.measured_mm, corrected.correction_of], ['SN-2', 25.011, old.id]);
  });
});

describe('a station in an unfriendly browser', () => {
  beforeEach(begin);

  for (const [what, script] of [
    ['storage is denied', () => {
      for (const name of ['localStorage', 'sessionStorage']) {
        Object.defineProperty(window, name, { get() { throw new DOMException('denied', 'SecurityError'); } });
      }
    }],
    ['what was kept is damaged', () => {
      sessionStorage.setItem('fitgauge.recent', '[{');
      localStorage.setItem('fitgauge.arrival.m1', '{');
      localStorage.setItem('fitgauge.queue.000000000000001.x', 'null');
      localStorage.setItem('fitgauge.queue.000000000000002.y', '{"path":1');
    }],
  ]) {
    it(`works where ${what}`, async () => {
      const context = await browser.newContext();
      await context.addInitScript(script);
      const page = await openIn(context, daemon, '#/gauge/25H7');
      await page.waitForSelector('.echo .figures');
      await page.keyboard.type('25.0131\n');
      await page.waitForSelector('.verdict[data-verdict="good"]:not([data-provisional])');
      assert.equal((await storedSince()).length, 1);
      await close(page);
    });
  }

  it('shows a view also for an address that cannot be decoded', async () => {
    const page = await open(browser, daemon, '#/gauge/%E0%A4%A');
    await page.waitForSelector('.entry');
    await close(page);
  });

  it('measures with the time of the service, also before it has answered once', async () => {
    const context = await browser.newContext();
    await context.addInitScript(() => {
      const now = Date.now.bind(Date);
      Date.now = () => now() + 3 * 3600e3;
    });
    let go;
    const told = new Promise((resolve) => { go = resolve; });
    await context.route('**/livez', async (route) => { await told; await route.continue().catch(() => {}); });
    const page = await openIn(context, daemon, '#/gauge/25H7');
    await page.waitForSelector('.echo .figures');
    await page.keyboard.type('25.0131\n');
    await page.waitForSelector('.verdict[data-verdict="good"][data-provisional]');
    go();
    await page.waitForSelector('.verdict[data-verdict="good"]:not([data-provisional])');
    const [record] = await storedSince();
    assert.ok(Math.abs(Date.parse(record.measured_at) - Date.parse(record.received_at)) < 1800e3, record.measured_at);
    await close(page);
  });

  it('keeps its own time where it is right, however late the service tells its own', async () => {
    const context = await browser.newContext();
    await context.route('**/livez', async (route) => {
      const response = await route.fetch();
      await sleep(2300);
      await route.fulfill({ response });
    });
    const page = await openIn(context, daemon, '#/gauge/25H7');
    await page.waitForSelector('.echo .figures');
    const begin = Date.now();
    await page.keyboard.type('25.0131\n');
    const end = Date.now();
    await page.waitForSelector('.verdict[data-verdict="good"]:not([data-provisional])');
    const [record] = await storedSince();
    const measured = Date.parse(record.measured_at);
    assert.ok(begin - 1 <= measured && measured <= end + 1, `${record.measured_at}, typed at ${new Date(begin).toISOString()}`);
    await close(page);
  });

  it('gives a value to the station that a gauge typed into the dialog for keys', async () => {
    const locked = await new Daemon('--auth', 'read-open').start();
    const key = await locked.key('station', 'operator');
    const page = await open(browser, locked, '#/gauge/25H7');
    await page.waitForSelector('.echo .figures');
    await page.keyboard.type('25.011\n');
    await page.waitForSelector('dialog[open]');
    await page.keyboard.type('25.012\n');
    await page.keyboard.type(`${key}\n`);
    await page.waitForSelector('dialog', { state: 'detached' });
    await page.waitForFunction(() => document.querySelectorAll('.recent li.stored').length === 2);
    await close(page);
    await locked.cleanup();
  });
});
