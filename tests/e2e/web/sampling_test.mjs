/**
 * Samples: what a plan says how often, and how many at a time. The station derives it from what is stored, by
 * whomever.
 *
 * Tried, and held here:
 * - A plan with *every 5th part*, *each hour*, five at a time: due or not at each tile; the value goes to what is
 *   due
 * - Change the part, reload, or kill the service in the middle of five: goes on at the same value, in the same
 *   `subgroup`; no part is in it twice
 * - Two stations measure one plan at the same time: what one has measured is not due at the other; each fills a
 *   sample of its own, none has too many
 * - A value where nothing is due: not taken: scan, or touch a tile
 * - The service refuses a value of a sample: asked for again, in the same sample
 */

import assert from 'node:assert/strict';
import path from 'node:path';
import { afterEach, describe, it } from 'node:test';

import { closeContext, findings, open, openIn, PATIENCE_MS, picture } from './support/browser.mjs';
import { Daemon, sleep } from './support/daemon.mjs';
import { answer } from './support/reactions.mjs';
import { scan } from './support/scanner.mjs';
import { browser, daemon } from './support/stage.mjs';

const { frequencyOf, periodStart, standing } = await import(path.resolve('clients/web/gauge/frequency.js'));

const H7 = { designation: '25 H7' };
let pages = [];

afterEach(async () => {
  const opened = pages;
  pages = [];
  for (const context of new Set(opened.map((page) => page.context()))) await closeContext(context);
  assert.deepEqual(opened.flatMap((page) => [...page.errors, ...page.foreign]), []);
});

const progress = (page, text) => page.waitForFunction((wanted) => document.querySelector('.plan:not([aria-busy]) .progress')?.textContent === wanted, text);
const ready = (page) => page.waitForSelector('.echo .figures');
const tiles = (page) => page.$$eval('.tiles-of-plan button', (all) => all.map((one) => one.querySelector('.when')?.textContent ?? ''));
const tile = (page, name, text) => page.waitForFunction(([wanted, when]) => [...document.querySelectorAll('.tiles-of-plan button')]
  .some((one) => one.textContent.includes(wanted) && one.querySelector('.when')?.textContent === when), [name, text]);
const note = (page, pattern) => page.waitForFunction((source) => new RegExp(source).test(document.getElementById('entry-note').textContent), pattern.source);
const storedOf = async (part, at = daemon) => (await at.stored()).filter(({ characteristic }) => characteristic.startsWith(`${part}-`));
const put = (part, characteristics, at = daemon) => at.send('PUT', `/v1/plans/${part}`,
  { characteristics: characteristics.map(([name, more]) => ({ name: `${part}-${name}`, ...H7, ...more })) });

/** Five minutes past the hour before this one: no test meets the end of it. */
const inTheHour = () => new Date(Math.floor(Date.now() / 3600000 - 1) * 3600000 + 300000);

/** A page with a plan, at a station of its own. @param options of the page */
async function station(part, query = '', at = daemon, options = {}) {
  const page = await open(browser, at, `#/gauge?plan=${part}${query}`, options);
  pages.push(page);
  await ready(page);
  await page.focus('#value');
  return page;
}

/** Types values, each once the one before is stored and it is known what is measured at the part. */
async function measure(page, at, ...values) {
  for (const value of values) {
    await page.waitForSelector('.plan:not([aria-busy])');
    const before = (await at.stored()).length;
    await scan(page, value);
    for (const until = Date.now() + PATIENCE_MS; (await at.stored()).length === before; await sleep(20)) assert.ok(Date.now() < until, `${value} is not stored`);
  }
}

describe('how often', () => {
  it('is read in four languages, and what is not read is due at each part', () => {
    const HOUR = 3600000;
    for (const [words, wanted] of [
      ['every 5th part', { samples: 1, parts: 5 }], ['Every 5 parts', { samples: 1, parts: 5 }], ['jedes 5. Teil', { samples: 1, parts: 5 }],
      ['elk 5e onderdeel', { samples: 1, parts: 5 }], ['ogni 5 pezzi', { samples: 1, parts: 5 }], ['each part', { samples: 1, parts: 1 }],
      ['each hour', { samples: 1, period: HOUR }], ['3 of each hour', { samples: 3, period: HOUR }], ['stündlich', { samples: 1, period: HOUR }],
      ['every 30 minutes', { samples: 1, period: HOUR / 2 }], ['2 per day', { samples: 2, period: 24 * HOUR }], ['alle 2 Stunden', { samples: 1, period: 2 * HOUR }],
      ['elke 2 uur', { samples: 1, period: 2 * HOUR }], ['ogni ora', { samples: 1, period: HOUR }], ['3 of every 50 parts', { samples: 3, parts: 50 }],
      ['each shift', null], ['after a tool change', null], ['every 0 parts', null], ['every 5.5 parts', null], ['', null], [undefined, null],
    ]) assert.deepEqual(frequencyOf(words), wanted, words);
  });

  it('goes by the hours and days on the wall', () => {
    const moment = new Date(2026, 2, 3, 14, 47, 12).getTime();
    const at = (minutes) => new Date(periodStart(moment, minutes * 60000)).toTimeString().slice(0, 5);
    assert.deepEqual([at(60), at(30), at(120), at(1440)], ['14:00', '14:30', '14:00', '00:00']);
  });

  it('has days that are an hour longer or shorter', () => {
    const zone = process.env.TZ;
    process.env.TZ = 'Europe/Berlin';
    try {
      const DAY = 24 * 3600000;
      for (const [now, begin, end] of [
        ['2026-03-29T10:00:00+02:00', '2026-03-29T00:00:00+01:00', '2026-03-30T00:00:00+02:00'],
        ['2026-03-29T01:30:00+01:00', '2026-03-29T00:00:00+01:00', '2026-03-30T00:00:00+02:00'],
        ['2026-10-25T10:00:00+01:00', '2026-10-25T00:00:00+02:00', '2026-10-26T00:00:00+01:00'],
        ['2026-10-25T01:30:00+02:00', '2026-10-25T00:00:00+02:00', '2026-10-26T00:00:00+01:00'],
      ]) {
        const [moment, first, next] = [now, begin, end].map((text) => new Date(text).getTime());
        assert.equal(new Date(periodStart(moment, DAY)).toISOString(), new Date(first).toISOString(), now);
        const taken = standing({ samples: [{ begin: first, last: first, parts: [], count: 1 }], size: 1, isOwn: () => false, frequency: { samples: 1, period: DAY }, parts: null, now: moment });
        assert.deepEqual(taken, { due: false, until: next }, now);
      }
    } finally {
      if (zone === undefined) delete process.env.TZ;
      else process.env.TZ = zone;
    }
  });
});

describe('every third part', () => {
  it('is due at the first, the fourth and so on, whoever measured those between', async () => {
    await put('THIRD', [['each'], ['third', { frequency: 'every 3rd part' }]]);
    const page = await station('THIRD');
    const other = await station('THIRD');
    await scan(page, 'SN-1');
    await progress(page, '1 of 2');
    assert.deepEqual(await tiles(page), ['', 'every 3rd part · due']);
    await measure(page, daemon, '25.001', '25.002');
    await progress(page, 'All 2 measured');
    await scan(other, 'SN-2'); // at another station
    await progress(other, '1 of 1');
    await tile(other, 'third', 'every 3rd part · in 2 parts');
    await measure(other, daemon, '25.003');
    await progress(other, '1 measured, nothing else is due');
    assert.deepEqual(await findings(other), []);
    await scan(page, 'SN-3');
    await tile(page, 'third', 'every 3rd part · at the next part');
    await measure(page, daemon, '25.004');
    await progress(page, '1 measured, nothing else is due');
    await scan(page, '25.005'); // the scan of the next part was forgotten
    await note(page, /Not stored.*All of SN-3 is measured/);
    await page.keyboard.press('Escape');
    await scan(page, 'SN-4');
    await progress(page, '1 of 2');
    await page.reload();
    await progress(page, '1 of 2');
    await ready(page);
    await measure(page, daemon, '25.006', '25.007');
    await progress(page, 'All 2 measured');
    assert.deepEqual((await storedOf('THIRD')).map(({ part_id: part, characteristic, subgroup }) => [part, characteristic, subgroup]), [
      ['SN-1', 'THIRD-each', undefined], ['SN-1', 'THIRD-third', undefined], ['SN-2', 'THIRD-each', undefined],
      ['SN-3', 'THIRD-each', undefined], ['SN-4', 'THIRD-each', undefined], ['SN-4', 'THIRD-third', undefined]]);
  });

  it('ends on the worst value of a sample, not on its last', async () => {
    await put('WORST', [['three', { subgroup_size: 3 }], ['one']]);
    const page = await station('WORST');
    await measure(page, daemon, '25.01', '25.05', '25.011', '25.01');
    await page.waitForFunction(() => /^Reject/.test(document.querySelector('.verdict .word')?.textContent) && document.querySelector('.verdict').textContent.includes('WORST-three'));
    assert.deepEqual(await page.$$eval('.tiles-of-plan li', (all) => all.map((tile) => tile.querySelector('.shape')?.dataset.verdict)), ['reject', 'good']);
  });

  it('is counted without names of parts too, before and after what every part has', async () => {
    await put('PLAIN', [['first', { frequency: 'every 3rd part' }], ['each'], ['last', { frequency: 'every 3rd part' }]]);
    const page = await station('PLAIN');
    const values = ['25.001', '25.002', '25.003', '25.001', '25.001', '25.004', '25.005', '25.006'];
    await measure(page, daemon, ...values);
    assert.deepEqual((await storedOf('PLAIN')).map(({ characteristic }) => characteristic.split('-')[1]), ['first', 'each', 'last', 'each', 'each', 'first', 'each', 'last']);
  });

  it('can be measured in between, and is not asked for at a part that is left', async () => {
    await put('BETWEEN', [['each'], ['third', { frequency: 'every 3rd part' }]]);
    const page = await station('BETWEEN');
    await scan(page, 'SN-1');
    await measure(page, daemon, '25.001', '25.002');
    await scan(page, 'SN-2');
    await progress(page, '1 of 1');
    await page.click('.tiles-of-plan li:last-child button');
    await progress(page, '2 of 2');
    await page.focus('#value');
    await measure(page, daemon, '25.003');
    await progress(page, '1 of 2');
    await measure(page, daemon, '25.004');
    await progress(page, 'All 2 measured');
    await scan(page, 'SN-3');
    await tile(page, 'third', 'every 3rd part · in 2 parts');
    await measure(page, daemon, '25.005');
    await scan(page, 'SN-4');
    assert.equal(await page.textContent('.of-plan'), '');
  });
});

describe('so many of each hour', () => {
  it('are due until they are taken, by any station of the machine, and again in the next hour', async () => {
    await put('HOUR', [['bore', { frequency: '2 of each hour' }]]);
    const [page, other, elsewhere] = await Promise.all(['M1', 'M1', 'M2'].map((machine) => station('HOUR', `&machine=${machine}`, daemon, { at: inTheHour() })));
    await measure(page, daemon, '25.001');
    await measure(other, daemon, '25.002');
    for (const each of [page, other]) {
      await each.waitForFunction(() => /^2 of each hour · from \d\d:00$/.test(document.querySelector('.when')?.textContent));
      await scan(each, '25.003');
      await note(each, /Not stored.*Nothing is due/);
    }
    await tile(elsewhere, 'bore', '2 of each hour · due');
    await page.keyboard.press('Escape');
    await page.click('.tiles-of-plan button'); // all the same
    await page.focus('#value');
    await measure(page, daemon, '25.004');
    await page.reload();
    await page.waitForFunction(() => /^2 of each hour · from \d\d:00$/.test(document.querySelector('.when')?.textContent));
    await page.clock.fastForward(3600000);
    await tile(page, 'bore', '2 of each hour · due');
    assert.equal((await storedOf('HOUR')).length, 3);
  });
});

describe('a sample', () => {
  const SAMPLE = [['size', { subgroup_size: 3, frequency: 'each hour' }], ['seat', { subgroup_size: 2 }]];

  it('is asked for value by value, over a reload and an outage, and the chart sees it', async () => {
    const own = await new Daemon().start();
    await put('ROW', SAMPLE, own);
    const page = await station('ROW', '', own, { at: inTheHour() });
    await progress(page, '1 of 2 · value 1 of 3');
    assert.match(await page.textContent('.verdict .word'), /ROW-size · value 1 of 3/);
    assert.deepEqual(await tiles(page), ['each hour · sample of 3 · due', 'sample of 2 · due']);
    await measure(page, own, '25.001');
    await progress(page, '1 of 2 · value 2 of 3');
    await picture(page, 'gauge-sample');
    assert.deepEqual(await findings(page), []);
    await page.reload();
    await progress(page, '1 of 2 · value 2 of 3');
    await ready(page);
    await own.kill();
    await scan(page, '25.002');
    await progress(page, '1 of 2 · value 3 of 3');
    await page.goto('about:blank');
    await own.start();
    await page.goto(`${own.url}/#/gauge?plan=ROW`);
    await page.waitForSelector('.link[data-state="up"]');
    await progress(page, '1 of 2 · value 3 of 3');
    await ready(page);
    await page.focus('#value');
    await measure(page, own, '25.003');
    await progress(page, '2 of 2 · value 1 of 2');
    await measure(page, own, '25.004', '25.005');
    await progress(page, 'All 2 measured');
    const [size, seat] = ['ROW-size', 'ROW-seat'];
    const found = await own.stored();
    assert.deepEqual(found.map(({ characteristic, measured_mm: mm }) => [characteristic, mm]), [[size, 25.001], [size, 25.002], [size, 25.003], [seat, 25.004], [seat, 25.005]]);
    assert.equal(new Set(found.slice(0, 3).map(({ subgroup }) => subgroup)).size, 1);
    assert.equal(new Set(found.map(({ subgroup }) => subgroup)).size, 2);
    await measure(page, own, '25.006', '25.007'); // the hour has its sample: the next round begins with the other
    const chart = await own.json(`/v1/measurements/chart?characteristic=${seat}&kind=xbar_r`);
    assert.equal(chart.charts[0].points.length, 2);
    page.errors.length = 0;
    await own.cleanup();
  });

  it('goes on with the next part, and has each part once', async () => {
    await put('PARTS', [['each'], ['sampled', { subgroup_size: 3, frequency: 'every 5th part' }]]);
    const page = await station('PARTS');
    const measured = async (part, ...values) => {
      await scan(page, part);
      await page.waitForFunction((wanted) => document.querySelector('.verdict .word')?.textContent.includes(wanted), part);
      await measure(page, daemon, ...values);
    };
    await measured('SN-1', '25.001', '25.002');
    await progress(page, 'All 2 measured');
    await measured('SN-2', '25.003');
    await progress(page, '2 of 2 · value 2 of 3');
    await scan(page, 'SN-3'); // changed in the middle
    await page.waitForFunction(() => document.querySelector('.of-plan')?.textContent === 'Not measured at SN-2: PARTS-sampled.');
    await measure(page, daemon, '25.004', '25.005');
    const again = await openIn(page.context(), daemon, '#/gauge?plan=PARTS&part_id=SN-3'); // another tab
    pages.push(again);
    await tile(again, 'sampled', 'every 5th part · value 3 of 3');
    await measured('SN-4', '25.006', '25.007');
    await measured('SN-5', '25.008');
    await progress(page, '1 measured, nothing else is due');
    await measured('SN-6', '25.009');
    await progress(page, '2 of 2 · value 1 of 3');
    await measure(page, daemon, '25.010');
    const sampled = (await storedOf('PARTS')).filter(({ characteristic }) => characteristic === 'PARTS-sampled');
    assert.deepEqual(sampled.map(({ part_id: part }) => part), ['SN-1', 'SN-3', 'SN-4', 'SN-6']);
    assert.deepEqual(sampled.map(({ subgroup }) => sampled.findIndex((one) => one.subgroup === subgroup)), [0, 0, 0, 3]);
  });

  it('is of one station: another begins its own, and no sample has too many values', async () => {
    await put('TWO', [['size', { subgroup_size: 2 }]]);
    const page = await station('TWO');
    const other = await station('TWO');
    await measure(page, daemon, '25.001');
    await progress(page, '1 of 1 · value 2 of 2');
    await tile(other, 'size', 'sample of 2 · due');
    await measure(other, daemon, '25.011');
    await measure(page, daemon, '25.002');
    await measure(other, daemon, '25.012');
    const found = await storedOf('TWO');
    assert.deepEqual(found.map(({ subgroup }) => found.findIndex((one) => one.subgroup === subgroup)), [0, 1, 0, 1]);
  });

  it('has what was corrected at another place, and lacks what was made another characteristic\'s there', async () => {
    await put('THERE', [['size', { subgroup_size: 3, reaction: 'Stop' }]]);
    const page = await station('THERE');
    const correct = ({ id }, fields) => daemon.send('POST', `/v1/measurements/${id}/corrections`, { reason: 'slip', ...fields });
    await measure(page, daemon, '25.001', '25.002');
    await progress(page, '1 of 1 · value 3 of 3');
    const [first, second] = await storedOf('THERE');
    await correct(first, { measured_mm: '25.04' });
    await answer(page, 'Done');
    await progress(page, '1 of 1 · value 3 of 3');
    await correct(second, { measured_mm: '25.002', characteristic: 'THERE-other' });
    await progress(page, '1 of 1 · value 2 of 3');
    await page.goto('about:blank');
    await page.goto(`${daemon.url}/#/gauge?plan=THERE`);
    await progress(page, '1 of 1 · value 2 of 3');
    await ready(page);
    await page.focus('#value');
    await measure(page, daemon, '25.003', '25.005');
    await page.waitForSelector('.tiles-of-plan [data-verdict="reject"]');
    const sizes = await daemon.stored('characteristic=THERE-size');
    assert.deepEqual(sizes.map(({ measured_mm: mm, subgroup }) => [mm, subgroup === first.subgroup]), [[25.04, true], [25.003, true], [25.005, true]]);
  });

  it('lacks a value that the service has refused, and asks for it again', async () => {
    await put('REFUSED', [['size', { subgroup_size: 2 }]]);
    const page = await station('REFUSED');
    await page.route('**/v1/measurements', (route) => route.fulfill({ status: 422, contentType: 'application/problem+json', body: '{"code":"request.invalid","detail":"no"}' }), { times: 1 });
    await scan(page, '25.001');
    await page.waitForSelector('.recent li.refused');
    await progress(page, '1 of 1 · value 1 of 2');
    await measure(page, daemon, '25.002', '25.003');
    await progress(page, 'All 1 measured');
    assert.equal(new Set((await storedOf('REFUSED')).map(({ subgroup }) => subgroup)).size, 1);
  });
});
