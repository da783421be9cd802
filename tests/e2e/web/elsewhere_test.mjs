/**
 * What other places do with a part of this station: while its page is open, while it is closed, and before its own
 * answer has come. The station ends with the verdict of the record, and asks for nothing that was done.
 */

import assert from 'node:assert/strict';
import { before, beforeEach, describe, it } from 'node:test';

import { close, open, openIn } from './support/browser.mjs';
import { eventually } from './support/eventually.mjs';
import { answer } from './support/reactions.mjs';
import { known, scan } from './support/scanner.mjs';
import { begin, browser, daemon, storedSince } from './support/stage.mjs';

describe('a part that is handled elsewhere', () => {
  let page;

  before(() => daemon.send('PUT', '/v1/catalogues/turning', { causes: ['Insert worn', 'Wrong offset'], measures: ['Insert changed', 'Part scrapped'] }));
  beforeEach(async () => {
    await begin();
    await daemon.send('PUT', '/v1/plans/4711-A', { characteristics: [
      { name: 'bore-A', designation: '25 H7', catalogue: 'turning' }, { name: 'bore-B', designation: '40 H8', reaction: 'Stop, tell the setter' }, { name: 'length', nominal_mm: 120, feature: 'shaft', upper_um: 300, lower_um: -300 }] });
  });

  const address = (part) => `#/gauge?plan=4711-A&part_id=${part}`;
  const ready = async () => {
    await page.waitForSelector('.tiles-of-plan li');
    await known(page);
    await page.waitForSelector('.echo .figures');
  };
  const station = async (part) => {
    page = await open(browser, daemon, address(part));
    await ready();
  };
  /** The page is closed, `act` is done, and another one of this browser is opened. */
  const closedFor = async (part, act) => {
    const context = page.context();
    await page.close();
    await act();
    page = await openIn(context, daemon, address(part));
    await ready();
  };
  const line = (text) => scan(page, text);
  const says = (source) => page.waitForFunction((text) => new RegExp(text).test(document.querySelector('.verdict:not([data-provisional])')?.textContent), source);
  const hidden = () => page.waitForSelector('.reactions', { state: 'hidden' });
  const store = async (part, fields) => (await daemon.send('POST', '/v1/measurements', { part_id: part, characteristic: 'bore-A', designation: '25 H7', machine: 'M2', ...fields })).json();
  const correct = (id, mm) => daemon.send('POST', `/v1/measurements/${id}/corrections`, { measured_mm: mm, reason: 'slip' });
  const say = (id) => daemon.send('POST', `/v1/measurements/${id}/notes`, { cause: 'Wrong offset', measure: 'Part scrapped' });
  const storedOf = (part, count) => eventually(async () => {
    const all = (await storedSince()).filter((record) => record.part_id === part);
    assert.equal(all.length, count);
    return all;
  });
  const verdictOf = async (part) => (await daemon.json(`/v1/parts/${part}?plan=4711-A`)).verdict;

  it('has its cause before the answer to its value has come', async () => {
    await station('E-1');
    let go;
    const told = new Promise((resolve) => { go = resolve; });
    await page.route('**/v1/measurements', async (route) => {
      const response = await route.fetch();
      await told;
      await route.fulfill({ response });
    });
    await line('25.04');
    await page.waitForSelector('.reactions .catalogue');
    const [{ id }] = await storedOf('E-1', 1);
    await say(id);
    go();
    await hidden();
    await line('40.01');
    await page.waitForFunction(() => document.querySelectorAll('.recent .stored').length === 2);
    await close(page);
  });

  it('has its cause, or a better value, while the page is closed', async () => {
    await station('E-2');
    await line('25.04');
    await page.waitForSelector('.recent .stored');
    const [{ id }] = await storedOf('E-2', 1);
    await closedFor('E-2', () => say(id));
    await hidden();
    await line('40.05');
    await page.waitForFunction(() => document.querySelectorAll('.recent .stored').length === 1);
    await page.waitForSelector('.reactions .primary');
    const [, second] = await storedOf('E-2', 2);
    await closedFor('E-2', () => correct(second.id, 40.01));
    await hidden();
    await line('120.1');
    await says('RejectPart E-2 · bore-A Reject');
    await close(page);
  });

  it('says in the record that a reaction without a catalogue was done', async () => {
    await station('E-3');
    await line('25.01');
    await line('40.05');
    await answer(page, 'Done');
    await hidden();
    const [, { id }] = await storedOf('E-3', 2);
    await eventually(async () => assert.deepEqual((await daemon.json(`/v1/measurements/${id}/notes`)).notes.map(({ text }) => text), ['Stop, tell the setter']));
    assert.deepEqual((await daemon.json('/v1/parts/E-3?plan=4711-A')).open_reactions, []);
    await page.waitForFunction(() => /Stop, tell the setter/.test(document.querySelector('.recent .noted')?.textContent));
    await close(page);
  });

  it('ends with the verdict of the record: of another station, of a correction, of a characteristic that the plan had', async () => {
    await station('E-4');
    for (const value of ['25.01', '40.01', '120.1']) await line(value);
    await says('GoodPart E-4All 3 measured');
    await store('E-4', { measured_mm: 25.04 });
    await says('RejectPart E-4 · bore-A Rejectbore-A 25\\.040 mm · Reject');
    await store('E-4', { measured_mm: 25.012 }); // measured last: it counts
    await says('GoodPart E-4All 3 measured');
    assert.equal(await verdictOf('E-4'), 'good');
    const [, second] = await storedOf('E-4', 5);
    await closedFor('E-4', () => correct(second.id, 40.05));
    await says('RejectPart E-4 · bore-B Reject');
    await page.waitForSelector('.tiles-of-plan li:nth-child(2) [data-verdict="reject"]');
    assert.equal(await verdictOf('E-4'), 'reject');
    await closedFor('E-4', () => daemon.send('PUT', '/v1/plans/4711-A', { characteristics: [{ name: 'bore-A', designation: '25 H7' }, { name: 'length', nominal_mm: 120, feature: 'shaft', upper_um: 300, lower_um: -300 }] }));
    await says('RejectPart E-4 · bore-B Reject');
    assert.equal(await verdictOf('E-4'), 'reject');
    await close(page);
  });

  it('says that nobody can ask about a part whose name a browser folds', async () => {
    await station('..');
    for (const value of ['25.01', '40.01', '120.1']) await line(value);
    await page.waitForFunction(() => /GoodPart \.\.All 3 measuredNo browser can open an address with the part/.test(document.querySelector('.verdict[data-provisional]')?.textContent));
    await page.goto(`${daemon.url}/#/parts?part_id=..`);
    await page.waitForFunction(() => /No browser can open an address with the part/.test(document.querySelector('.parts .note')?.textContent));
    await close(page);
  });

  it('stays unconfirmed while the service lacks a value that it had stored', async () => {
    await station('E-6');
    await page.route('**/v1/parts/*', async (route) => {
      const response = await route.fetch();
      const found = await response.json();
      await route.fulfill({ response, json: { ...found, missing: ['bore-B'] } });
    });
    for (const value of ['25.01', '40.01', '120.1']) await line(value);
    await page.waitForSelector('.verdict[data-verdict="good"][data-provisional="away"]');
    await page.unroute('**/v1/parts/*');
    await daemon.stop();
    await page.waitForSelector('.link[data-state="away"]');
    await daemon.start();
    await says('GoodPart E-6All 3 measured');
    page.errors.length = 0;
    await close(page);
  });

  it('ends with the verdict of the record when a value is corrected or moved elsewhere while the page is open', async () => {
    await station('E-7');
    for (const value of ['25.01', '40.01', '120.1']) await line(value);
    await says('GoodPart E-7All 3 measured');
    const [first, second] = await storedOf('E-7', 3);
    const { id } = await (await correct(first.id, 25.05)).json();
    await says('RejectPart E-7 · bore-A Reject');
    await page.waitForSelector('.reactions .catalogue');
    await say(id);
    await hidden();
    await correct(second.id, 40.02);
    await page.waitForFunction(() => /40\.020/.test(document.querySelector('.recent li').textContent));
    await says('RejectPart E-7 · bore-A Reject');
    const other = await store('E-7', { measured_mm: 25.012 }); // of another station: it counts
    await says('GoodPart E-7All 3 measured');
    await daemon.send('POST', `/v1/measurements/${other.id}/corrections`, { measured_mm: 25.012, part_id: 'E-70', reason: 'slip' });
    await says('RejectPart E-7 · bore-A Reject');
    assert.equal(await verdictOf('E-7'), 'reject');
    await close(page);
  });

  it('counts a later value of this station that was measured by another plan', async () => {
    await daemon.send('PUT', '/v1/plans/FINAL', { characteristics: [{ name: 'bore-A', designation: '25 H7' }] });
    await station('E-8');
    for (const value of ['25.01', '40.01', '120.1']) await line(value);
    await says('GoodPart E-8All 3 measured');
    await page.selectOption('.plan select', 'FINAL');
    await page.waitForFunction(() => document.querySelectorAll('.tiles-of-plan li').length === 1);
    await line('25.05');
    await says('RejectPart E-8');
    await page.selectOption('.plan select', '4711-A');
    await says('RejectPart E-8 · bore-A Reject');
    assert.equal(await verdictOf('E-8'), 'reject');
    await close(page);
  });

  it('is asked for again after an answer that did not come', async () => {
    await station('E-9');
    let refusals = 0;
    await page.route('**/v1/parts/*', (route) => (refusals++ ? route.continue() : route.fulfill({ status: 503, body: '{}' })));
    for (const value of ['25.01', '40.01', '120.1']) await line(value);
    await says('GoodPart E-9All 3 measured');
    assert.ok(refusals >= 2);
    await close(page);
  });

  it('shows a value that was corrected elsewhere as it is now', async () => {
    await station('E-5');
    await line('25.04');
    await says('Reject.*25\\.040 mm');
    const [{ id }] = await storedOf('E-5', 1);
    await page.waitForSelector('.recent .stored');
    await correct(id, 25.012);
    await says('Good.*25\\.012 mm');
    await hidden();
    await close(page);
  });
});
