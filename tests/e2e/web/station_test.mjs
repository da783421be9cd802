/** Nothing false and nothing unseen gets into the record: scanners, parts, outages, corrections. */

import assert from 'node:assert/strict';
import { after, afterEach, before, beforeEach, describe, it } from 'node:test';

import { close, launch, open, openIn, picture } from './support/browser.mjs';
import { Daemon, sleep } from './support/daemon.mjs';
import { modulesOf, read } from './support/qr_reader.mjs';

describe('a station with a scanner', () => {
  let browser;
  let daemon;
  let page;

  before(async () => { browser = await launch(); });
  after(() => browser.close());
  beforeEach(async () => {
    daemon = await new Daemon().start();
    page = await open(browser, daemon, '#/gauge/25H7');
    await page.waitForSelector('.echo .figures');
  });
  afterEach(async () => {
    await close(page);
    await daemon.cleanup();
  });

  const slow = async (text) => { await page.keyboard.type(`${text}\n`, { delay: 45 }); await sleep(310); };
  const stored = async () => (await daemon.stored()).map(({ part_id, measured_mm }) => [part_id, measured_mm]);
  const verdict = (word) => page.waitForSelector(`.verdict[data-verdict="${word}"]`);
  const part = () => page.inputValue('[name="part_id"]');
  const settled = () => page.waitForSelector('.link[data-state="up"]');

  /** All keys at once, as a scanner types them: the browser gets them without a gap. */
  const scan = async (text, end = 'Enter') => {
    await page.evaluate(({ line, last }) => {
      const type = (key) => {
        const down = new KeyboardEvent('keydown', { key, bubbles: true, cancelable: true });
        const target = document.activeElement ?? document.body;
        if (!target.dispatchEvent(down)) return;
        const now = document.activeElement;
        if (key.length === 1 && now.matches('input')) {
          now.setRangeText(key, now.selectionStart, now.selectionEnd, 'end');
          now.dispatchEvent(new InputEvent('input', { bubbles: true, data: key }));
        }
        if (key === 'Enter' && now.form) now.form.requestSubmit();
      };
      for (const key of [...line, last]) type(key);
    }, { line: text, last: end });
    await sleep(310);
  };
  const awayFromFields = () => page.click('.verdict');

  for (const text of ['A25', 'SN-00017', '-25.013', 'E25', '25.013in', '2.5013e1']) {
    it(`stores nothing when ${text} is typed with the focus elsewhere`, async () => {
      await awayFromFields();
      await slow(text);
      assert.equal(await page.inputValue('#value'), text);
      assert.match(await page.textContent('#entry-note'), /Nothing is stored/);
      assert.deepEqual(await stored(), []);
    });
  }

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
    const [, record] = await daemon.stored();
    assert.deepEqual([record.designation, record.order, record.gauge], ['30 k6', 'WO-17', 'G-07']);
  });

  it('takes back a verdict when another part or size is gauged', async () => {
    await slow('25.05');
    await verdict('reject');
    await page.fill('#designation', '30 k6');
    await verdict('idle');
    await page.fill('#designation', '25 H7');
    await page.waitForSelector('.echo .figures');
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
    await page.getByRole('button', { name: 'It is the part 30012345' }).click();
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
    await page.waitForSelector('.verdict[data-provisional]');
    await daemon.start();
    const text = /20 stored after the outage: 17 good, 3 reject/;
    await page.waitForFunction((source) => new RegExp(source).test(document.querySelector('.arrived').textContent), text.source);
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
      await page.waitForSelector(`.verdict[data-provisional][data-verdict="${word}"]`);
    }
    await daemon.start();
    await settled();
    assert.deepEqual((await daemon.stored()).map((record) => record.verdict), ['good', 'reject', 'good', 'rework']);
  });

  it('corrects the part of a record', async () => {
    await scan('SN-1');
    await slow('25.011');
    await verdict('good');
    await page.getByRole('button', { name: 'Correct the part SN-1' }).click();
    await slow('SN-2');
    await page.waitForSelector('.recent .corrected');
    const [old, corrected] = await daemon.stored();
    assert.deepEqual([corrected.part_id, corrected.measured_mm, corrected.correction_of], ['SN-2', 25.011, old.id]);
  });
});

describe('a station in an unfriendly browser', () => {
  let browser;
  before(async () => { browser = await launch(); });
  after(() => browser.close());

  for (const [what, script] of [
    ['storage is denied', () => {
      for (const name of ['localStorage', 'sessionStorage']) {
        Object.defineProperty(window, name, { get() { throw new DOMException('denied', 'SecurityError'); } });
      }
    }],
    ['what was kept is damaged', () => {
      sessionStorage.setItem('fitgauge.recent', '[{');
      localStorage.setItem('fitgauge.arrivals', '{');
      localStorage.setItem('fitgauge.queue.000000000000001.x', 'null');
      localStorage.setItem('fitgauge.queue.000000000000002.y', '{"path":1');
    }],
  ]) {
    it(`works where ${what}`, async () => {
      const daemon = await new Daemon().start();
      const context = await browser.newContext();
      await context.addInitScript(script);
      const page = await openIn(context, daemon, '#/gauge/25H7');
      await page.waitForSelector('.echo .figures');
      await page.keyboard.type('25.0131\n');
      await page.waitForSelector('.verdict[data-verdict="good"]');
      assert.equal((await daemon.stored()).length, 1);
      await close(page);
      await daemon.cleanup();
    });
  }

  it('shows a view also for an address that cannot be decoded', async () => {
    const daemon = await new Daemon().start();
    const page = await open(browser, daemon, '#/gauge/%E0%A4%A');
    await page.waitForSelector('.entry');
    await close(page);
    await daemon.cleanup();
  });

  it('measures with the time of the service, also before it has answered once', async () => {
    const daemon = await new Daemon().start();
    const context = await browser.newContext();
    await context.addInitScript(() => {
      const now = Date.now.bind(Date);
      Date.now = () => now() + 3 * 3600e3;
    });
    const page = await openIn(context, daemon, '#/gauge/25H7');
    await page.waitForSelector('.echo .figures');
    await page.keyboard.type('25.0131\n');
    await page.waitForSelector('.verdict[data-verdict="good"]');
    const [record] = await daemon.stored();
    assert.ok(Math.abs(Date.parse(record.measured_at) - Date.parse(record.received_at)) < 3000, record.measured_at);
    await close(page);
    await daemon.cleanup();
  });

  it('gives a value to the station that a gauge typed into the dialog for keys', async () => {
    const daemon = await new Daemon('--auth', 'read-open').start();
    const key = await daemon.key('station', 'operator');
    const page = await open(browser, daemon, '#/gauge/25H7');
    await page.waitForSelector('.echo .figures');
    await page.keyboard.type('25.011\n');
    await page.waitForSelector('dialog[open]');
    await page.keyboard.type('25.012\n');
    await sleep(350);
    await page.keyboard.type(`${key}\n`);
    await page.waitForSelector('dialog', { state: 'detached' });
    await page.waitForFunction(() => document.querySelectorAll('.recent li.stored').length === 2);
    await close(page);
    await daemon.cleanup();
  });
});

describe('a station with sound', () => {
  it('is silent until it is switched on, then has a sound of its own for each verdict, also after a reload', async () => {
    const browser = await launch();
    const daemon = await new Daemon().start();
    const page = await open(browser, daemon, '#/gauge/25H7');
    // What is to be heard: each oscillator that is started, by its frequency.
    await page.addInitScript(() => {
      globalThis.heard = [];
      const create = AudioContext.prototype.createOscillator;
      AudioContext.prototype.createOscillator = function listened() {
        const tone = create.call(this);
        const { start } = tone;
        tone.start = (at) => {
          globalThis.heard.push(tone.frequency.value);
          return start.call(tone, at);
        };
        return tone;
      };
    });
    await page.reload();
    const measure = async (text, verdict) => {
      await page.waitForSelector('.echo .figures');
      await page.focus('#value');
      await page.keyboard.type(`${text}\n`);
      await page.waitForSelector(`.verdict[data-verdict="${verdict}"]`);
      return page.evaluate(() => globalThis.heard.splice(0));
    };
    assert.deepEqual(await measure('25.01', 'good'), []);
    await page.click('.more summary');
    await page.check('[name="sound"]');
    assert.deepEqual(await page.evaluate(() => globalThis.heard.splice(0)), [880], 'it shows what it is like');
    const rejected = await measure('25.03', 'reject');
    assert.equal(rejected.length, 2);
    await page.reload();
    assert.deepEqual(await measure('25.02', 'good'), [880]);
    assert.ok((await measure('24.99', 'rework')).join() !== rejected.join());
    await close(page);
    await browser.close();
    await daemon.cleanup();
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
  });
  after(async () => {
    await browser.close();
    await daemon.cleanup();
  });

  it('is offered, says until when it is calibrated, and gives a guard band its uncertainty', async () => {
    const page = await open(browser, daemon, '#/gauge/25H7?gauge=G-07&rule=guard_band');
    const says = (text) => page.waitForFunction((wanted) => document.querySelector('.gauge-note').textContent === wanted, text);
    await says('G-07 calibrated until 31 Mar 2099 · u = 0.5 µm');
    assert.equal(await page.inputValue('[name="uncertainty_um"]'), '0.5');
    await page.waitForSelector('.echo .figures');
    await page.focus('#value');
    await page.keyboard.type('25.0205\n'); // nearer to the limit than 2 u
    await page.waitForSelector('.verdict[data-verdict="indeterminate"]');
    await page.click('.more summary');
    await page.waitForFunction(() => [...document.querySelectorAll('#offered-gauge option')].map((name) => name.value).join() === 'G-07,G-08');
    await page.fill('[name="gauge"]', 'G-08');
    await page.keyboard.press('Tab');
    await says('Calibration of G-08 was due on 31 Mar 2020.');
    assert.ok(await page.$('.gauge-note.overdue'));
    await page.fill('[name="gauge"]', 'some other');
    await page.keyboard.press('Tab');
    await says('');
    await close(page);
  });

  it('and what was recorded before are in pick lists, for which nobody is asked for a key', async () => {
    const locked = await new Daemon('--auth', 'read-open').start();
    try {
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
      await page.waitForSelector('.verdict[data-verdict="good"]');
      await page.waitForSelector('.plan select:visible');
      await page.waitForFunction(() => /G-09 calibrated/.test(document.querySelector('.gauge-note').textContent));
      await page.click('.more summary');
      for (const [name, value] of [['gauge', 'G-09'], ['machine', 'M3'], ['operator', 'Ada']]) await page.waitForSelector(`#offered-${name} option[value="${value}"]`, { state: 'attached' });
      page.errors.length = 0;
      await close(page);
    } finally {
      await locked.cleanup();
    }
  });

  it('stands on the certificate with its uncertainty and its date', async () => {
    await daemon.send('POST', '/v1/measurements', { designation: '25 H7', measured_mm: '25.01', part_id: 'SN-3', gauge: 'G-07' });
    const page = await open(browser, daemon, '#/parts?part_id=SN-3');
    await page.click('.parts button:has-text("Certificate")');
    await page.waitForSelector('.certificate .gauges');
    assert.equal(await page.textContent('.certificate .gauges'), 'G-07 calibrated until 31 Mar 2099 · u = 0.5 µm');
    const [record] = await daemon.stored('part_id=SN-3');
    const [drawing, size] = await page.$eval('.qr', (code) => [code.firstChild.getAttribute('d'), code.viewBox.baseVal.width]);
    assert.equal(read(modulesOf(drawing, size)).data, `${daemon.url}/v1/measurements/${record.id}/proof`);
    const { index, checkpoint } = await daemon.json(`/v1/measurements/${record.id}/proof`);
    const [origin, , root] = checkpoint.split('\n');
    const said = await page.textContent('.proof');
    assert.match(said, /row 2 of 2 /);
    assert.equal(index, 1);
    assert.ok(said.includes(origin) && said.includes(root), said);
    await picture(page, 'certificate', { fullPage: true });
    await close(page);
  });
});

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
  after(async () => {
    await browser.close();
    await daemon.cleanup();
  });

  const line = async (text) => { await page.keyboard.type(`${text}\n`); await sleep(320); };
  const progress = (text) => page.waitForFunction((wanted) => document.querySelector('.plan .progress')?.textContent === wanted, text);
  const verdict = (word) => page.waitForSelector(`.verdict[data-verdict="${word}"]`);

  it('is taken up by a scan of its part number, and each value steps on', async () => {
    page = await open(browser, daemon, '#/gauge?gauge=own-gauge');
    await page.waitForSelector('.plan select:visible');
    await page.click('.verdict');
    await line('4711-A');
    await progress('1 of 3');
    await page.waitForFunction(() => document.querySelector('.echo strong')?.textContent === 'Ø 25 H7');
    assert.equal(await page.inputValue('[name="part_id"]'), '');
    await line('SN-00017');
    assert.equal(await page.inputValue('[name="part_id"]'), 'SN-00017');
    assert.match(await page.textContent('.verdict .word'), /SN-00017 · bore-A/);
    await line('25.03');
    await verdict('reject');
    await progress('2 of 3');
    assert.match(await page.textContent('.verdict'), /SN-00017 · bore-A.*Stop and tell the setter/);
    await picture(page, 'gauge-plan');
    await page.keyboard.type('8'); // the next value begins: the verdict of the one before is taken back
    await verdict('idle');
    await line('.02');
    await verdict('good');
    await progress('3 of 3');
    await line('30.003');
    await verdict('indeterminate');
    await progress('All 3 measured');
    await line('SN-00018');
    await progress('1 of 3');
    assert.equal(await page.$$eval('.tiles-of-plan .shape', (shapes) => shapes.length), 0);
    const records = await daemon.stored();
    assert.deepEqual(records.map(({ part_id, characteristic, verdict: word, gauge }) => [part_id, characteristic, word, gauge]), [
      ['SN-00017', 'bore-A', 'reject', 'G-07'], ['SN-00017', 'slot', 'good', 'own-gauge'], ['SN-00017', 'journal', 'indeterminate', 'own-gauge']]);
    assert.deepEqual([records[1].basis, records[1].upper_limit_mm, records[1].lower_limit_mm], ['explicit', 8.036, 7.996]);
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
    await page.waitForSelector('.verdict[data-provisional]');
    await progress('3 of 3');
    await daemon.start();
    await page.waitForSelector('.link[data-state="up"]');
    assert.equal((await daemon.stored()).at(-1).characteristic, 'slot');
    page.errors.length = 0;
    await close(page);
  });
});
