/** What is gauged: the part first, then size and class, and the fields that go into every record. */

import { explain, number, t } from '../i18n.js';
import { field, h, refill } from '../dom.js';
import { getJson, url } from '../api.js';
import { Latest } from '../latest.js';
import { designationText, isOpen, isThread, parseDesignation } from '../designation.js';
import { nmFromMm, nmFromUm, parseMeasured } from '../exact.js';
import { readJson, store } from '../stored.js';
import { limitsText, toleranceText } from '../verdict.js';
import { gaugeInUse, gaugeNames, gaugeText } from './in_use.js';
import { PREFIXES } from './reading.js';

const ECHO_MS = 150;
const COVERAGE = 2;
const MOST_OFFERED = 200;
const KEPT_LIMITS = 'limits';
const KEPT_PREFIXES = 'prefixes';
/** Which side of the material is measured: where the designation does not say. */
const SIDES = ['shaft', 'hole'];
const SIDE_FIELDS = ['characteristic', 'order', 'operation', 'machine', 'operator', 'gauge'];
export const FIELDS = ['part_id', ...SIDE_FIELDS];

/** The values a field had in records, for its pick list. */
const recordedNames = async (name) => {
  const { groups } = await getJson(url(['measurements', 'summary'], { group_by: name }), { asks: false });
  return groups.map((group) => group[name]).filter(Boolean).slice(0, MOST_OFFERED);
};

export class Job {
  /**
   * @param choices what else stands among the fields
   * @param onChange is told of every change, with whether another thing is gauged now; @param onDone when Enter ends the typing
   */
  constructor({ designation, options, choices, onChange, onDone }) {
    this.onChange = onChange;
    this.limits = null;
    this.reason = '';
    this.input = h('input.designation', {
      id: 'designation', type: 'text', autocomplete: 'off', autocapitalize: 'off', spellcheck: 'false',
      'aria-describedby': 'echo', oninput: () => this.#typed(), onfocus: () => this.input.select(),
    });
    this.input.value = designation;
    this.echo = h('p.echo', { id: 'echo', role: 'status' });
    this.inputs = Object.fromEntries(FIELDS.map((name) => [name, textField(name, () => this.#changed())]));
    this.inputs.part_id.classList.add('part');
    this.rule = h('select', { name: 'rule', onchange: () => this.#ruleChanged() },
      ['simple', 'guard_band'].map((rule) => h('option', { value: rule }, t(`rule.${rule}`))));
    this.uncertainty = h('input', {
      type: 'text', inputmode: 'decimal', name: 'uncertainty_um', autocomplete: 'off', onchange: () => this.#changed(),
    });
    this.side = h('select', { name: 'feature', onchange: () => this.#show(this.read, this.reason) },
      SIDES.map((side) => h('option', { value: side, selected: side === options.feature }, t(`job.side.${side}`))));
    this.sideField = field(t('job.side'), this.side);
    this.sideField.hidden = true;
    for (const name of FIELDS) this.inputs[name].value = options[name] ?? '';
    this.rule.value = options.rule === 'guard_band' ? 'guard_band' : 'simple';
    this.uncertainty.value = options.uncertainty_um ?? '';
    this.prefixInputs = Object.fromEntries(Object.keys(PREFIXES).map((name) => [name,
      textField(`prefix_${name}`, () => this.#keepPrefixes(), { maxlength: 10 })]));
    for (const [name, prefix] of Object.entries({ ...PREFIXES, ...readJson(KEPT_PREFIXES, {}) })) {
      if (this.prefixInputs[name]) this.prefixInputs[name].value = prefix;
    }
    this.given = h('p.aside');
    this.gaugeNote = h('p.gauge-note', { role: 'status' });
    this.offered = Object.fromEntries(SIDE_FIELDS.map((name) => [name, h('datalist', { id: `offered-${name}` })]));
    for (const name of SIDE_FIELDS) this.inputs[name].setAttribute('list', this.offered[name].id);
    this.more = h('details.more', h('summary', t('job.more')),
      h('div.fields', SIDE_FIELDS.map((name) => field(t(`field.${name}`), this.inputs[name])),
        field(t('field.rule'), this.rule), field(t('field.uncertainty_um'), this.uncertainty)),
      h('div.choices', choices),
      h('fieldset.fields', h('legend.label', t('job.prefixes')),
        Object.entries(this.prefixInputs).map(([name, input]) => field(t(`field.${name}`), input))));
    this.element = h('form.job', {
      novalidate: true,
      onsubmit: (event) => {
        event.preventDefault();
        this.#look();
        onDone();
      },
    }, h('div.line', field(t('field.part_id'), this.inputs.part_id), field(t('job.designation'), this.input), this.sideField, this.echo),
    h('div.more-line', this.more, this.given, this.gaugeNote), Object.values(this.offered),
    h('button.unseen', { type: 'submit', tabindex: -1 }, t('entry.judge')));
    this.uncertainty.disabled = this.rule.value === 'simple';
    this.gauged = this.#gauged();
  }

  /** Begins to say how the designation is understood. */
  start(leaving) {
    this.asking = new Latest(leaving);
    this.#look();
    this.#lookAtGauge();
    this.more.addEventListener('toggle', () => this.more.open && this.#offer());
  }

  /** Offers what can be chosen: the gauges in use, and in the other fields what was recorded before. */
  #offer() {
    const offers = (name, values) => refill(this.offered[name], values.map((value) => h('option', { value })));
    gaugeNames().then((names) => offers('gauge', names), () => {});
    for (const name of SIDE_FIELDS.filter((each) => each !== 'gauge')) {
      recordedNames(name).then((values) => offers(name, values), () => {});
    }
  }

  /** A key was entered: what needed one can be asked now. */
  keyed() {
    this.gaugeShown = undefined;
    this.#lookAtGauge();
    if (this.more.open) this.#offer();
  }

  /** Leaves the room to the verdict. */
  fold() {
    this.more.open = false;
  }

  /** Fills in a field, as if it had been typed. */
  set(name, text) {
    this.inputs[name].value = text;
    this.#changed();
  }

  /** Gauges another size from now on, if there is such a one. @returns whether there is; undefined where nobody can say */
  async adopt(text) {
    const limits = await this.#limitsOf(parseDesignation(text).text).catch(() => false);
    if (!limits) return limits === false ? false : undefined;
    this.input.value = text;
    this.#show(limits, '');
    return true;
  }

  /** The limits the service gives, or gave last where it is away. */
  async #limitsOf(text) {
    const kept = `${KEPT_LIMITS}.${text}`;
    try {
      const limits = await getJson(url(['limits', text]));
      store(kept, JSON.stringify(limits));
      return limits;
    } catch (problem) {
      if (problem.status !== undefined) throw problem;
      return readJson(kept, null);
    }
  }

  get designation() {
    return this.input.value.trim();
  }

  /** Gauges a characteristic of a plan from now on. */
  follow(one, limits) {
    this.own = limits;
    this.limits = null;
    this.side.value = one.feature ?? SIDES[0];
    this.input.value = one.designation ?? (limits ? '' : `${one.nominal_mm}${one.tolerance_class}`);
    this.inputs.characteristic.value = one.name;
    // What a plan does not name is measured with the station's own gauge, not with that of the one before.
    if (this.inputs.gauge.value !== this.planGauge) this.ownGauge = this.inputs.gauge.value;
    this.planGauge = one.gauge ?? this.ownGauge;
    this.inputs.gauge.value = this.planGauge;
    this.rule.value = one.rule ?? 'simple';
    this.uncertainty.value = one.uncertainty_um ?? '';
    this.uncertainty.disabled = this.rule.value === 'simple';
    this.#look();
  }

  get part() {
    return this.inputs.part_id.value.trim();
  }

  /** {field: prefix} of scans. */
  get prefixes() {
    return Object.fromEntries(Object.entries(this.prefixInputs).map(([name, input]) => [name, input.value.trim()]));
  }

  /** Everything but the designation, as the URL has it. */
  get options() {
    const options = Object.fromEntries(FIELDS.map((name) => [name, this.inputs[name].value.trim()]));
    if (isOpen(this.limits)) options.feature = this.side.value;
    if (this.rule.value === 'simple') return options;
    return { ...options, rule: 'guard_band', uncertainty_um: this.uncertainty.value.trim() };
  }

  /** What the next value is judged by: {text, nominal_nm, limits, uncertainty}, or {reason} why it can't be. */
  current() {
    const parsed = this.own ? { own: this.own, nominal_nm: nmFromMm(this.own.nominal_mm) } : parseDesignation(this.designation);
    if (!parsed) return { reason: this.designation ? t('error.designation.malformed') : t('job.missing') };
    if (this.reason) return { reason: this.reason };
    const job = { ...parsed, limits: this.limits, ...(isOpen(parsed) && { feature: this.side.value }) };
    if (this.rule.value === 'simple') return job;
    const uncertainty = parseMeasured(this.uncertainty.value);
    return uncertainty === null ? { reason: t('job.uncertainty_missing') } : { ...job, uncertainty };
  }

  /** The guard band in nm, NaN where it is no whole number of them. */
  get guard() {
    if (this.rule.value === 'simple') return 0;
    const typed = parseMeasured(this.uncertainty.value);
    return typed === null || (typed.split('.')[1] ?? '').length > 3 ? NaN : COVERAGE * nmFromUm(typed);
  }

  /** Asks again for the limits held: somebody may have stored a column of the shop's own. */
  renew() {
    if (this.limits) this.#look();
  }

  #gauged() {
    const { upper_limit_mm: upper, lower_limit_mm: lower } = this.limits ?? {};
    return JSON.stringify([this.designation, this.limits?.feature, this.part, this.inputs.characteristic.value.trim(), upper, lower]);
  }

  #changed() {
    const given = Object.entries(this.options).filter(([name, value]) => value && !['part_id', 'feature'].includes(name));
    this.given.textContent = given.map(([name, value]) =>
      (name === 'rule' ? t(`rule.${value}`) : `${t(`field.${name}`)} ${value}`)).join(' · ');
    this.#lookAtGauge();
    const gauged = this.#gauged();
    const another = gauged !== this.gauged;
    this.gauged = gauged;
    this.onChange(another);
  }

  /** Says until when the gauge is calibrated; a guard band without an uncertainty takes that of the gauge. */
  #lookAtGauge() {
    const name = this.inputs.gauge.value.trim();
    if (name === this.gaugeShown || !this.asking) return;
    this.gaugeShown = name;
    this.gaugeNote.textContent = '';
    this.asking.run((signal) => gaugeInUse(name, signal)).then((gauge) => {
      if (gauge === undefined) return;
      this.gaugeNote.textContent = gauge ? gaugeText(gauge) : '';
      this.gaugeNote.classList.toggle('overdue', Boolean(gauge?.overdue));
      if (!gauge?.uncertainty_um || this.rule.value === 'simple' || ![this.filled, ''].includes(this.uncertainty.value.trim())) return;
      this.filled = gauge.uncertainty_um;
      this.uncertainty.value = this.filled;
      this.#changed();
    }, (problem) => { this.gaugeNote.textContent = explain(problem); });
  }

  #keepPrefixes() {
    store(KEPT_PREFIXES, JSON.stringify(this.prefixes));
  }

  #typed() {
    clearTimeout(this.timer);
    this.reason = '';
    this.limits = null;
    this.timer = setTimeout(() => this.#look(), ECHO_MS);
  }

  #ruleChanged() {
    this.uncertainty.disabled = this.rule.value === 'simple';
    this.gaugeShown = undefined;
    this.#changed();
  }

  /** Asks the service what was typed, and says how it was understood. */
  async #look() {
    clearTimeout(this.timer);
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
    try {
      const limits = await this.#limitsOf(parsed.text);
      if (typed === this.designation) this.#show(limits, '');
    } catch (problem) {
      if (typed === this.designation) this.#show(null, explain(problem));
    }
  }

  #show(limits, reason) {
    this.read = limits;
    this.sideField.hidden = !isOpen(limits);
    this.limits = isOpen(limits) ? { ...limits, feature: this.side.value } : limits;
    this.reason = reason;
    this.echo.classList.toggle('wrong', reason !== '');
    this.echo.replaceChildren(...(limits ? this.#understood(this.limits) : [reason || (this.designation ? '' : t('job.missing'))]));
    this.#changed();
  }

  #understood(limits) {
    return [
      h('strong', limits.designation ? designationText(limits.designation) : number(limits.nominal_mm)),
      h('span', [t(`feature.${limits.feature}`), isThread(limits) && t('job.pitch_diameter')].filter(Boolean).join(', ')),
      h('span.figures', limitsText(limits)),
      limits.tolerance_um !== undefined && h('span.tolerance', t('limits.tolerance', { um: toleranceText(limits) })),
      limits.basis === 'custom' && h('span.own-basis', t('limits.custom')),
      limits.basis === 'standard' && h('span.tolerance', limits.table_revision.replace(/-[^-]*$/, '')),
    ].filter(Boolean);
  }
}

/** A field that a scan replaces instead of lengthening it. */
function textField(name, onchange, attributes = {}) {
  const input = h('input', {
    type: 'text', name, autocomplete: 'off', autocapitalize: 'off', spellcheck: 'false', maxlength: 200, onchange, ...attributes,
    onfocus: () => input.select(),
  });
  return input;
}
