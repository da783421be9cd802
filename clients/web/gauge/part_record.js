/** Asks the service what it has and no event told of: the page was closed, or another station was there. */

import { getJson, isFolded, PATIENCE_MS, url } from '../api.js';
import { countOf, isUnverified } from '../verdict.js';

export const WORST_FIRST = ['reject', 'rework', 'indeterminate', 'good'];
const rank = ({ verdict }) => WORST_FIRST.indexOf(verdict);
/** The values that are not good, of each name the worst, then the first; a value without a name stands alone. */
const worstOfEach = (values) => values.filter((one, i) => one.verdict !== 'good'
  && !values.some((other, j) => other.name && other.name === one.name && (rank(other) - rank(one) || j - i) < 0));

const AGAIN_MS = 5000;

const ask = (path, query) => getJson(url(path, query), { timeout: PATIENCE_MS, asks: false });
const isOld = (state) => ['corrected', 'moved'].includes(state);
const timeOf = ({ record, shown }) => new Date(record?.measured_at ?? shown.at).getTime();

/** Corrections of values and notes of what is to be done, as they were made elsewhere. @param values of the ledger */
export async function askOfValues(ledger, values) {
  await Promise.allSettled(values.filter(({ record }) => record).map((value) => askOf(ledger, value)));
}

async function askOf(ledger, value) {
  const { id } = value.record;
  const isOpen = ledger.stateOf(value) === 'open';
  const [{ corrected_by: newer }, { notes }] = await Promise.all([ask(['measurements', id]), isOpen ? ask(['measurements', id, 'notes']) : { notes: [] }]);
  for (const note of notes) ledger.noted({ measurement_id: id, ...note });
  if (!newer) return;
  ledger.told(await ask(['measurements', newer]));
  const next = ledger.ofRecord(newer);
  if (next) await askOf(ledger, next);
}

/** The values of a part that count at the service, asked for once in every state of the part at this station. */
export class PartRecord {
  #of;
  #found;
  #isStale = false;
  #asking;

  /** @param ledger the values of this station; @param onAnswer is told of an answer; @param leaving ends it */
  constructor(ledger, onAnswer, leaving) {
    Object.assign(this, { ledger, onAnswer, leaving });
  }

  /** The part has changed elsewhere, or may have. */
  forget() {
    this.#isStale = true;
  }

  /**
   * How a part is, by its worst value, of this station or of others: {part, verdict, bad, count, newest, unverified, provisional}; `away` as the service has not
   * answered, `storing` while it is asked.
   * @param own its values in force here, as {name, value, verdict}: of a name another one that was measured later takes its place, unless the service counts both
   */
  result(part, plan, own) {
    const isStored = own.every(({ value }) => value.record);
    const others = isStored && part && !isFolded(part) ? this.#others(part, plan, own) : [];
    const counted = new Set(this.#found?.characteristics.map(({ measurement_id: id }) => id));
    const isReplaced = ({ name, value }) => others?.some((other) => other.name === name && timeOf(other.value) >= timeOf(value));
    const measured = [...own.filter((one) => counted.has(one.value.record?.id) || !isReplaced(one)), ...others ?? []];
    const verdict = WORST_FIRST.find((word) => measured.some((each) => each.verdict === word));
    const newest = measured.reduce((one, other) => (timeOf(other.value) > timeOf(one.value) ? other : one));
    return { part, verdict, bad: worstOfEach(measured), count: countOf(measured.map(({ name }) => name)), newest, unverified: measured.some(({ value: { record } }) => record && isUnverified(record)), provisional: !isStored || others === null || isFolded(part) ? 'away' : others ? undefined : 'storing' };
  }

  /** The values of others; undefined while they are asked for, null where there was no answer. */
  #others(part, plan, own) {
    const state = [part, plan, ...own.map(({ value }) => value.record.id)].join('\n');
    if (this.#isStale || state !== this.#of) this.#ask(state, part, plan);
    if (!this.#found) return this.#found;
    const { characteristics, missing } = this.#found;
    // The service has lost what it had stored.
    if (own.some(({ name }) => missing.includes(name))) return null;
    return characteristics.filter((one) => one.verdict && this.#isOther(one, part, plan, own))
      .map(({ characteristic, verdict, measured_mm: measured, measured_at: at }) => ({ name: characteristic ?? '', verdict, value: { shown: { measured, at } } }));
  }

  /** Whether a value of the service is none of those that count here, and none that was corrected since. */
  #isOther({ measurement_id: id, characteristic }, part, plan, own) {
    const here = this.ledger.ofRecord(id);
    if (here && isOld(this.ledger.stateOf(here))) return false;
    return !this.ledger.of(plan, part).includes(here) || !own.some(({ name }) => name === characteristic);
  }

  /** What was answered of the same state stands until there is another answer; where there is none, it is asked again. */
  async #ask(state, part, plan) {
    if (state !== this.#of) this.#found = undefined;
    this.#of = state;
    this.#isStale = false;
    const asking = this.#asking = {};
    const found = await ask(['parts', part], { plan }).catch(() => null);
    if (this.#asking !== asking || this.leaving.aborted) return;
    this.#found = found;
    if (!found) {
      setTimeout(() => {
        if (this.#asking !== asking || this.leaving.aborted) return;
        this.forget();
        this.onAnswer();
      }, AGAIN_MS);
    }
    this.onAnswer();
  }
}
