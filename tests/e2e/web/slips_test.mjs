/**
 * Slips of hands, wires and hours: keys at the wrong moment or in the wrong place, plans left in the middle,
 * proxies, full storage.
 *
 * Tried, and held here:
 * - A plan at its third step: reload, or change the language: goes on where it was, with its marks
 * - Measure the last characteristic first: finished when all are
 * - Forget to scan the next part after *All 3 measured*: not taken: scan, or touch a tile
 * - The service refuses a value of a plan: comes back
 * - Scan the next part with two steps open: *Not measured at SN-2: bore-2, bore-3.*
 * - The plan is changed, or deleted, while a station uses it: asked for with each part
 * - The key is revoked, the dialog stands there, scan `SN-2`, measure: both go to the station
 * - Caps Lock is on, scan `25H7`: refused with the reason
 * - Tap *Part*, then measure instead of scanning; the same at *Correct part*: judged as a value; refused
 * - Choose a rule or tick a box, then measure: a value
 * - Measure while a size is asked for: stays in the field, not stored, said
 * - Ctrl+Z while the last value waits: *not stored yet*
 * - The service away behind a reverse proxy (502): away, judged by the limits held
 * - The browser's storage is full in an outage: said
 * - Type a value, scan `SN-2` before its answer is there: a late verdict is heard and stands in the list; one that
 *   is bad and was not seen is shown
 * - The same, and a value is typed that is asked about: *no verdict yet*
 * - Scan a plan, then the part, before the plan is there: begins with the part that was scanned
 * - Scan another plan, then the part: the plan that was chosen last
 * - Scan a plan before it is known which there are: the plan, once it is known
 * - Scan a size, type another: the one typed last
 * - The service does not say in four seconds what a size is: asked again until they are known
 */

import assert from 'node:assert/strict';
import { afterEach, describe, it } from 'node:test';

import { close, findings, open, openIn, timer } from './support/browser.mjs';
import { Daemon, sleep } from './support/daemon.mjs';
import { eventually } from './support/eventually.mjs';
import { Gate } from './support/gate.mjs';
import { hold, patient } from './support/hold.mjs';
import { known, PAIR_MS, scan as scanInto, scanUnasked, typeSlowly } from './support/scanner.mjs';
import { browser, daemon } from './support/stage.mjs';

let page;

afterEach(() => close(page));

const scan = (text) => scanInto(page, text);
const slow = (text) => typeSlowly(page, text);
const verdict = (word) => page.waitForSelector(`.verdict[data-verdict="${word}"]:not([data-provisional])`);
const notes = (pattern) => page.waitForFunction((source) => new RegExp(source).test(document.getElementById('entry-note').textContent), pattern.source);
const stored = async (order) => {
  await page.waitForSelector('.link[data-state="up"]');
  return (await daemon.stored(`order=${order}&history=all`)).map(({ part_id: part, measured_mm: mm }) => [part, mm]);
};
const echo = (text) => page.waitForFunction((wanted) => document.querySelector('.echo strong')?.textContent === wanted, text);
const openStation = async (query, options) => {
  page = await open(browser, daemon, `#/gauge/25H7?${query}`, options);
  await page.waitForSelector('.echo .figures');
};

/** The service takes its time for the limits of a size. @returns what lets it answer from then on, once it was asked */
async function holdLimits(size) {
  let go;
  let asked = false;
  const told = new Promise((resolve) => { go = resolve; });
  await patient(page);
  await page.route(`**/v1/limits/${size}`, async (route) => {
    asked = true;
    await told;
    await route.continue();
  });
  return async () => {
    while (!asked) await sleep(5);
    go();
  };
}

describe('a key at the wrong moment', () => {
  it('is not lost while a size is asked for: what was typed stays, and Enter takes it once the size is known', async () => {
    await openStation('order=W-ASK');
    let answer = await holdLimits('30k6');
    await scanUnasked(page, '30k6');
    await page.keyboard.type('30.01\n');
    await notes(/Not stored: the characteristic is being loaded/);
    assert.deepEqual([await page.inputValue('#value'), await stored('W-ASK')], ['30.01', []]);
    await answer();
    await echo('Ø 30 k6');
    await page.keyboard.press('Enter');
    await verdict('good');
    assert.deepEqual(await stored('W-ASK'), [[undefined, 30.01]]);
    // Half of a value that was begun before the answer is no value.
    answer = await holdLimits('30k6');
    await scanUnasked(page, '30k6');
    await page.keyboard.type('30.0');
    await answer();
    await known(page);
    await page.keyboard.type('12\n');
    await page.waitForFunction(() => document.querySelectorAll('.recent li.stored').length === 2);
    assert.deepEqual((await stored('W-ASK')).at(-1), [undefined, 30.012]);
  });

  it('asks about a far value also where the size was typed a moment ago', async () => {
    await openStation('order=W-TYPED');
    const answer = await holdLimits('40H7');
    await page.fill('#designation', '40 H7');
    await page.press('#designation', 'Enter');
    await page.keyboard.type('41\n');
    await notes(/Not stored: the characteristic is being loaded/);
    await answer();
    await echo('Ø 40 H7');
    await sleep(PAIR_MS);
    await page.keyboard.press('Enter');
    await page.waitForSelector('.entry.asking');
    assert.deepEqual(await stored('W-TYPED'), []);
  });

  it('corrects no older record while the last value is not stored', async () => {
    await openStation('order=W-UNDO');
    await slow('25.011');
    await verdict('good');
    await page.route('**/v1/measurements', (route) => route.abort());
    await slow('25.0112');
    await page.keyboard.press('Control+z');
    await notes(/not stored yet/);
    assert.equal(await page.$('.entry.correcting'), null);
    await page.unroute('**/v1/measurements');
    await page.waitForFunction(() => document.querySelectorAll('.recent li.stored').length === 2);
    await page.keyboard.press('Control+z');
    await page.waitForSelector('.entry.correcting');
    assert.match(await page.textContent('.entry .label'), /25\.0112/);
  });

  it('leaves a correction a correction over a reload, another language and another view', async () => {
    await openStation('order=W-RESUME');
    await slow('25.019');
    await page.click('.recent .fix button:first-child');
    await page.keyboard.type('25.013');
    const goesOn = async () => {
      await page.waitForSelector('.entry.correcting');
      await page.waitForSelector('.verdict[data-verdict="correcting"]');
      assert.equal(await page.inputValue('#value'), '25.013');
    };
    await page.reload();
    await goesOn();
    for (const language of ['de', 'en']) {
      await page.selectOption('#language', language);
      await page.waitForFunction((wanted) => document.documentElement.lang === wanted, language);
      await goesOn();
    }
    await page.click('#views a[href^="#/tables"]');
    await page.waitForSelector('.grid');
    await page.goBack();
    await goesOn();
    await page.focus('#value');
    await page.keyboard.press('Enter');
    await page.waitForSelector('.recent .corrected');
    assert.deepEqual(await stored('W-RESUME'), [[undefined, 25.019], [undefined, 25.013]]);
    assert.deepEqual((await daemon.stored('order=W-RESUME')).map(({ measured_mm: mm }) => mm), [25.013]);
  });

  it('goes on in the dialog for keys: a revoked key gives no part the value of another', async () => {
    const locked = await new Daemon('--auth', 'read-open').start();
    const [first, second] = [await locked.key('ada', 'operator'), await locked.key('bob', 'operator')];
    page = await open(browser, locked, '#/gauge/25H7');
    await page.waitForSelector('.echo .figures');
    await scan(first);
    await page.waitForFunction(() => /in use/.test(document.querySelector('.badge')?.textContent));
    await scan('SN-1');
    await slow('25.011');
    await verdict('good');
    const used = async () => (await fetch(`${locked.url}/v1/plans`, { headers: { Authorization: `Bearer ${first}` } })).status;
    locked.command('key', 'revoke', '--name', 'ada');
    while (await used() !== 401) await sleep(50);
    await slow('25.0112');
    await page.waitForSelector('dialog[open]');
    await scan('SN-2');
    await page.waitForFunction(() => /begins with fg_/.test(document.querySelector('dialog .note')?.textContent));
    assert.equal(await page.inputValue('[name="part_id"]'), 'SN-2');
    await scan('25.012');
    await page.keyboard.type(`${second}\n`);
    await page.waitForSelector('dialog', { state: 'detached' });
    await page.click('.badge >> text=Store with the key in use');
    await page.waitForFunction(() => document.querySelectorAll('.recent li.stored').length === 3);
    const { measurements } = await (await fetch(`${locked.url}/v1/measurements`, { headers: { Authorization: `Bearer ${second}` } })).json();
    assert.deepEqual(measurements.map(({ part_id: part, measured_mm: mm }) => [part, mm]), [['SN-1', 25.011], ['SN-2', 25.012], ['SN-1', 25.0112]]);
    await locked.cleanup();
  });
});

describe('an answer that comes late', () => {
  const said = () => page.textContent('.verdict .word');
  const storedRows = (count) => page.waitForFunction((wanted) => document.querySelectorAll('.recent li.stored').length === wanted, count);

  it('is no verdict of the part that was scanned meanwhile, nor of a value that is asked about, and a bad one is seen', async () => {
    await openStation('order=W-LATE&part_id=SN-1');
    const answer = await hold(page, '**/v1/measurements');
    await slow('25.011');
    await scan('SN-2');
    assert.equal(await said(), 'Measure SN-2');
    await timer(page, 200); // longer than a value waits before it is said that it does
    assert.equal(await said(), 'Measure SN-2');
    await answer();
    await storedRows(1);
    assert.equal(await said(), 'Measure SN-2', 'SN-2 is not measured');
    await slow('25.012');
    await slow('250.12');
    await page.waitForSelector('.entry.asking');
    await answer();
    await storedRows(2);
    assert.equal(await page.getAttribute('.verdict', 'data-verdict'), 'open', 'nothing was said of 250.12');
    await page.keyboard.press('Escape');
    await slow('25.013');
    await answer();
    await verdict('good');
    // The service says otherwise than the page did: that has to be seen.
    await page.unroute('**/v1/measurements');
    const judged = await (await fetch(`${daemon.url}/v1/measurements?order=W-LATE&limit=1`)).json();
    let go;
    const known = new Promise((resolve) => { go = resolve; });
    await page.route('**/v1/measurements', async (route) => {
      await known;
      await route.fulfill({ status: 201, json: { ...judged.measurements[0], id: 'other', verdict: 'reject', measured_mm: 25.014, part_id: 'SN-2' } });
    }, { times: 1 });
    await slow('25.014');
    await scan('SN-3');
    assert.equal(await said(), 'Measure SN-3');
    go();
    await verdict('reject');
    assert.match(await page.textContent('.verdict .about'), /SN-2/);
    assert.deepEqual(await stored('W-LATE'), [['SN-1', 25.011], ['SN-2', 25.012], ['SN-2', 25.013]]);
  });

  it('of a plan begins with the part that was scanned meanwhile, and no other plan takes its place', async () => {
    await openStation('order=W-PLAN');
    for (const name of ['LATE-7', 'LATE-8']) {
      await daemon.send('PUT', `/v1/plans/${name}`, { characteristics: [{ name: `${name}-1`, designation: '25 H7' }] });
    }
    const tell = await hold(page, '**/v1/plans');
    const go = await hold(page, '**/v1/plans/*');
    await page.reload();
    await page.waitForSelector('.echo .figures');
    await page.focus('#value');
    await scanUnasked(page, 'LATE-7'); // before it is known which plans there are
    await tell();
    await page.waitForSelector('.plan[aria-busy]');
    await scanUnasked(page, 'SN-1');
    await go();
    await known(page);
    await slow('25.001');
    await slow('25.002'); // the scan of the next part was forgotten
    await notes(/Not stored.*All of SN-1 is measured/);
    await page.keyboard.press('Escape');
    await scanUnasked(page, 'LATE-8');
    await scanUnasked(page, 'SN-2');
    await go();
    await known(page);
    assert.equal(await page.inputValue('.plan select'), 'LATE-8');
    await slow('25.003');
    await verdict('good');
    const records = await daemon.stored('order=W-PLAN');
    assert.deepEqual(records.map(({ part_id: part, characteristic, measured_mm: mm }) => [part, characteristic, mm]), [['SN-1', 'LATE-7-1', 25.001], ['SN-2', 'LATE-8-1', 25.003]]);
  });

  it('puts no size that was scanned over one that was typed since', async () => {
    await openStation('order=W-SIZE');
    const answer = await holdLimits('30k6');
    await scanUnasked(page, '30k6');
    await page.fill('#designation', '40 H7');
    await echo('Ø 40 H7');
    await answer();
    await known(page);
    assert.equal(await page.inputValue('#designation'), '40 H7');
    await page.focus('#value');
    await slow('40.01');
    await verdict('good');
    assert.deepEqual((await daemon.stored('order=W-SIZE')).map(({ designation }) => designation), ['40 H7']);
  });
});

describe('an answer that does not come', () => {
  it('is asked for again: a size is known once the service says it', async () => {
    let asked = 0;
    page = await open(browser, daemon, '#/gauge?order=W-AGAIN');
    await page.route('**/v1/limits/45h6', (route) => (asked++ ? route.continue() : route.abort()));
    await page.fill('#designation', '45h6');
    await echo('Ø 45 h6');
    assert.ok(asked >= 2);
  });
});

describe('a key in the wrong place', () => {
  it('reaches the value from a choice and a tick', async () => {
    await openStation('order=W-CHOICE');
    await page.click('.more summary');
    for (const [i, place] of ['[name="rule"]', '[name="sound"]'].entries()) {
      await page.$eval('.more', (more) => { more.open = true; });
      await page.focus(place);
      await slow(`25.01${i}`);
      await page.waitForFunction((count) => document.querySelectorAll('.recent li.stored').length === count, i + 1);
    }
    assert.equal(await page.inputValue('[name="rule"]'), 'simple');
    assert.deepEqual((await stored('W-CHOICE')).map(([, mm]) => mm), [25.01, 25.011]);
  });

  it('names no part by a value: it is judged where its line was ended, and shown where it was not', async () => {
    await openStation('order=W-NAME');
    await scan('SN-1');
    await page.click('[name="part_id"]');
    await page.keyboard.type('25.013\n');
    await verdict('good');
    assert.equal(await page.inputValue('[name="part_id"]'), 'SN-1');
    assert.deepEqual(await stored('W-NAME'), [['SN-1', 25.013]]);
    await page.click('[name="part_id"]');
    await page.keyboard.type('25.0');
    await page.click('.verdict');
    await notes(/is a value, not a name/);
    assert.deepEqual([await page.inputValue('[name="part_id"]'), await page.inputValue('#value')], ['SN-1', '25.0']);
    await page.keyboard.press('Escape');
    await page.getByRole('button', { name: 'Correct the part SN-1' }).click();
    await slow('25.012');
    await notes(/is a value, not a name/);
    await slow('4711.5'); // far from any value of this size
    await page.waitForSelector('.recent .corrected');
    assert.deepEqual(await stored('W-NAME'), [['SN-1', 25.013], ['4711.5', 25.013]]);
    assert.deepEqual(await findings(page), []);
  });

  it('takes no scan whose capitals Caps Lock has made small', async () => {
    await openStation('order=W-CAPS');
    const lock = (on) => page.evaluate((value) => { KeyboardEvent.prototype.getModifierState = (name) => value && name === 'CapsLock'; }, on);
    await lock(true);
    await scan('25h7');
    await notes(/Caps Lock is on/);
    await scan('sn-1');
    await notes(/Caps Lock is on/);
    assert.deepEqual([await page.textContent('.echo strong'), await page.inputValue('[name="part_id"]')], ['Ø 25 H7', '']);
    await slow('25.013');
    await verdict('good');
    await lock(false);
    await scan('25h7');
    await echo('Ø 25 h7');
    assert.equal((await stored('W-CAPS')).length, 1);
  });
});

describe('a plan left in the middle', () => {
  const PLAN = { characteristics: ['bore-1', 'bore-2', 'bore-3'].map((name) => ({ name, designation: '25 H7' })) };
  const progress = (text) => page.waitForFunction((wanted) => document.querySelector('.plan:not([aria-busy]) .progress')?.textContent === wanted, text);
  const measured = async (order) => {
    await page.waitForSelector('.link[data-state="up"]');
    return (await daemon.stored(`order=${order}`)).map(({ part_id: part, characteristic, measured_mm: mm }) => [part, characteristic, mm]);
  };
  const begin = async (part, query) => {
    await daemon.send('PUT', `/v1/plans/${part}`, PLAN);
    page = await open(browser, daemon, `#/gauge?plan=${part}&${query}`);
    await progress('1 of 3');
    await page.waitForSelector('.echo .figures');
    await page.focus('#value');
  };
  const tile = (at) => page.click(`.tiles-of-plan li:nth-child(${at}) button`);

  it('goes on where it was after a reload and in another language', async () => {
    await begin('RELOAD', 'order=W-RELOAD');
    await scan('SN-1');
    await progress('1 of 3');
    await slow('25.001');
    await progress('2 of 3');
    await page.waitForSelector('.tiles-of-plan .shape');
    await page.reload();
    await progress('2 of 3');
    assert.equal(await page.$$eval('.tiles-of-plan .shape', (shapes) => shapes.length), 1);
    await page.waitForSelector('.echo .figures');
    await slow('25.002');
    await progress('3 of 3');
    await page.selectOption('#language', 'de');
    await progress('3 von 3');
    await page.waitForSelector('.echo .figures');
    await slow('25.003');
    await progress('Alle 3 gemessen');
    assert.deepEqual(await measured('W-RELOAD'), [['SN-1', 'bore-1', 25.001], ['SN-1', 'bore-2', 25.002], ['SN-1', 'bore-3', 25.003]]);
    await page.selectOption('#language', 'en');
    await progress('All 3 measured');
  });

  it('goes on at its characteristic, by name, where the plan was changed before the reload', async () => {
    await begin('MOVED', 'order=W-MOVED');
    await scan('SN-1');
    await slow('25.001');
    await progress('2 of 3');
    const reloadWith = async (names, current) => {
      await daemon.send('PUT', '/v1/plans/MOVED', { characteristics: names.map((name) => ({ name, designation: '25 H7' })) });
      await page.reload();
      await page.waitForFunction((wanted) => document.querySelector('.tiles-of-plan [aria-current] span:not(.unseen)')?.textContent === wanted, current);
    };
    await reloadWith(['bore-0', 'bore-1', 'bore-2', 'bore-3'], 'bore-2');
    await reloadWith(['bore-1', 'bore-0', 'bore-3'], 'bore-0'); // there is no bore-2 any more: the first that is due
  });

  it('is finished when everything is measured, in any order, and takes no further value for the same part', async () => {
    await begin('ORDER', 'order=W-ORDER');
    await scan('SN-1');
    await progress('1 of 3');
    await tile(3);
    await slow('25.003');
    await progress('1 of 3');
    await slow('25.001');
    await progress('2 of 3');
    await slow('25.002');
    await progress('All 3 measured');
    await slow('25.004'); // the scan of the next part was forgotten
    await notes(/Not stored.*All of SN-1 is measured/);
    await tile(2);
    await progress('2 of 3');
    await page.focus('#value');
    await sleep(PAIR_MS);
    await page.keyboard.press('Enter');
    await progress('All 3 measured');
    await page.waitForFunction(() => document.querySelectorAll('.recent li.stored').length === 4);
    assert.deepEqual(await measured('W-ORDER'), [['SN-1', 'bore-3', 25.003], ['SN-1', 'bore-1', 25.001], ['SN-1', 'bore-2', 25.002], ['SN-1', 'bore-2', 25.004]]);
  });

  it('comes back to what the service has refused, and says what was left out at a part', async () => {
    await begin('LEFT', 'order=W-LEFT');
    await scan('SN-1');
    await progress('1 of 3');
    await page.route('**/v1/measurements', (route) => route.fulfill({ status: 422, contentType: 'application/problem+json', body: '{"code":"request.invalid","detail":"no"}' }), { times: 1 });
    await slow('25.001');
    await page.waitForSelector('.recent li.refused');
    await progress('2 of 3');
    for (const [value, text] of [['25.002', '3 of 3'], ['25.003', '1 of 3'], ['25.001', 'All 3 measured']]) {
      await slow(value);
      await progress(text);
    }
    await scan('SN-2');
    await progress('1 of 3');
    assert.equal(await page.textContent('.of-plan'), '');
    await slow('25.004');
    await progress('2 of 3');
    await scan('SN-3');
    await page.waitForFunction(() => document.querySelector('.of-plan')?.textContent === 'Not measured at SN-2: bore-2, bore-3.');
    assert.deepEqual(await findings(page), []);
    await slow('25.005');
    await progress('2 of 3');
    assert.deepEqual((await measured('W-LEFT')).map(([part, name]) => `${part} ${name}`), ['SN-1 bore-2', 'SN-1 bore-3', 'SN-1 bore-1', 'SN-2 bore-1', 'SN-3 bore-1']);
  });

  it('is asked for again with each part, and missed when it is gone', async () => {
    await begin('NEW', 'order=W-NEW');
    await scan('SN-1');
    await progress('1 of 3');
    await daemon.send('PUT', '/v1/plans/NEW', { characteristics: [{ name: 'bore-1', designation: '25 G7' }] });
    await scan('SN-2');
    await progress('1 of 1');
    await echo('Ø 25 G7');
    await slow('25.006');
    await verdict('rework');
    await daemon.send('DELETE', '/v1/plans/NEW');
    await scan('SN-3');
    await page.waitForFunction(() => /no plan NEW/.test(document.querySelector('.of-plan')?.textContent));
    assert.ok(await page.isVisible('.of-plan'));
  });
});

describe('an outage', () => {
  it('is one also behind a reverse proxy that answers for the service', async () => {
    const own = await new Daemon().start();
    const gate = await new Gate(own).open();
    page = await open(browser, gate, '#/gauge/25H7');
    await page.waitForSelector('.echo .figures');
    await own.stop();
    await page.waitForSelector('.link[data-state="away"]');
    let changes = 0;
    await page.exposeFunction('changed', () => { changes += 1; });
    await page.$eval('#link', (link) => new MutationObserver(() => globalThis.changed()).observe(link, { attributes: true, attributeFilter: ['data-state'] }));
    await slow('25.03');
    await page.waitForSelector('.verdict[data-verdict="reject"][data-provisional="away"]');
    await scan('30k6'); // never asked for
    await notes(/Not stored/);
    const answered = { GET: 0, POST: 0 };
    page.on('response', (answer) => { answered[answer.request().method()] += answer.status() === 502; });
    await eventually(() => assert.ok(answered.GET > 2 && answered.POST > 2, JSON.stringify(answered)));
    assert.equal(await page.getAttribute('#link', 'data-state'), 'away');
    assert.ok(changes <= 2, `it went and came ${changes} times`);
    await own.start();
    await page.waitForFunction(() => /1 stored after the outage: 1 reject/.test(document.querySelector('.arrived')?.textContent));
    gate.close();
    await own.cleanup();
  });

  it('says where the browser has no room for what waits', async () => {
    await openStation('order=W-FULL', { serviceWorkers: 'allow' });
    await page.waitForFunction(() => navigator.serviceWorker.controller);
    await page.evaluate(() => { Storage.prototype.setItem = () => { throw new DOMException('full', 'QuotaExceededError'); }; });
    await page.route(/\/(v1|livez)/, (route) => route.abort());
    await slow('25.01');
    await page.waitForFunction(() => /no space for the waiting values/.test(document.querySelector('.unkept')?.textContent));
    await page.unroute(/\/(v1|livez)/);
    await page.waitForFunction(() => document.querySelector('.unkept')?.textContent === '');
    assert.equal((await stored('W-FULL')).length, 1);
  });
});
