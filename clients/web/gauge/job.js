/** What is gauged: the part first, then size and class, the rule, and the fields that go into every record. */

import { designationText, isOpen, isThread, parseDesignation } from '../designation.js';
import { field, h } from '../dom.js';
import { nmFromMm } from '../exact.js';
import { explain, number, t } from '../i18n.js';
import { Latest } from '../latest.js';
import { limitsText, toleranceText } from '../verdict.js';
import { Envelope } from './envelope.js';
import { Fields } from './fields.js';
import { limitsAtHand, limitsOf } from './held.js';
import { gaugeInUse, gaugeText } from './in_use.js';
import { designationOf } from './plan.js';
import { Prefixes } from './prefixes.js';
import { Rule } from './rule.js';

const ECHO_MS = 150;
/** After an answer that did not come. */
const AGAIN_MS = 2000;
/** Which side of the material is measured: where the designation does not say. */
const SIDES = ['shaft', 'hole'];

export class Job {
  /**
   * @param choices what else stands among the fields
   * @param onChange is told of every change, with whether another thing is gauged now; @param onDone when Enter ends the typing
   * @param named takes a text that was typed where a name goes, and whether its line was ended; gives the name, null for none
   */
  constructor({ designation, options, choices, onChange, onDone, named }) {
    this.onChange = onChange;
    this.limits = null;
    this.reason = '';
    this.input = h('input.designation', {
      id: 'designation', type: 'text', autocomplete: 'off', autocapitalize: 'off', spellcheck: 'false',
      'aria-describedby': 'echo', oninput: () => this.#typed(), onfocus: () => this.input.select(),
    });
    this.input.value = designation;
    this.echo = h('p.echo', { id: 'echo', role: 'status' });
    this.fields = new Fields(options, { onChange: () => this.#changed(), named });
    this.rule = new Rule(options, { onChange: () => this.#changed(), onRule: () => this.#ruleChanged() });
    this.prefixes = new Prefixes();
    this.envelope = new Envelope(() => {
      this.#changed();
      onDone();
    });
    this.side = h('select', { name: 'feature', onchange: () => this.#show(this.read, this.reason) },
      SIDES.map((side) => h('option', { value: side, selected: side === options.feature }, t(`job.side.${side}`))));
    this.sideField = field(t('job.side'), this.side);
    this.sideField.hidden = true;
    this.given = h('p.aside');
    this.gaugeNote = h('p.gauge-note', { role: 'status' });
    this.more = h('details.more', h('summary', t('job.more')),
      h('div.fields', this.fields.side, this.rule.fields), h('div.choices', choices), this.prefixes.element);
    this.element = h('form.job', {
      novalidate: true,
      onsubmit: (event) => {
        event.preventDefault();
        this.#look();
        onDone();
      },
    }, h('div.line', this.fields.part, field(t('job.designation'), this.input), this.sideField, this.envelope.element, this.echo),
    h('div.more-line', this.more, this.given, this.gaugeNote), Object.values(this.fields.lists),
    h('button.unseen', { type: 'submit', tabindex: -1 }, t('entry.judge')));
    this.gauged = this.#gauged();
  }

  /** Begins to say how the designation is understood. */
  start(leaving) {
    this.leaving = leaving;
    leaving.addEventListener('abort', () => clearTimeout(this.timer));
    this.asking = new Latest(leaving);
    this.#look();
    this.#lookAtGauge();
    this.more.addEventListener('toggle', () => this.more.open && this.fields.offer());
  }

  /** A key was entered: what needed one can be asked now. */
  keyed() {
    this.gaugeShown = undefined;
    this.#lookAtGauge();
    if (this.more.open) this.fields.offer();
  }

  /** Leaves the room to the verdict. */
  fold() {
    this.more.open = false;
  }

  /** Fills in a field, as if it had been typed. */
  set(name, text) {
    this.fields.set(name, text);
    this.#changed();
  }

  /** Gauges another size from now on, if there is such a one. @returns whether there is; undefined where nobody can say */
  async adopt(text) {
    const { value } = this.input;
    const limits = await limitsOf(parseDesignation(text).text).catch(() => false);
    if (this.input.value !== value) return true; // another size was chosen meanwhile
    if (!limits) return limits === false ? false : undefined;
    this.input.value = text;
    this.#show(limits, '');
    return true;
  }

  get designation() {
    return this.input.value.trim();
  }

  get part() {
    return this.fields.of('part_id');
  }

  /** Gauges a characteristic of a plan from now on. */
  follow(one, limits) {
    Object.assign(this, { own: limits, limits: null, asked: one });
    this.side.value = one.feature ?? SIDES[0];
    this.input.value = designationOf(one);
    this.fields.set('characteristic', one.name);
    // What a plan does not name is measured with the station's own gauge, not with that of the one before.
    if (this.fields.of('gauge') !== this.planGauge) this.ownGauge = this.fields.of('gauge');
    this.planGauge = one.gauge ?? this.ownGauge;
    this.fields.set('gauge', this.planGauge);
    this.rule.set(one);
    const held = limits ? null : limitsAtHand(parseDesignation(this.designation)?.text);
    if (held) this.#show(held, '');
    this.#look();
  }

  /** Gauges without a plan from now on: what the plan asked and its own limits end. */
  leavePlan() {
    if (!this.asked) return;
    Object.assign(this, { own: null, asked: null });
    this.#look();
  }

  /** Everything but the designation, as the URL has it. */
  get options() {
    return { ...this.fields.texts, ...(isOpen(this.limits) && { feature: this.side.value }), ...this.rule.options };
  }

  /** All that goes into the next record besides the value, to be compared. */
  get subject() {
    return JSON.stringify([this.#gauged(), this.options, this.envelope.said, this.envelope.operator.value]);
  }

  /** What the next value is judged by: {text, nominal_nm, limits}, or {reason} why it can't be. */
  current() {
    const parsed = this.own ? { own: this.own, nominal_nm: nmFromMm(this.own.nominal_mm) } : parseDesignation(this.designation);
    if (!parsed) return { reason: this.designation ? t('error.designation.malformed') : t('job.missing') };
    if (this.reason) return { reason: this.reason };
    if (this.rule.reason) return { reason: this.rule.reason };
    if (this.looking && !this.limits) return { reason: t('entry.busy') };
    return { ...parsed, limits: this.limits, ...(isOpen(parsed) && { feature: this.side.value }) };
  }

  /** Asks again for the limits held: somebody may have stored a custom tolerance class. */
  renew() {
    if (this.limits) this.#look();
  }

  #gauged() {
    const { upper_limit_mm: upper, lower_limit_mm: lower } = this.limits ?? {};
    return JSON.stringify([this.designation, this.limits?.feature, this.part, this.fields.of('characteristic'), upper, lower]);
  }

  #changed() {
    this.#lookAtGauge();
    const given = Object.entries(this.options).filter(([name, value]) => value && !['part_id', 'feature'].includes(name));
    this.given.textContent = given.map(([name, value]) =>
      (name === 'rule' ? t(`rule.${value}`) : `${t(`field.${name}`)} ${value}`)).join(' · ');
    const gauged = this.#gauged();
    const another = gauged !== this.gauged;
    this.gauged = gauged;
    if (another) this.envelope.say(undefined);
    this.onChange(another);
  }

  /** Says until when the gauge is calibrated; a guard band without an uncertainty takes that of the gauge. */
  #lookAtGauge() {
    const name = this.fields.of('gauge');
    if (name === this.gaugeShown || !this.asking) return;
    this.gaugeShown = name;
    this.gaugeNote.textContent = '';
    this.rule.unfill();
    this.asking.run((signal) => gaugeInUse(name, signal)).then((gauge) => {
      if (gauge === undefined) return;
      this.gaugeNote.textContent = gauge ? gaugeText(gauge) : '';
      this.gaugeNote.classList.toggle('overdue', Boolean(gauge?.overdue));
      if (gauge?.uncertainty_um && this.rule.fill(gauge.uncertainty_um)) this.#changed();
    }, (problem) => { this.gaugeNote.textContent = explain(problem); });
  }

  #typed() {
    clearTimeout(this.timer);
    this.reason = '';
    this.limits = null;
    this.#isLooking(true);
    this.timer = setTimeout(() => this.#look(), ECHO_MS);
  }

  #ruleChanged() {
    this.gaugeShown = undefined;
    this.#changed();
  }

  /**
   * Asks the service what was typed, and says how it was understood.
   * @param again where nobody could say: values are taken meanwhile
   */
  async #look(again = false) {
    clearTimeout(this.timer);
    const look = this.last = Symbol('look');
    const typed = this.designation;
    const parsed = parseDesignation(typed);
    if (typed) this.own = null;
    if (this.own) {
      this.#show(this.own, '');
      return;
    }
    if (!parsed) {
      this.#show(null, typed ? t('error.designation.malformed') : '');
      return;
    }
    if (!again) this.#isLooking(true);
    // Only the last question counts: what was asked before may be of another size, or of tables that have changed.
    try {
      const limits = await limitsOf(parsed.text);
      if (look !== this.last || typed !== this.designation) return;
      if (limits || !again) this.#show(limits, '');
      if (!limits && !this.leaving.aborted) this.timer = setTimeout(() => this.#look(true), AGAIN_MS);
    } catch (problem) {
      if (look === this.last && typed === this.designation) this.#show(null, explain(problem));
    }
  }

  #isLooking(looking) {
    this.looking = looking;
    this.echo.ariaBusy = looking ? 'true' : null;
  }

  #show(limits, reason) {
    this.#isLooking(false);
    this.read = limits;
    this.sideField.hidden = !isOpen(limits);
    this.limits = isOpen(limits) ? { ...limits, feature: this.side.value } : limits;
    this.reason = reason;
    this.echo.classList.toggle('wrong', reason !== '');
    // What a plan asks holds for its own size.
    const asked = this.asked && designationOf(this.asked) === this.designation ? this.asked : {};
    const required = Boolean(limits) && (asked.envelope !== undefined || Boolean(parseDesignation(this.designation)?.envelope));
    this.isInsideCorner = Boolean(limits) && asked.inside_corner === true;
    this.envelope.show(required, limits ? asked.size_operator : undefined);
    this.echo.replaceChildren(...(limits ? understood(this.limits, required) : [reason || (this.designation ? '' : t('job.missing'))]));
    this.#changed();
  }
}

/** How a designation was understood. */
const understood = (limits, envelope) => [
  h('strong', `${limits.designation ? designationText(limits.designation) : number(limits.nominal_mm)}${envelope ? ' (E)' : ''}`),
  h('span', [limits.feature && t(`feature.${limits.feature}`), isThread(limits) && t('job.pitch_diameter')].filter(Boolean).join(', ')),
  h('span.figures', limitsText(limits)),
  limits.tolerance_um !== undefined && h('span.tolerance', t('limits.tolerance', { um: toleranceText(limits) })),
  limits.basis === 'custom' && h('span.own-basis', t('limits.custom')),
  limits.basis === 'standard' && h('span.tolerance', limits.table_revision.replace(/-[^-]*$/, '')),
].filter(Boolean);
