/** What is measured at a part, in order: the plan of a part number, and which of its characteristics is next. */

import { getJson, PATIENCE_MS, url } from '../api.js';
import { connection } from '../connection.js';
import { h, refill } from '../dom.js';
import { designationText } from '../designation.js';
import { mmText, nmFromMm, nmFromUm, umText } from '../exact.js';
import { date, dateTime, explain, number, signed, t, timeOfDay } from '../i18n.js';
import { untilLifted } from '../press.js';
import { randomText } from '../queue.js';
import { readJson, store } from '../stored.js';
import { limitsText, verdictShape } from '../verdict.js';
import { held } from './held.js';
import { askOfValues, PartRecord, WORST_FIRST } from './part_record.js';
import { Samples } from './samples.js';

const KEPT_LIST = 'plans';
const KEPT_STATE = 'plan-at';
const LONGEST_SLEEP_MS = 60000;

const given = (um) => (um === undefined ? undefined : nmFromUm(um));

/** Size and class of a characteristic, or another designation; '' where it has limits of a drawing. */
export const designationOf = (one) => one.designation ?? (one.tolerance_class ? `${one.nominal_mm}${one.tolerance_class}` : '');

/** What a characteristic is measured against, for people: Ø 25 H7, M10-6H, 40 +0.1/-0.1, or ≤ 0.05 mm. */
export const sizeText = (one) => {
  if (one.designation || one.tolerance_class) return designationText(one.designation ?? `${one.nominal_mm} ${one.tolerance_class}`);
  const deviations = [one.upper_um, one.lower_um].map(given);
  if (deviations.includes(undefined)) return limitsText(ownLimits(one));
  return `${number(one.nominal_mm)} ${deviations.map((nm) => signed(mmText(nm, 0))).join('/')}`;
};

/** The limits of a drawing, one or both, as the service gives those of a class; null for a class. */
export function ownLimits(one) {
  const [upper, lower] = [one.upper_um, one.lower_um].map(given);
  if (upper === undefined && lower === undefined) return null;
  const nominal = nmFromMm(one.nominal_mm);
  return {
    nominal_mm: one.nominal_mm, feature: one.feature, ...(one.quantity && { quantity: one.quantity }), basis: 'explicit',
    ...(upper !== undefined && { upper_deviation_um: one.upper_um, upper_limit_mm: mmText(nominal + upper, 0) }),
    ...(lower !== undefined && { lower_deviation_um: one.lower_um, lower_limit_mm: mmText(nominal + lower, 0) }),
    ...(upper !== undefined && lower !== undefined && { tolerance_um: umText(upper - lower) }),
  };
}

/** {plan} of a part number; {refused} says why there is none. */
async function planOf(part) {
  const gone = t('plan.gone', { part });
  try {
    const plan = await held(['plans', part]);
    return plan ? { plan } : { refused: gone };
  } catch (problem) {
    return { refused: problem.status === 404 ? gone : explain(problem) };
  }
}

export class Plan {
  /**
   * @param ledger the values and their state
   * @param onAgain is told that the part is measured anew
   * @param onStep is told that another characteristic is next; @param onChoose takes a part number, or '' for none; @param onRecord is told what the service has of the part
   * @param machine whose samples these are; @param subject the part that is measured; @param leaving ends it
   */
  constructor({ ledger, onStep, onAgain, onChoose, onRecord, machine, subject, leaving }) {
    Object.assign(this, { ledger, onStep, onAgain });
    this.record = new PartRecord(ledger, onRecord, leaving);
    this.subjectNow = subject;
    this.samples = new Samples({ machine, leaving, onChange: () => this.#renew() });
    leaving.addEventListener('abort', () => clearTimeout(this.timer));
    this.known = readJson(KEPT_LIST, []);
    this.subject = '';
    this.#clear();
    this.select = h('select', { onchange: () => onChoose(this.select.value), 'aria-label': t('plan.label') });
    this.progress = h('p.progress', { role: 'status' });
    this.tiles = h('ol.tiles-of-plan');
    this.note = h('p.note.of-plan', { role: 'alert' });
    this.element = h('section.plan', { 'aria-label': t('plan.label'), hidden: true }, h('div.line', this.select, this.progress), this.tiles, this.note);
  }

  /** Asks which plans there are; keeps the list for when the service is away, and until it has answered. */
  async list() {
    try {
      this.known = (await getJson(url(['plans']), { asks: false })).plans;
      store(KEPT_LIST, JSON.stringify(this.known));
    } catch {
      // what was kept has to do
    }
    this.#draw();
  }

  /** Whether a text that was typed or scanned is a part number with a plan. */
  knows(text) {
    return this.known.some((plan) => plan.part === text);
  }

  get part() {
    return this.plan?.part ?? '';
  }

  /** The part number that was chosen last: its plan may be on its way. */
  get chosen() {
    return this.asked ? this.asked.part : this.part;
  }

  /** The designations that it measures by. */
  get designations() {
    return (this.plan?.characteristics ?? []).map(designationOf).filter(Boolean);
  }

  /** The catalogues that its characteristics ask for. */
  get catalogues() {
    return [...new Set((this.plan?.characteristics ?? []).map((one) => one.catalogue).filter(Boolean))];
  }

  /** The characteristic to measure, or undefined without a plan. */
  get current() {
    return this.plan?.characteristics[this.at];
  }

  /** Whether it is being asked what is measured: a value that comes now belongs to nothing. */
  get loading() {
    return this.asked !== undefined;
  }

  /**
   * Takes up the plan of a part number; without one there is none.
   * @param again whether to go on where it was left: after a reload
   * @returns whether it has: another may be asked for meanwhile
   */
  async load(part, again = false) {
    const asked = { part };
    this.asked = asked;
    this.element.setAttribute('aria-busy', true);
    const { plan, refused } = part ? await planOf(part) : {};
    if (this.asked !== asked) return false;
    const { missing } = this;
    // The same plan at another part: the stream has told of its values.
    if (JSON.stringify(plan) !== JSON.stringify(this.samples.plan)) await this.samples.load(plan);
    if (this.asked !== asked) return false;
    this.asked = undefined;
    this.element.removeAttribute('aria-busy');
    this.plan = this.samples.plan;
    if (again && plan && this.#resume()) return true;
    this.begin(missing);
    if (refused) this.note.textContent = refused;
    return true;
  }

  /** Another part: from the first characteristic on. Says what was not measured at the one before. */
  begin(missing = this.missing) {
    this.note.textContent = missing.length ? t('plan.missing', { part: this.subject || t('part.none'), names: missing.join(', ') }) : '';
    this.subject = this.subjectNow();
    this.#clear();
    this.askElsewhere();
    this.#sayMeasured();
    this.#goTo(this.#open ?? this.#next(0));
  }

  /** Whether a characteristic is due at this part, and how far its sample is: {due, at, size, parts, until}. */
  #standing(at) {
    const counted = this.plan.characteristics.indexOf(this.samples.counted);
    return this.samples.standing(this.plan.characteristics[at], this.subject, !this.#isBetween && this.#isTaken(counted));
  }

  /** The value in force of a characteristic at this part; undefined where there is none. */
  #valueOf(at) {
    const one = this.plan?.characteristics[at];
    return one && this.ledger.inForce(this.part, this.subject, this.round, one.name);
  }

  /** Of a sample the worst value, or one that is not judged yet. */
  #worstOf(at) {
    const one = this.plan?.characteristics[at];
    const all = one ? this.ledger.sampleInForce(this.part, this.subject, this.round, one.name) : [];
    const verdicts = all.map((value) => this.ledger.verdictOf(value));
    return all[verdicts.indexOf(verdicts.includes(undefined) ? undefined : WORST_FIRST.find((word) => verdicts.includes(word)))];
  }

  /** Whether a characteristic has its value: of a sample in a row, the last. */
  #isTaken(at) {
    const value = this.#valueOf(at);
    return value !== undefined && !value.partial;
  }

  get #isBegun() {
    return this.plan?.characteristics.some((_, at) => this.#isTaken(at)) ?? false;
  }

  /** The first that is due and not measured, from one on. */
  #next(from) {
    const { length } = this.plan?.characteristics ?? [];
    return Array.from({ length }, (_, i) => (from + i) % length).find((at) => !this.#isTaken(at) && this.#standing(at).due);
  }

  /** Where parts have no names a sample that was begun goes on first. */
  get #open() {
    const at = this.subject || !this.plan ? -1 : this.plan.characteristics.findIndex((_, i) => this.#standing(i).at > 0);
    return at < 0 ? undefined : at;
  }

  #isMeasured(at) {
    return this.#isTaken(at) && !this.#isBetween;
  }

  /** Whether the next value is of the next part, which has no name. */
  get #isBetween() {
    return this.finished && !this.subject && this.#isBegun;
  }

  /** Where the next part begins, which has no name. */
  get #nextRound() {
    return this.plan.characteristics.findIndex((_, at) => this.#standing(at).due);
  }

  #goTo(at) {
    this.go(at ?? 0, this.plan !== undefined && at === undefined);
  }

  /** Time has passed, or another station has measured: what nobody stands at is looked at anew. */
  #renew() {
    if (!this.plan) return;
    const between = this.#isBetween;
    const next = !this.finished ? -1 : between ? this.#nextRound : this.#next(0) ?? -1;
    if (next < 0 || (between && next === this.at)) this.#draw();
    else this.go(next, between);
  }

  /** What is measured next, for people: the characteristic, and how far its sample is. */
  get what() {
    return this.finished || !this.plan ? '' : [this.current.name, this.#sampleText(this.#standing(this.at))].filter(Boolean).join(' · ');
  }

  #sampleText({ at, size }) {
    return size > 1 ? t('plan.sample', { at: Math.min(at + 1, size), size }) : '';
  }

  /** The sample that the next value belongs to. */
  get sample() {
    return this.plan && this.samples.sampleOf(this.current);
  }

  /** Why no value is taken before somebody says what is measured; '' where that is known. */
  get reason() {
    if (!this.finished) return '';
    if (this.#isBegun) return this.subject ? t('plan.finished_first', { part: this.subject }) : this.#idle;
    return t('plan.nothing_first');
  }

  /** Without a name the next value is of the next part, if something is due there. */
  get #idle() {
    return this.#standing(this.at).due ? '' : t('plan.nothing_first');
  }

  /** How the part is when all is measured, by its worst value; null before that, and while one has no verdict. */
  get result() {
    if (!this.finished || this.subject !== this.subjectNow() || !this.#isBegun) return null;
    const own = this.plan.characteristics.map(({ name }, at) => ({ name, value: this.#worstOf(at) })).filter(({ value }) => value)
      .map(({ name, value }) => ({ name, value, verdict: this.ledger.verdictOf(value) }));
    return own.every(({ verdict }) => verdict) ? this.record.result(this.subject, this.part, own) : null;
  }

  #clear() {
    this.at = 0;
    /** Tells the parts apart that have no names. */
    this.round = randomText();
  }

  /** The names of what was not measured at a part that was begun. */
  get missing() {
    return this.#isBegun ? this.plan.characteristics.filter((_, i) => !this.#isTaken(i) && this.#standing(i).due).map(({ name }) => name) : [];
  }

  /** What became of the values of this part while nobody listened. */
  askElsewhere() {
    if (this.plan && this.subject) askOfValues(this.ledger, this.ledger.of(this.part, this.subject));
  }

  /** Says when a part was measured that comes again, and lets it be measured anew. */
  #sayMeasured() {
    const { plan, subject } = this;
    const at = plan && subject && this.ledger.lastAt(this.part, subject);
    if (at) return this.#offerAgain(this.#measuredText(at));
    return plan && subject && this.#askMeasured();
  }

  /** Another station may have measured it: that is said, and changes nobody's step. */
  async #askMeasured() {
    const { plan, subject } = this;
    const asked = await getJson(url(['measurements'], { part_id: subject, sort: 'newest', limit: 20 }), { timeout: PATIENCE_MS, asks: false }).catch(() => null);
    const found = asked?.measurements.find((record) => plan.characteristics.some(({ name }) => name === record.characteristic));
    if (!found || this.plan !== plan || this.subject !== subject || this.ledger.lastAt(this.part, subject)) return;
    this.note.textContent = [this.note.textContent, this.#measuredText(found.measured_at, found.machine)].filter(Boolean).join(' ');
  }

  #measuredText(at, machine) {
    const then = new Date(at);
    const when = date(then) === date(connection.now()) ? timeOfDay(then) : dateTime(then);
    return t('plan.measured', { part: this.subject, time: [when, machine].filter(Boolean).join(' · ') });
  }

  #offerAgain(text) {
    refill(this.note, this.note.textContent, ' ', text, ' ', h('button', { type: 'button', onclick: () => this.#again() }, t('plan.again')));
  }

  #again() {
    this.ledger.again(this.part, this.subject);
    this.note.textContent = '';
    this.#goTo(this.#next(0));
    this.onAgain();
  }

  /** Goes on where this window was with this part. @returns whether it was there */
  #resume() {
    const kept = readJson(KEPT_STATE, {}, 'session');
    const subject = this.subjectNow();
    if (kept.part !== this.part || kept.subject !== subject) return false;
    Object.assign(this, { subject, round: kept.round });
    this.askElsewhere();
    // The plan may have been changed meanwhile.
    const at = this.plan.characteristics.findIndex(({ name }) => name === kept.name);
    if (!kept.finished) this.#goTo(at < 0 || this.#isTaken(at) ? this.#next(0) : at);
    else this.go(Math.max(at, 0), true);
    this.#renew();
    return true;
  }

  /** What the next value belongs to: {plan, round, reaction, catalogue}. Without a name the next part begins with it. */
  begun() {
    if (!this.plan) return {};
    if (this.#isBetween) {
      const { at } = this;
      this.#clear();
      Object.assign(this, { at, finished: false });
    }
    const { reaction, catalogue } = this.current;
    return { plan: this.part, round: this.subject ? undefined : this.round, reaction, catalogue };
  }

  /** A value of the current characteristic is on its way: the next one that is due and has none. @param key of the value */
  step(key) {
    if (!this.plan) return;
    const { at, subject } = this;
    // Without names of parts a sample is measured in a row.
    if (!subject && this.#standing(at).at > 0) {
      this.ledger.goesOn(key);
      return this.go(at);
    }
    const next = this.#next(at + 1);
    if (next !== undefined) return this.go(next);
    this.finished = true;
    return this.go(subject ? at : Math.max(this.#nextRound, 0), true);
  }

  /** A value has changed: what is not measured after all is due again. @param elsewhere whether another tab has it */
  changed({ shown }, elsewhere) {
    if (!this.plan || shown.plan !== this.part) return;
    const at = this.plan.characteristics.findIndex(({ name }) => name === shown.characteristic);
    const isHere = shown.round === undefined || shown.round === this.round;
    if (this.finished && at >= 0 && isHere && (this.subject || shown.round) && !this.#isTaken(at) && this.#standing(at).due) this.go(at);
    else this.#draw();
    if (elsewhere && this.subject && at === this.at && !this.finished && this.#isTaken(at)) this.#sayMeasured();
  }

  #keep() {
    const { part, subject, current, finished, round } = this;
    store(KEPT_STATE, JSON.stringify({ part, subject, name: current?.name, finished, round }), 'session');
  }

  go(at, finished = false) {
    this.at = at;
    this.finished = finished;
    this.#draw();
    this.#keep();
    if (this.plan) this.onStep(this.current);
  }

  #draw() {
    const { known } = this;
    this.element.hidden = known.length === 0 && !this.plan;
    refill(this.select, h('option', { value: '' }, t('plan.none')),
      known.map(({ part, name }) => h('option', { value: part, selected: part === this.part }, [part, name].filter(Boolean).join(' · '))));
    this.select.value = this.part;
    const list = this.plan?.characteristics ?? [];
    const all = list.map((_, i) => this.#standing(i));
    const verdicts = list.map((_, i) => this.#worstOf(i)).map((value) => value && this.ledger.verdictOf(value));
    const text = list.length ? this.#progressText(all) : '';
    if (this.progress.textContent !== text) this.progress.textContent = text;
    refill(this.tiles, list.map((one, i) => h('li', h('button', {
      type: 'button', class: all[i].due || this.#isMeasured(i) ? '' : 'not-due', 'aria-current': i === this.at && !this.finished && 'step', onclick: () => this.go(i),
    }, verdicts[i] ? [verdictShape(verdicts[i]), h('span.unseen', t(`verdict.${verdicts[i]}`))] : null,
    h('span', one.name), h('span.aside', sizeText(one)), this.#whenText(one, all[i], i)))));
    this.tiles.querySelector('[aria-current]')?.scrollIntoView?.({ block: 'nearest', inline: 'nearest' });
    this.#wake(all);
  }

  #progressText(all) {
    const due = all.map((_, i) => i).filter((i) => this.#isTaken(i) || all[i].due || (i === this.at && !this.finished));
    const count = all.filter((_, i) => this.#isTaken(i)).length;
    if (!this.finished) return [t('plan.progress', { at: due.indexOf(this.at) + 1, count: due.length }), this.#sampleText(all[this.at])].filter(Boolean).join(' · ');
    return count === all.length ? t('plan.finished', { count }) : count ? t('plan.finished_due', { count }) : t('plan.nothing_due');
  }

  /** How often a characteristic is measured, and whether it is due. */
  #whenText(one, { due, parts, until, at, size }, i) {
    if (!one.frequency && size === 1) return null;
    const next = parts > 1 ? t('plan.in_parts', { count: parts }) : until ? t('plan.from', { time: timeOfDay(new Date(until)) }) : t('plan.next_part');
    return h('span.aside.when', [one.frequency, size > 1 && (at ? t('plan.sample', { at: Math.min(at + 1, size), size }) : t('plan.sample_of', { size })),
      this.#isMeasured(i) ? '' : due ? t('plan.due') : next].filter(Boolean).join(' · '));
  }

  /** What becomes due by the clock says so then. */
  #wake(all) {
    clearTimeout(this.timer);
    const until = Math.min(...all.map((each) => each.until ?? Infinity));
    if (Number.isFinite(until)) this.timer = setTimeout(() => untilLifted().then(() => this.#renew()), Math.min(Math.max(until - connection.now() + 50, 50), LONGEST_SLEEP_MS));
  }
}
