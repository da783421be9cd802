/** The state of every value against a model: drawn sequences of values and samples, answers, outages, reloads, corrections, notes, tabs and closed pages. */

import assert from 'node:assert/strict';
import { describe, it } from 'node:test';

import { Ledger } from '../../../clients/web/gauge/ledger.js';
import { Desk } from './support/desk.mjs';

const SEQUENCES = process.env.TESTS_DEEP ? 4000 : 300;
const STEPS = 50;

/** Runs one sequence. @throws with its seed and steps where the record and the screen differ */
function run(seed, Kind) {
  const desk = new Desk(seed, Kind);
  try {
    for (let i = 0; i < STEPS; ++i) desk.step();
    desk.settle();
  } catch (problem) {
    problem.message = `seed ${seed}, ${desk.steps.join(' ')}: ${problem.message}`;
    throw problem;
  }
  return desk;
}

/** How many of the first sequences find a difference in a ledger that is wrong. */
const found = (Kind) => Array.from({ length: 100 }, (_, seed) => seed).filter((seed) => {
  try {
    run(seed, Kind);
    return false;
  } catch (problem) {
    if (problem instanceof assert.AssertionError) return true;
    throw problem;
  }
}).length;

describe('the ledger', () => {
  it(`agrees with the record in ${SEQUENCES} sequences`, () => {
    let done = 0;
    let corrected = 0;
    for (let seed = 0; seed < SEQUENCES; ++seed) {
      const desk = run(seed);
      done += desk.said.size;
      corrected += desk.service.records.filter((record) => record.correction_of).length;
    }
    assert.ok(done > SEQUENCES && corrected > SEQUENCES, `${done} reactions done, ${corrected} corrections`);
  });

  it('is found out where it forgets what a correction is of', () => {
    assert.ok(found(class extends Ledger { taken(key, shown) { super.taken(key, shown); } }) > 10);
  });

  it('is found out where it forgets what was done', () => {
    assert.ok(found(class extends Ledger { said(value) { return { ...super.said(value), cause: undefined }; } done() {} }) > 10);
  });

  it('is found out where a refused correction stays', () => {
    assert.ok(found(class extends Ledger { refused() {} }) > 10);
  });

  it('is found out where it takes the last value of a sample for all', () => {
    assert.ok(found(class extends Ledger { sampleInForce(...of) { return super.sampleInForce(...of).slice(-1); } }) > 10);
  });

  it('is found out where it hears of no note that was made while its page was closed', () => {
    assert.ok(found(class extends Ledger { noted() {} }) > 10);
  });

  it('is found out where it does not hear of another tab', () => {
    assert.ok(found(class extends Ledger { hear() {} }) > 10);
  });

  it('takes of a value that is corrected elsewhere what it is of, and not what was said of its size', () => {
    const [{ ledger }] = new Desk(1).tabs;
    ledger.taken('first', { measured: '2009', plan: 'P', part_id: 'SN', characteristic: 'bore', confirmed: true, verdict: 'reject', at: 0 });
    ledger.stored('first', {}, { id: 'r', verdict: 'reject' });
    ledger.told({ id: 'c', correction_of: 'r', measured_mm: 25, verdict: 'good', part_id: 'SN', characteristic: 'bore' });
    const { shown: { plan, confirmed, verdict } } = ledger.get('c');
    assert.deepEqual([plan, confirmed, verdict, ledger.stateOf(ledger.get('first'))], ['P', undefined, undefined, 'corrected']);
  });

  it('counts at a part with a name the newest value, of a sample too, and a GO gauge that failed before it', () => {
    const [{ ledger }] = new Desk(1).tabs;
    const take = (key, more) => ledger.taken(key, { measured: '25', plan: 'P', part_id: 'SN', characteristic: 'bore', subgroup: 's', at: 0, ...more });
    const counts = () => ledger.sampleInForce('P', 'SN', undefined, 'bore').map(({ key }) => key);
    take('first', { verdict: 'reject' });
    take('second', { verdict: 'good' });
    assert.deepEqual(counts(), ['second']);
    take('third', { verdict: null, go_gauge: 'fails' });
    take('fourth', { verdict: 'good' });
    assert.deepEqual(counts(), ['third', 'fourth']);
    take('fifth', { verdict: 'good', go_gauge: 'passes' });
    assert.deepEqual(counts(), ['fifth']);
  });

  it('keeps what is not done when it forgets the oldest', () => {
    const desk = new Desk(1);
    const [{ ledger }] = desk.tabs;
    const shown = { measured: '25', plan: 'P', part_id: 'SN', characteristic: 'bore', reaction: 'Stop', at: 0 };
    ledger.taken('first', { ...shown, verdict: 'reject' });
    ledger.stored('first', shown, { id: 'r', verdict: 'reject' });
    for (let i = 0; i < 1000; ++i) {
      ledger.taken(`k${i}`, { ...shown, verdict: 'good' });
      ledger.stored(`k${i}`, shown, { id: `r${i}`, verdict: 'good' });
    }
    assert.equal(ledger.get('k0'), undefined);
    assert.deepEqual(ledger.open.map(({ key }) => key), ['first']);
    assert.ok(Object.keys(desk.storage).filter((name) => name.startsWith('fitgauge.value.')).length <= 400);
  });
});
