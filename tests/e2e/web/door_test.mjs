/**
 * One door for keys: a scan or a gauge that reaches any field of the station is read whole, and never taken for
 * what it is not.
 *
 * Tried, and held here:
 * - Scan `2009`, wait, Enter: not stored
 * - Scan a part or measure into *Something else*: a part, a value that waits for the cause
 * - `01A+00025.015` by a wedge: 25.015 mm
 * - `PÖSN-2006`, `https://ex.org/p/SN-2011`: asked about
 * - End a plan with a good value after a reject: *Reject*, with the name of the characteristic
 * - Ctrl+Z, then the next bore: amber, with the old value and its size
 * - A bar with a machine, then a tap on a characteristic: of that machine
 * - Open the page on a slow line, scan a part at once, then measure: of that part
 * - A program that probes, as a drawing: all are; computed styles of every view are compared
 */

import assert from 'node:assert/strict';
import { before, beforeEach, describe, it } from 'node:test';

import { close, findings, open, picture } from './support/browser.mjs';
import { sleep } from './support/daemon.mjs';
import { hold } from './support/hold.mjs';
import { answer } from './support/reactions.mjs';
import { known, PAIR_MS, scan, scanUnasked, typeSlowly } from './support/scanner.mjs';
import { begin, browser, daemon, storedSince } from './support/stage.mjs';

describe('the door for keys', () => {
  let page;

  before(async () => {
    await daemon.send('PUT', '/v1/catalogues/turning', { causes: ['Insert worn'], measures: ['Insert changed'] });
    await daemon.send('PUT', '/v1/plans/4711-A', { characteristics: [{ name: 'bore-A', designation: '25 H7', catalogue: 'turning' }, { name: 'bore-B', designation: '40 H8' }] });
  });
  beforeEach(begin);

  const station = async (fragment = '#/gauge/25H7') => {
    page = await open(browser, daemon, fragment);
    await known(page);
    await page.waitForSelector('.echo .figures');
    await page.focus('#value');
  };
  const part = () => page.inputValue('[name="part_id"]');
  const notes = (text) => page.waitForFunction((source) => new RegExp(source).test(document.querySelector('#entry-note').textContent), text.source);
  const measured = async () => (await storedSince()).map(({ part_id, measured_mm }) => [part_id, measured_mm]);
  const asks = async (text) => assert.match(await page.textContent('.verdict .question'), text);
  const stored = (count) => page.waitForFunction((rows) => document.querySelectorAll('.recent li.stored').length === rows, count);

  it('reads what gauges of Mitutoyo, Mahr, Sylvac and Tesa send, wherever the caret is', async () => {
    await station('#/gauge/25H7?part_id=SN-1');
    const lines = ['01A+00025.015', '+025.014', '25.013 mm', '1 +25.012 mm =', '+25.011<'];
    for (const [i, line] of lines.entries()) {
      if (i % 2) await page.focus('[name="part_id"]');
      await scan(page, line);
      await stored(i + 1);
    }
    assert.deepEqual(await measured(), [25.015, 25.014, 25.013, 25.012, 25.011].map((mm) => ['SN-1', mm]));
    for (const [line, why] of [['ERR3', /Not stored.*error of the gauge/], ['0.98476in', /Not stored.*inches/], ['01A-00025.015', /Not stored/]]) {
      await page.focus('[name="part_id"]');
      await scan(page, line);
      await notes(why);
      assert.equal(await part(), 'SN-1', line);
      await page.keyboard.press('Escape');
    }
    assert.equal((await measured()).length, lines.length);
    await close(page);
  });

  it('takes no scan and no value for a cause', async () => {
    await station('#/gauge?plan=4711-A&part_id=SN-2');
    await scan(page, '25.03');
    await page.waitForSelector('.reactions .catalogue');
    await page.focus('.reactions input');
    await scan(page, 'SN-6003');
    assert.equal(await part(), 'SN-6003');
    await page.focus('.reactions input');
    await scan(page, '25.012');
    await notes(/Not stored.*cause and action/);
    await page.focus('.reactions input');
    await typeSlowly(page, '25.012'); // a gauge with slow keys, while the next size is 40 H8
    await notes(/Not stored.*cause and action/);
    assert.equal(await page.inputValue('#value'), '25.012');
    assert.match(await page.textContent('.reactions .label'), /cause/);
    await page.focus('.reactions input');
    await typeSlowly(page, 'Chip in the bore');
    await answer(page, 'Insert changed');
    await page.waitForSelector('.recent .noted');
    assert.equal(await page.textContent('.recent .noted'), 'Chip in the bore → Insert changed');
    await close(page);
  });

  it('asks about a scan that another layout of keys may have made, and names no part by the kind of a code', async () => {
    await station();
    await scan(page, ']C1SN-2010');
    assert.equal(await part(), 'SN-2010');
    for (const [i, [text, name]] of [['PÖSN-2006', 'PÖSN-2006'], ['SNß2007', 'SNß2007'], ['https://ex.org/p/SN-2011', 'SN-2011']].entries()) {
      if (i % 2) await page.focus('[name="part_id"]');
      await scan(page, `${text}\n`); // the second Enter of a pair is no answer
      await asks(new RegExp(`Part: is ${name} right`));
      assert.equal(await part(), 'SN-2010');
      await sleep(PAIR_MS);
      await page.keyboard.press('Enter');
      await page.waitForSelector('.verdict[data-verdict="idle"]');
    }
    assert.equal(await part(), 'SN-2010');
    await scan(page, 'https://ex.org/p/SN-2011');
    await page.click('.answers >> text=Part SN-2011');
    assert.equal(await part(), 'SN-2011');
    await page.focus('[name="part_id"]');
    await scan(page, 'O:WO-17'); // its prefix names another field
    assert.deepEqual([await part(), await page.inputValue('[name="order"]')], ['SN-2011', 'WO-17']);
    await close(page);
  });

  it('asks about a scan that is no number of the plan, in its field too, and takes one that is', async () => {
    await daemon.send('PUT', '/v1/plans/PATTERN-1', { part_pattern: 'SN-####', characteristics: [{ name: 'bore-A', designation: '25 H7' }] });
    await station('#/gauge?plan=PATTERN-1');
    await page.waitForSelector('.tiles-of-plan li');
    await scan(page, 'SN-2010');
    assert.equal(await part(), 'SN-2010');
    for (const [at, text] of [[null, 'SN-20101'], [null, 'P:LOT-2010'], ['[name="part_id"]', 'SN-201'], ['[name="part_id"]', '9999999']]) {
      if (at) await page.focus(at);
      await scan(page, text);
      await asks(new RegExp(`Part: is ${text.replace('P:', '')} right\\? Numbers of this plan are SN-####`));
      await sleep(PAIR_MS);
      await page.keyboard.press('Enter');
      await page.waitForSelector('.verdict[data-verdict="idle"]');
      assert.equal(await part(), 'SN-2010');
    }
    await scan(page, 'LOT-2011');
    await page.click('.answers >> text=Part LOT-2011');
    assert.equal(await part(), 'LOT-2011');
    await close(page);
  });

  it('corrects a part by the same door', async () => {
    await station('#/gauge/25H7?part_id=SN-20');
    await scan(page, '25.01');
    await stored(1);
    const corrects = () => page.getByRole('button', { name: 'Correct the part SN-20' }).click();
    await corrects();
    for (const [line, why] of [['01A+00025.015', /is a value/], ['O:WO-17', /Not stored/], ['P:SN-20', /have not changed/]]) {
      await scan(page, line);
      await notes(why);
    }
    await scan(page, 'SNß21');
    await page.click('.answers >> text=No, scan again'); // and it is still corrected
    await page.waitForSelector('.entry.correcting');
    await scan(page, ']C1SN-21');
    await page.waitForSelector('.recent li.corrected');
    await page.waitForSelector('.link[data-state="up"]');
    assert.deepEqual((await storedSince()).map(({ part_id, correction_of }) => [part_id, Boolean(correction_of)]), [['SN-20', false], ['SN-21', true]]);
    await close(page);
  });

  it('asks about a scan into another field as of that field, and corrects no record by it', async () => {
    await station('#/gauge/25H7?part_id=SN-22&order=T4');
    await scan(page, '25.019');
    await stored(1);
    await page.click('.recent .fix button:first-child');
    await page.click('.more summary');
    await page.focus('[name="order"]');
    await scan(page, 'WÖ-18');
    await asks(/^Order: is WÖ-18 right\?$/);
    await page.click('.answers >> text=Order WÖ-18');
    assert.equal(await page.inputValue('[name="order"]'), 'WÖ-18');
    await page.waitForSelector('.entry.correcting'); // goes on
    await scan(page, '25.0190');
    await notes(/Value and part have not changed/);
    await scan(page, '25.013');
    await page.waitForSelector('.recent li.corrected');
    await page.waitForSelector('.link[data-state="up"]');
    assert.deepEqual((await daemon.stored('part_id=SN-22&history=all')).map(({ measured_mm, order }) => [measured_mm, order]), [[25.019, 'T4'], [25.013, 'T4']]);
    await close(page);
  });

  it('says in the panel that a scan has changed the size', async () => {
    await station();
    await scan(page, '12A9');
    await page.waitForFunction(() => document.querySelector('.verdict .word')?.textContent === 'Now Ø 12 A9');
    await close(page);
  });

  it('stores nothing far outside by Enter, asks large, and offers inches', async () => {
    await station('#/gauge/25H7?part_id=SN-3');
    await page.setViewportSize({ width: 1366, height: 768 });
    await scan(page, '2009');
    await asks(/2009 mm is far outside Ø 25 H7. Not stored/);
    const sizes = await page.$eval('.verdict', (panel) => [parseFloat(getComputedStyle(panel.querySelector('.question')).fontSize),
      ...[...panel.querySelectorAll('.answers button')].map((button) => button.getBoundingClientRect().height), innerHeight - panel.querySelector('.answers').getBoundingClientRect().bottom]);
    assert.ok(sizes[0] >= 48 && sizes.slice(1, -1).every((height) => height >= 64) && sizes.at(-1) >= 0, sizes.join());
    assert.deepEqual(await findings(page), []);
    await picture(page, 'gauge-question');
    await sleep(PAIR_MS);
    await page.keyboard.press('Enter');
    await page.waitForSelector('.verdict[data-verdict="idle"]');
    await scan(page, '0.98476');
    await page.click('.answers >> text=Inches: store 25.012904 mm');
    await stored(1);
    assert.deepEqual(await measured(), [['SN-3', 25.012904]]);
    // A verdict that comes late waits for the answer.
    await scan(page, '2009');
    await daemon.send('POST', '/v1/measurements', { designation: '25 H7', measured_mm: '25.01' });
    await asks(/2009 mm/);
    await page.keyboard.press('Escape');
    await page.waitForSelector('.verdict[data-verdict="idle"]');
    await close(page);
  });

  it('ends a question when another thing is gauged: its line is read anew', async () => {
    await station('#/gauge?plan=4711-A&part_id=SN-40');
    const ended = async (line, act) => {
      await page.focus('#value');
      await scan(page, line);
      await asks(/far outside/);
      await act();
      await page.waitForSelector('.answers', { state: 'detached' });
      await notes(/Not stored/);
      assert.equal(await page.inputValue('#value'), line);
    };
    const field = (name, text) => async () => {
      if (name !== 'part_id') await page.click('.more summary');
      await page.fill(`[name="${name}"]`, text);
      await page.press(`[name="${name}"]`, 'Tab');
    };
    await ended('40.01', field('part_id', 'SN-41'));
    for (const name of ['order', 'gauge', 'operator']) await ended('40.01', field(name, 'X-1'));
    await ended('40.01', () => page.fill('#designation', '41 H8'));
    await ended('40.01', () => page.selectOption('.plan select', ''));
    await page.selectOption('.plan select', '4711-A');
    await known(page);
    await ended('40.01', () => page.click('.tiles-of-plan li:nth-child(2) button'));
    assert.deepEqual(await storedSince(), []);
    await page.focus('#value');
    await sleep(PAIR_MS);
    await page.keyboard.press('Enter');
    await stored(1);
    assert.deepEqual((await storedSince()).map(({ part_id, characteristic, confirmed }) => [part_id, characteristic, confirmed]), [['SN-41', 'bore-B', undefined]]);
    // While a size is not known the answer is none.
    await page.click('.tiles-of-plan li:nth-child(1) button');
    await page.focus('#value');
    await scan(page, '0.98476');
    await asks(/far outside/);
    await page.evaluate(() => {
      const size = document.querySelector('#designation');
      size.value = '';
      size.dispatchEvent(new InputEvent('input', { bubbles: true }));
      [...document.querySelectorAll('.answers button')].find((one) => one.textContent.startsWith('Inches')).click();
    });
    await page.waitForSelector('.entry.refusing');
    assert.equal((await storedSince()).length, 1);
    await close(page);
  });

  it('loses nothing that is scanned while the page is on its way', async () => {
    await station();
    const onItsWay = async () => {
      const arrives = await hold(page, '**/app.js');
      await page.evaluate(() => { setTimeout(() => location.reload()); });
      await page.waitForSelector('#value', { state: 'detached' });
      await page.waitForSelector('.bar');
      return arrives;
    };
    const arrives = await onItsWay();
    await scanUnasked(page, 'SN-31');
    await arrives();
    await page.waitForFunction(() => document.querySelector('[name="part_id"]')?.value === 'SN-31');
    await scan(page, '25.013');
    await stored(1);
    assert.deepEqual(await measured(), [['SN-31', 25.013]]);
    // A line that was not ended is ended later.
    const again = await onItsWay();
    for (const key of '25.0') await page.keyboard.press(key);
    await again();
    await known(page);
    await page.waitForSelector('.echo .figures');
    await page.keyboard.type('14\n');
    await stored(2);
    assert.deepEqual(await measured(), [['SN-31', 25.013], ['SN-31', 25.014]]);
    // Enter ends no line from before the reload that nobody has seen yet.
    await page.keyboard.type('P:SN-3');
    const arrivesLast = await onItsWay();
    await page.keyboard.press('Enter');
    await arrivesLast();
    await page.waitForSelector('.echo .figures');
    assert.deepEqual([await page.inputValue('#value'), await page.inputValue('[name="part_id"]')], ['P:SN-3', 'SN-31']);
    await page.keyboard.type('25.015\n');
    await stored(3);
    assert.deepEqual((await measured()).at(-1), ['SN-31', 25.015]);
    await close(page);
  });

  it('says by a test code whether layout and prefix of a scanner are right', async () => {
    await station();
    await scan(page, 'FITGAUGE-TEST:Yz_/+09');
    assert.match(await page.textContent('.verdict'), /Scanner right/);
    await scan(page, 'P:FITGAUGE-TEST:Yz_/+09');
    assert.match(await page.textContent('.verdict'), /Scanner right.*P: \(Part\)/);
    await page.focus('[name="part_id"]');
    await scan(page, 'FITGAUGEßTESTÖZy?-*09');
    assert.match(await page.textContent('.verdict'), /Scanner wrong.*- comes as ß · : comes as Ö/);
    assert.equal(await part(), '');
    assert.match(await page.textContent('.more'), /FITGAUGE-TEST:Yz_\/\+09/);
    await close(page);
  });
});
