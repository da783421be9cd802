/** What is measured at a part, in order: the plan of a part number, which of its characteristics is next, and how each was. */

import { getJson, url } from '../api.js';
import { h, refill } from '../dom.js';
import { designationText } from '../designation.js';
import { mmText, nmFromMm, nmFromUm, umText } from '../exact.js';
import { number, signed, t } from '../i18n.js';
import { readJson, store } from '../stored.js';
import { limitsText, verdictShape } from '../verdict.js';
import { held } from './held.js';

const KEPT_LIST = 'plans';
const KEPT_STATE = 'plan-at';

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
    nominal_mm: one.nominal_mm, feature: one.feature, basis: 'explicit',
    ...(upper !== undefined && { upper_deviation_um: one.upper_um, upper_limit_mm: mmText(nominal + upper, 0) }),
    ...(lower !== undefined && { lower_deviation_um: one.lower_um, lower_limit_mm: mmText(nominal + lower, 0) }),
    ...(upper !== undefined && lower !== undefined && { tolerance_um: umText(upper - lower) }),
  };
}

/** The plan of a part number; undefined where there is none. */
const planOf = (part) => held(['plans', part]).catch(() => undefined);

export class Plan {
  /** @param onStep is told that another characteristic is next; @param onChoose takes a part number, or '' for none */
  constructor({ onStep, onChoose }) {
    this.onStep = onStep;
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
   * @param subject the part that is measured; @param again whether to go on where it was left: after a reload
   * @returns whether it has: another may be asked for meanwhile
   */
  async load(part, subject, again = false) {
    const asked = Symbol(part);
    this.asked = asked;
    const plan = part ? await planOf(part) : undefined;
    if (this.asked !== asked) return false;
    this.asked = undefined;
    const { missing } = this;
    this.plan = plan;
    if (again && plan && this.#resume(subject)) return true;
    this.begin(subject, missing);
    if (part && !plan) this.note.textContent = t('plan.gone', { part });
    return true;
  }

  /** Another part: from the first characteristic on. Says what was not measured at the one before. */
  begin(subject, missing = this.missing) {
    this.note.textContent = missing.length ? t('plan.missing', { part: this.subject || t('part.none'), names: missing.join(', ') }) : '';
    this.subject = subject;
    this.#clear();
    this.go(0);
  }

  #clear() {
    this.at = 0;
    this.verdicts = [];
    this.taken = [];
  }

  /** The names of what was not measured at a part that was begun. */
  get missing() {
    return this.taken.some(Boolean) ? this.plan.characteristics.filter((_, i) => !this.taken[i]).map(({ name }) => name) : [];
  }

  /** Goes on where this window was with this part. @returns whether it was there */
  #resume(subject) {
    const kept = readJson(KEPT_STATE, {}, 'session');
    if (kept.part !== this.part || kept.subject !== subject || !this.plan.characteristics[kept.at]) return false;
    Object.assign(this, { subject, verdicts: kept.verdicts, taken: kept.taken });
    this.go(kept.at, kept.finished);
    return true;
  }

  /** A value of the current characteristic is on its way: the next one that has none. */
  step() {
    if (!this.plan) return;
    this.taken[this.at] = true;
    const { length } = this.plan.characteristics;
    const next = Array.from({ length }, (_, i) => (this.at + 1 + i) % length).find((at) => !this.taken[at]);
    this.go(next ?? 0, next === undefined);
  }

  /** A value of a characteristic was not stored: it is still to be measured. */
  refused(name) {
    const at = this.plan?.characteristics.findIndex((one) => one.name === name) ?? -1;
    if (at < 0) return;
    this.taken[at] = false;
    if (this.finished) this.go(at);
  }

  /** Notes how a characteristic was, by its name. */
  judged(name, verdict) {
    const at = this.plan?.characteristics.findIndex((one) => one.name === name) ?? -1;
    if (at < 0) return;
    this.verdicts[at] = verdict;
    this.#draw();
    this.#keep();
  }

  #keep() {
    const { part, subject, at, finished, verdicts, taken } = this;
    store(KEPT_STATE, JSON.stringify({ part, subject, at, finished, verdicts, taken }), 'session');
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
    const text = !list.length ? '' : this.finished ? t('plan.finished', { count: list.length }) : t('plan.progress', { at: this.at + 1, count: list.length });
    if (this.progress.textContent !== text) this.progress.textContent = text;
    refill(this.tiles, list.map((one, i) => h('li', h('button', {
      type: 'button', 'aria-current': i === this.at && !this.finished && 'step', onclick: () => this.go(i),
    }, this.verdicts[i] ? [verdictShape(this.verdicts[i]), h('span.unseen', t(`verdict.${this.verdicts[i]}`))] : null,
    h('span', one.name), h('span.aside', sizeText(one))))));
    this.tiles.querySelector('[aria-current]')?.scrollIntoView?.({ block: 'nearest', inline: 'nearest' });
  }
}
