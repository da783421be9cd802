/**
 * The gauging station: values in, records and verdicts out.
 *
 * Tried, and held here:
 * - `26` for 25 H7: asked from five tolerances outside the limits
 * - A scanner that ends with two Enters types a value far outside, and the page is busy for 300 ms: what counts is
 *   when a key was struck
 */

import assert from 'node:assert/strict';
import { afterEach, beforeEach, describe, it } from 'node:test';

import { browserName, close, open, openIn, picture } from './support/browser.mjs';
import { asSeenWith, difference, parseColour } from './support/colour.mjs';
import { sleep } from './support/daemon.mjs';
import { hold } from './support/hold.mjs';
import { PAIR_MS, scan } from './support/scanner.mjs';
import { begin, browser, daemon, storedSince } from './support/stage.mjs';

/** The driver of Firefox does not give the body of a request. */
const SEES_BODIES = { skip: browserName === 'firefox' };
/** Ten times the difference that is just noticed side by side. */
const CLEARLY = 20;

describe('the gauging station', () => {
  let page;

  beforeEach(async () => {
    await begin();
    page = await open(browser, daemon, '#/gauge/25H7');
    await page.waitForSelector('.echo .figures');
  });
  afterEach(() => close(page));

  /** As a gauge on the keyboard does: key by key. */
  const typeValue = (text, delay = 0) => page.keyboard.type(`${text}\n`, { delay });
  const settled = () => page.waitForSelector('.link[data-state="up"]');
  const measured = async () => (await storedSince()).map((record) => record.measured_mm);
  const verdict = (word) => page.waitForSelector(`.verdict[data-verdict="${word}"]:not([data-provisional])`);
  const arrived = (text) => page.waitForFunction((source) => new RegExp(source).test(document.querySelector('.arrived:not([hidden])')?.textContent), text.source);
  const hasFocus = () => page.evaluate(() => document.activeElement.id === 'value');

  it('stores each of 50 values typed at 20 ms a key, once and in order', async () => {
    const values = Array.from({ length: 50 }, (_, i) => Number((24.99 + i / 1000 + (i % 7) / 10000).toFixed(4)));
    for (const value of values) {
      await typeValue(String(value), 20);
      assert.ok(await hasFocus());
    }
    await settled();
    assert.deepEqual(await measured(), values);
  });

  it('takes a second Enter within 300 ms for the same one', async () => {
    await scan(page, '25.0131\n\n');
    await verdict('good');
    await scan(page, '25.0132\n');
    await settled();
    assert.deepEqual(await measured(), [25.0131, 25.0132]);
    assert.equal(await page.textContent('#entry-note'), '');
  });

  it('judges at once by the limits it holds, hatched until the service has stored the value', async () => {
    const answer = await hold(page, '**/v1/measurements');
    await typeValue('25.0215');
    await page.waitForSelector('.verdict[data-verdict="reject"][data-provisional="storing"]');
    await page.waitForFunction(() => /25\.0215 mm.*The service is storing the value/.test(document.querySelector('.verdict')?.textContent));
    assert.equal(await page.getAttribute('.verdict', 'aria-busy'), 'true');
    assert.equal(await page.textContent('.recent .waiting .mark-of'), 'RejectWaiting');
    assert.equal((await storedSince()).length, 0);
    // What is typed meanwhile stays in sight: the answer for the value before does not push it away.
    await typeValue('25.0131');
    await page.waitForSelector('.verdict[data-verdict="good"][data-provisional="storing"]');
    await answer();
    await page.waitForSelector('.recent .stored:has-text("25.0215")');
    assert.match(await page.textContent('.verdict[data-provisional]'), /25\.0131 mm/);
    await answer();
    await verdict('good');
    assert.match(await page.textContent('.verdict'), /7\.9 µm below the upper limit/);
    assert.equal(await page.getAttribute('.verdict', 'aria-busy'), null);
    assert.deepEqual(await measured(), [25.0215, 25.0131]);
  });

  it('keeps values while the service is away, and they arrive once', async () => {
    await typeValue('25.001');
    await verdict('good');
    await daemon.stop();
    const values = [25.002, 25.003, 25.004, 25.005];
    for (const value of values) await typeValue(value, 20);
    await page.waitForSelector('.verdict[data-provisional="away"][data-verdict="good"]');
    await page.waitForSelector('.link[data-state="away"]');
    assert.match(await page.textContent('#link'), /4/);
    await picture(page, 'gauge-away');
    await daemon.start();
    await arrived(/4 stored after the outage: 4 good/);
    await settled();
    assert.deepEqual(await measured(), [25.001, ...values]);
  });

  it('sends what was kept when the page is opened again', async () => {
    await daemon.stop();
    await typeValue('25.002');
    await typeValue('25.003');
    await page.waitForSelector('.verdict[data-provisional="away"]');
    const context = page.context();
    assert.deepEqual(page.errors, []);
    await page.close();
    await daemon.start();
    page = await openIn(context, daemon, '#/gauge/25H7');
    await arrived(/2 stored/);
    await settled();
    assert.deepEqual(await measured(), [25.002, 25.003]);
  });

  it('stores a value once whose answer was lost', SEES_BODIES, async () => {
    let lost = 0;
    await page.route('**/v1/measurements', async (route) => {
      await route.fetch();
      if (lost++) return route.continue();
      return route.abort('connectionreset');
    });
    await typeValue('25.0131');
    await arrived(/1 stored/);
    assert.ok(lost > 1);
    assert.deepEqual(await measured(), [25.0131]);
  });

  it('reads a decimal comma as a point', async () => {
    await typeValue('25,0081');
    await typeValue('25.0081');
    await typeValue('+025,0081 mm');
    await settled();
    const own = (record) => ({ ...record, id: '', measured_at: '', received_at: '' });
    const records = (await storedSince()).map(own);
    assert.equal(records.length, 3);
    assert.equal(records[0].measured_mm, 25.0081);
    assert.deepEqual(records[1], records[0]);
    assert.deepEqual(records[2], records[0]);
  });

  it('sends the digits that were typed', SEES_BODIES, async () => {
    const sent = [];
    page.on('request', (request) => request.method() === 'POST' && sent.push(request.postData()));
    for (const text of ['25.005884000000002', '25.1', '25.000001']) await typeValue(text);
    await settled();
    assert.deepEqual(sent.map((body) => /"measured_mm":([^,}]*)/.exec(body)[1]), ['25.005884000000002', '25.1', '25.000001']);
    assert.deepEqual(await measured(), [25.005884, 25.1, 25.000001]);
  });

  it('says why a value is none, and stores nothing', async () => {
    // An empty value right after an Enter would be the second of a pair.
    for (const bad of ['', 'NaN', '1e9', '1000000000', '25.0.1', '-25.01', '25.01abc', '0', '1.234,5']) {
      await page.press('#value', 'Escape');
      await typeValue(bad);
      await page.waitForFunction(() => document.getElementById('entry-note').textContent !== '');
      assert.ok(await hasFocus(), bad);
    }
    await typeValue('25.0131');
    await verdict('good');
    assert.deepEqual(await measured(), [25.0131]);
  });

  it('asks about a value more than five tolerances outside the limits', async () => {
    // The second Enter of a pair is no answer, also where the page was busy with the first.
    await page.evaluate(() => document.addEventListener('submit', () => { for (const until = performance.now() + 400; performance.now() < until;); }, { once: true }));
    await scan(page, '250.131\n');
    await page.waitForSelector('.entry.asking');
    await verdict('open');
    assert.deepEqual(await measured(), []);
    await page.keyboard.press('Escape');
    assert.equal(await page.inputValue('#value'), '');
    await typeValue('12.4');
    await page.waitForSelector('.entry.asking');
    await sleep(PAIR_MS);
    await page.keyboard.press('Enter'); // the safe answer
    await verdict('idle');
    assert.equal(await page.inputValue('#value'), '');
    assert.match(await page.textContent('.recent li'), /12\.4.*discarded when asked/);
    await typeValue('12.4');
    await page.getByRole('button', { name: 'Store 12.4 mm' }).click();
    await verdict('rework');
    await typeValue('25.126');
    await verdict('reject');
    await typeValue('25.1261');
    await page.waitForSelector('.entry.asking');
    await page.getByRole('button', { name: 'Do not store' }).click();
    await typeValue('26');
    await page.waitForSelector('.entry.asking');
    assert.deepEqual(await measured(), [12.4, 25.126]);
  });

  it('clears what was typed with Esc', async () => {
    await page.keyboard.type('25.01');
    await page.keyboard.press('Escape');
    assert.equal(await page.inputValue('#value'), '');
    assert.deepEqual(await measured(), []);
  });

  it('undoes with a correction that keeps the old record', async () => {
    await typeValue('25.031');
    await verdict('reject');
    await page.keyboard.press('Control+z');
    await page.waitForSelector('.entry.correcting');
    await typeValue('25,013');
    await verdict('good');
    await page.waitForSelector('.recent .corrected'); // as soon as it is sent
    await settled();
    const [old, corrected] = await storedSince();
    assert.equal((await daemon.json(`/v1/measurements/${old.id}`)).corrected_by, corrected.id);
    assert.deepEqual([old.measured_mm, corrected.measured_mm, corrected.correction_of], [25.031, 25.013, old.id]);
    assert.ok((await daemon.stored('')).every((record) => record.id !== old.id));
  });

  it('understands designations as they are typed', async () => {
    for (const [typed, echo] of [['25 H7', 'Ø 25 H7'], ['Ø25H7', 'Ø 25 H7'], ['25 h7', 'Ø 25 h7'], ['132,5/a13', 'Ø 132.5 a13']]) {
      await page.fill('#designation', typed);
      await page.waitForFunction((text) => document.querySelector('.echo strong')?.textContent === text, echo);
    }
    await page.fill('#designation', '25 H19');
    await page.waitForSelector('.echo.wrong');
    await page.press('#designation', 'Enter');
    assert.ok(await hasFocus());
    await typeValue('25.01');
    assert.notEqual(await page.textContent('#entry-note'), '');
    assert.deepEqual(await measured(), []);
  });

  it('puts the job into every record, and the job into the URL', async () => {
    await page.click('.more summary');
    await page.fill('[name="part_id"]', 'SN-1');
    await page.fill('[name="operator"]', '42');
    await page.selectOption('[name="rule"]', 'guard_band');
    await page.fill('[name="uncertainty_um"]', '0,8');
    await page.focus('#value');
    await typeValue('25.0205');
    await verdict('indeterminate');
    const [record] = await storedSince();
    assert.deepEqual([record.part_id, record.operator, record.rule, record.uncertainty_um], ['SN-1', '42', 'guard_band', 0.8]);
    const again = await openIn(page.context(), daemon, new URL(page.url()).hash);
    assert.equal(await again.inputValue('[name="part_id"]'), 'SN-1');
    assert.equal(await again.inputValue('[name="uncertainty_um"]'), '0,8');
    assert.deepEqual(again.errors, []);
  });

  it('says good, rework and reject by word, shape and colour, also to the colour-blind', async () => {
    const seen = {};
    for (const [word, value] of [['good', '25.0131'], ['rework', '24.9985'], ['reject', '25.0215']]) {
      await typeValue(value);
      await verdict(word);
      seen[word] = await page.$eval('.verdict', (panel) => ({
        word: panel.querySelector('.word').textContent,
        outline: panel.querySelector('.outline').getAttribute('d'),
        colour: getComputedStyle(panel).backgroundColor,
        distance: panel.querySelector('.distance').textContent,
        share: panel.getBoundingClientRect().height / innerHeight,
      }));
      await picture(page, `gauge-${word}`);
    }
    for (const part of ['word', 'outline', 'colour']) {
      assert.equal(new Set(Object.values(seen).map((each) => each[part])).size, 3, part);
    }
    assert.deepEqual(Object.values(seen).map((each) => each.distance),
      ['7.9 µm below the upper limit', '1.5 µm below the lower limit', '0.5 µm above the upper limit']);
    for (const { share } of Object.values(seen)) assert.ok(share > 1 / 3, `${share} of the screen`);
    for (const [name, see] of Object.entries(asSeenWith)) {
      const colours = Object.values(seen).map(({ colour }) => see(parseColour(colour)));
      for (const [one, other] of [[0, 1], [0, 2], [1, 2]]) {
        const apart = difference(colours[one], colours[other]);
        assert.ok(apart > CLEARLY, `${name}: ${apart}`);
      }
    }
  });

  it('takes figures typed anywhere for the value', async () => {
    await page.focus('.more summary');
    await typeValue('25.0131');
    await verdict('good');
    assert.ok(await hasFocus());
  });
});
