/**
 * What a station has on its table: a scanner of badges, a number pad, a gauge on a wire, a loudspeaker.
 *
 * Tried, and held here:
 * - A gauge on a wire is in the middle of 125.013, and the page is busy while it opens the port; or a fault in the
 *   middle: may be cut: send it again
 */

import assert from 'node:assert/strict';
import { beforeEach, describe, it } from 'node:test';

import { close, findings, open, openIn, picture } from './support/browser.mjs';
import { Daemon } from './support/daemon.mjs';
import { eventually } from './support/eventually.mjs';
import { scan } from './support/scanner.mjs';
import { begin, browser, daemon, storedSince } from './support/stage.mjs';

beforeEach(begin);

describe('a badge', () => {
  it('logs in by a scan, another one logs in another, and no key is seen or kept', async () => {
    const locked = await new Daemon('--auth', 'read-open').start();
    const [ada, bob] = [await locked.key('ada', 'operator'), await locked.key('bob', 'operator')];
    const page = await open(browser, locked, '#/gauge/25H7?operator=Jo');
    await page.waitForSelector('.echo .figures');
    const says = (text) => page.waitForFunction((source) => new RegExp(source).test(document.querySelector('.badge')?.textContent), text);
    for (const [i, [key, value]] of [[ada, '25.01'], [bob, '25.011']].entries()) {
      await scan(page, key);
      await says(`Key ${key.slice(0, 7)}… in use`);
      await scan(page, value);
      await page.waitForFunction((count) => document.querySelectorAll('.recent li.stored').length === count, i + 1);
      await says(`^${i ? 'bob' : 'ada'} · key`);
    }
    // The operator of the address was another person.
    for (const [name, value] of [['ada', 25.01], ['bob', 25.011]]) {
      const { measurements } = await (await fetch(`${locked.url}/v1/measurements?caller=${name}`, { headers: { Authorization: `Bearer ${ada}` } })).json();
      assert.deepEqual(measurements.map((record) => [record.measured_mm, record.operator]), [[value, undefined]]);
    }
    await picture(page, 'gauge-badge');
    await page.getByRole('button', { name: 'Log out' }).click();
    await says('^$');
    await scan(page, `fg_${'0'.repeat(64)}`);
    await says('not valid');
    assert.equal(await page.$('dialog'), null);
    const text = await page.evaluate(() => [document.body.textContent, ...Object.values(localStorage), ...Object.values(sessionStorage)].join());
    assert.ok(![ada, bob].some((key) => text.includes(key)));
    await close(page);
    await locked.cleanup();
  });

  it('whose key is revoked has nobody logged in: what waits keeps waiting for it, says so, and is stored with another only by a touch', async () => {
    const locked = await new Daemon('--auth', 'read-open').start();
    const [ada, bob] = [await locked.key('ada', 'operator'), await locked.key('bob', 'operator')];
    const page = await open(browser, locked, '#/gauge/25H7');
    await page.waitForSelector('.echo .figures');
    const says = (selector, text) => page.waitForFunction(([where, source]) => new RegExp(source).test(document.querySelector(where)?.textContent), [selector, text]);
    await scan(page, ada);
    await scan(page, '25.01');
    await says('.badge', '^ada · key');
    locked.command('key', 'revoke', '--name', 'ada');
    const isRevoked = async () => (await fetch(`${locked.url}/v1/measurements`, { headers: { Authorization: `Bearer ${ada}` } })).status === 401;
    await eventually(async () => assert.ok(await isRevoked()));
    await scan(page, '25.011');
    await page.waitForSelector('dialog');
    await page.keyboard.press('Escape');
    await says('.verdict .distance', 'Not stored: a key is missing');
    await says('#link', 'Key missing · 1 waiting');
    await says('.badge', '^$');
    assert.deepEqual(await findings(page), []);
    await page.evaluate(() => { location.hash = '#/parts'; });
    await page.fill('dialog input', bob);
    await page.press('dialog input', 'Enter');
    await page.waitForSelector('dialog', { state: 'detached' });
    await says('#link', 'Key missing · 1 waiting');
    await page.evaluate(() => { location.hash = '#/gauge/25H7'; });
    await page.waitForSelector('.echo .figures');
    await says('.badge', `^1 waiting for the key ${ada.slice(0, 7)}….*Key ${bob.slice(0, 7)}… in use`);
    await scan(page, '25.012'); // of his own: nothing holds it up
    await page.waitForFunction(() => document.querySelectorAll('.recent li.stored').length === 2);
    assert.deepEqual(await findings(page), []);
    await page.reload(); // he logs in again, and it still waits
    await page.waitForSelector('.echo .figures');
    await says('.badge', '^1 waiting');
    const callers = async () => (await (await fetch(`${locked.url}/v1/measurements`, { headers: { Authorization: `Bearer ${bob}` } })).json())
      .measurements.map((record) => [record.measured_mm, record.caller]);
    assert.deepEqual(await callers(), [[25.01, 'ada'], [25.012, 'bob']]);
    await page.getByRole('button', { name: 'Store with the key in use' }).click();
    await says('#link', 'Connected');
    await says('.badge', '^bob · key');
    assert.deepEqual((await callers()).sort(), [[25.01, 'ada'], [25.011, 'bob'], [25.012, 'bob']]);
    await close(page);
    await locked.cleanup();
  });

  it('is the operator of what it has measured in Parts, in Trend and in a study', async () => {
    const locked = await new Daemon('--auth', 'read-open').start();
    const ada = await locked.key('ada', 'operator');
    for (const part of ['SN-1', 'SN-2']) {
      await fetch(`${locked.url}/v1/measurements`, { method: 'POST', headers: { 'Content-Type': 'application/json', Authorization: `Bearer ${ada}` },
        body: JSON.stringify({ designation: '25 H7', measured_mm: 25.01, part_id: part, characteristic: 'bore' }) });
    }
    const page = await open(browser, locked, '#/gauge/25H7');
    await page.waitForSelector('.echo .figures');
    await scan(page, ada);
    await page.waitForFunction(() => /in use/.test(document.querySelector('.badge')?.textContent));
    const go = (address) => page.evaluate((hash) => { location.hash = hash; }, address);
    await go('#/parts');
    await page.waitForFunction(() => document.querySelectorAll('.records tbody tr').length === 2);
    assert.equal(await page.textContent('.records tbody td:nth-child(7)'), 'ada');
    await go('#/trend?characteristic=bore&boxes=operator');
    await page.waitForFunction(() => /ada: n = 2/.test(document.querySelector('.boxes')?.textContent));
    await page.waitForSelector('.control-chart');
    await page.focus('.trend figure');
    await page.keyboard.press('ArrowLeft');
    await page.waitForFunction(() => /bore · ada/.test(document.querySelector('.detail')?.textContent));
    await go('#/gauges');
    await page.waitForSelector('.study option[value="bore"]', { state: 'attached' });
    await page.selectOption('.study [name="characteristic"]', 'bore');
    await page.waitForFunction(() => document.querySelector('[name="operators"]').value === 'ada');
    await close(page);
    await locked.cleanup();
  });
});

describe('a number pad', () => {
  it('types for those who have no keyboard, and leaves the verdict in sight', async () => {
    const page = await open(browser, daemon, '#/gauge/25H7', { viewport: { width: 1024, height: 768 }, locale: 'de-DE', hasTouch: true });
    await page.waitForSelector('.echo .figures');
    if (await page.isHidden('.pad')) {
      await page.click('.more summary');
      await page.check('[name="pad"]');
    }
    const touch = async (keys) => { for (const key of keys) await page.getByRole('button', { name: key, exact: true }).tap(); };
    await touch(['2', '5', ',', '0', '1', '4', 'Letztes Zeichen löschen', '3']);
    assert.equal(await page.inputValue('#value'), '25,013');
    assert.deepEqual(await page.evaluate(() => [document.activeElement.id, document.activeElement.inputMode]), ['value', 'none']);
    await page.tap('.pad .primary');
    await page.waitForSelector('.verdict[data-verdict="good"]:not([data-provisional])');
    assert.deepEqual((await storedSince()).map((record) => record.measured_mm), [25.013]);
    const seen = () => page.$eval('.verdict', (panel) => panel.getBoundingClientRect().bottom <= innerHeight);
    assert.ok(await seen());
    await page.reload();
    await page.waitForSelector('.pad:visible');
    for (const [width, height] of [[390, 844], [1024, 768], [1366, 768]]) {
      await page.setViewportSize({ width, height });
      assert.deepEqual(await findings(page), [], `${width}`);
      assert.ok(await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth), `${width}`);
      await picture(page, `gauge-pad-${width}`);
    }
    await close(page);
  });

  it('has a minus where a value may be below 0, and there alone', async () => {
    await daemon.send('PUT', '/v1/plans/SIGNED', { characteristics: [{ name: 'offset', nominal_mm: 0, quantity: 'deviation', upper_um: 20, lower_um: -20 }, { name: 'bore', designation: '25 H7' }] });
    const page = await open(browser, daemon, '#/gauge?plan=SIGNED&part_id=SN-1', { locale: 'de-DE' });
    await page.click('.more summary');
    await page.check('[name="pad"]');
    await page.waitForSelector('.tiles-of-plan li');
    await page.waitForSelector('.pad .minus:visible');
    assert.deepEqual(await findings(page), []);
    for (const key of ['Minus', '0', ',', '0', '1', '2']) await page.getByRole('button', { name: key, exact: true }).click();
    assert.equal(await page.inputValue('#value'), '-0,012');
    await page.click('.pad .primary');
    await page.waitForSelector('.pad .minus', { state: 'hidden' }); // the bore
    await page.waitForSelector('.recent li.stored');
    assert.deepEqual((await storedSince()).map((record) => record.measured_mm), [-0.012]);
    await page.click('.recent .fix button:first-child'); // it is corrected as what it is
    await page.waitForSelector('.pad .minus:visible');
    await page.keyboard.press('Escape');
    await page.waitForSelector('.pad .minus', { state: 'hidden' });
    await close(page);
  });
});

describe('a gauge on a serial port', () => {
  it('types its values, whole ones only, and says what it cannot read', async () => {
    const context = await browser.newContext({ locale: 'en-GB', viewport: { width: 1280, height: 800 } });
    // A port as Web Serial has it; `feed` is the gauge. It is opened in the middle of 25.013.
    await context.addInitScript(() => {
      const port = {
        async open(options) {
          globalThis.opened = options;
          port.readable = new ReadableStream({ start: (controller) => { globalThis.feed = (text) => controller.enqueue(new TextEncoder().encode(text)); } });
          globalThis.feed('5.013\r\n');
        },
        async close() { port.readable = null; },
      };
      Object.defineProperty(navigator, 'serial', { value: { requestPort: async () => port, getPorts: async () => [] } });
    });
    const page = await openIn(context, daemon, '#/gauge/25H7');
    await page.waitForSelector('.echo .figures');
    await page.click('.more summary');
    await page.selectOption('[name="serial_baud"]', '4800');
    await page.getByRole('button', { name: 'Connect', exact: true }).click();
    await page.getByRole('button', { name: 'Disconnect' }).waitFor();
    assert.deepEqual(await page.evaluate(() => globalThis.opened), { baudRate: 4800 });
    const feed = (text) => page.evaluate((sent) => globalThis.feed(sent), text);
    const note = (text) => page.waitForFunction((source) => new RegExp(source).test(document.querySelector('#entry-note')?.textContent), text);
    const rows = (count) => page.waitForFunction((wanted) => document.querySelectorAll('.recent li.stored').length === wanted, count);
    await note('may be cut');
    await feed('01A+0025.013\r');
    await rows(1);
    await feed('25,0');
    await feed('11 mm\r\n');
    await rows(2);
    for (const line of ['25.013in', '01A-0025.013', '25.013 25.014', 'ERR 91']) {
        await feed(`${line}\r\n`);
      await note(line.startsWith('01A-') ? 'is not a value' : 'does not match the pattern');
      // The verdict of the value before it stands no more.
      await page.waitForFunction((text) => document.querySelector('.verdict[data-verdict="open"] .measured')?.textContent === text, line.replace('01A', ''));
    }
    const unfold = () => page.$eval('.more', (more) => { more.open = true; });
    await unfold();
    await page.fill('[name="serial_pattern"]', 'D=(\\d+\\.\\d+);OK');
    await page.press('[name="serial_pattern"]', 'Tab');
    await feed('D=25.0123;OK\r\n');
    await rows(3);
    assert.deepEqual((await storedSince()).map((record) => record.measured_mm), [25.013, 25.011, 25.0123]);
    await unfold();
    assert.deepEqual(await findings(page), []);
    await picture(page, 'gauge-serial', { fullPage: true });
    await page.getByRole('button', { name: 'Disconnect' }).click();
    await page.getByRole('button', { name: 'Connect', exact: true }).waitFor();
    await close(page);
  });
});

describe('a value whose beginning nobody saw', () => {
  it('is none: where the page was busy while the port was opened, and after a fault in the middle of it', async () => {
    const context = await browser.newContext({ locale: 'en-GB', viewport: { width: 1280, height: 800 } });
    await context.addInitScript(() => {
      let feed;
      const begin = (text, busy = 0) => {
        const stream = new ReadableStream({ start: (controller) => { feed = controller; } });
        const { getReader } = stream;
        stream.getReader = () => {
          const reader = getReader.call(stream);
          // What is left of 125.013 comes at once; the page reads it when it has time.
          feed.enqueue(new TextEncoder().encode(text));
          for (const until = performance.now() + busy; performance.now() < until;);
          return reader;
        };
        port.readable = stream;
      };
      const port = { open: async () => begin('25.013\r\n', 400), close: async () => { port.readable = null; } };
      globalThis.feed = (text) => feed.enqueue(new TextEncoder().encode(text));
      globalThis.fault = (text) => {
        const broken = feed;
        begin(text);
        broken.error(new DOMException('framing', 'FramingError'));
      };
      Object.defineProperty(navigator, 'serial', { value: { requestPort: async () => port, getPorts: async () => [] } });
    });
    const page = await openIn(context, daemon, '#/gauge/25H7');
    await page.waitForSelector('.echo .figures');
    const note = (text) => page.waitForFunction((source) => document.querySelector('#entry-note')?.textContent.includes(source), text);
    const stored = (count) => page.waitForFunction((wanted) => document.querySelectorAll('.recent li.stored').length === wanted, count);
    await page.click('.more summary');
    await page.getByRole('button', { name: 'Connect', exact: true }).click();
    await note('“25.013” is the first line that was read and may be cut');
    await page.evaluate(() => globalThis.feed('25.011\r\n'));
    await stored(1);
    await page.evaluate(() => { globalThis.feed('1'); globalThis.fault('25.014\r\n'); });
    await note('“25.014” is the first line that was read and may be cut');
    await page.evaluate(() => globalThis.feed('25.012\r\n'));
    await stored(2);
    assert.deepEqual((await storedSince()).map((record) => record.measured_mm), [25.011, 25.012]);
    await close(page);
  });
});

describe('a station with sound', () => {
  it('is silent until it is switched on, then has a sound of its own for each verdict, also after a reload', async () => {
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
      await page.waitForSelector(`.verdict[data-verdict="${verdict}"]:not([data-provisional])`);
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
  });
});
