/** What is gauged: size and class typed freely, and the fields that go into every record. */

import { explain, number, t } from '../i18n.js';
import { field, h } from '../dom.js';
import { getJson, url } from '../api.js';
import { parseDesignation } from '../designation.js';
import { parseMeasured } from '../exact.js';
import { limitsText, toleranceText } from '../verdict.js';

const ECHO_MS = 150;
export const FIELDS = ['part_id', 'characteristic', 'order', 'operation', 'machine', 'operator', 'gauge'];

export class Job {
  /** @param onChange is told of every change; @param onDone when Enter ends the typing */
  constructor({ designation, options, onChange, onDone }) {
    this.onChange = onChange;
    this.limits = null;
    this.reason = '';
    this.input = h('input.designation', {
      id: 'designation', type: 'text', autocomplete: 'off', autocapitalize: 'off', spellcheck: 'false',
      value: designation, 'aria-describedby': 'echo', oninput: () => this.#typed(), onfocus: () => this.input.select(),
    });
    this.input.value = designation;
    this.echo = h('p.echo', { id: 'echo', role: 'status' });
    this.inputs = Object.fromEntries(FIELDS.map((name) => [name,
      h('input', { type: 'text', name, autocomplete: 'off', maxlength: 200, onchange: () => this.#changed() })]));
    this.rule = h('select', { name: 'rule', onchange: () => this.#ruleChanged() },
      ['simple', 'guard_band'].map((rule) => h('option', { value: rule }, t(`rule.${rule}`))));
    this.uncertainty = h('input', {
      type: 'text', inputmode: 'decimal', name: 'uncertainty_um', autocomplete: 'off', onchange: () => this.#changed(),
    });
    for (const name of FIELDS) this.inputs[name].value = options[name] ?? '';
    this.rule.value = options.rule === 'guard_band' ? 'guard_band' : 'simple';
    this.uncertainty.value = options.uncertainty_um ?? '';
    this.given = h('p.aside');
    this.more = h('details.more', h('summary', t('job.more')),
      h('div.fields', FIELDS.map((name) => field(t(`field.${name}`), this.inputs[name])),
        field(t('field.rule'), this.rule), field(t('field.uncertainty_um'), this.uncertainty)));
    this.element = h('form.job', {
      novalidate: true,
      onsubmit: (event) => {
        event.preventDefault();
        this.#look();
        onDone();
      },
    }, h('div.line', field(t('job.designation'), this.input), this.echo),
    h('div.more-line', this.more, this.given),
    h('button.unseen', { type: 'submit', tabindex: -1 }, t('entry.judge')));
    this.uncertainty.disabled = this.rule.value === 'simple';
  }

  /** Begins to say how the designation is understood. */
  start() {
    this.#look();
  }

  /** Leaves the room to the verdict. */
  fold() {
    this.more.open = false;
  }

  #changed() {
    const given = Object.entries(this.options).filter(([, value]) => value);
    this.given.textContent = given.map(([name, value]) =>
      (name === 'rule' ? t(`rule.${value}`) : `${t(`field.${name}`)} ${value}`)).join(' · ');
    this.onChange();
  }

  get designation() {
    return this.input.value.trim();
  }

  /** Everything but the designation, as the URL has it. */
  get options() {
    const options = Object.fromEntries(FIELDS.map((name) => [name, this.inputs[name].value.trim()]));
    if (this.rule.value === 'simple') return options;
    return { ...options, rule: 'guard_band', uncertainty_um: this.uncertainty.value.trim() };
  }

  /** What the next value is judged by: {text, nominal_nm, uncertainty}, or {reason} why it can't be. */
  current() {
    const parsed = parseDesignation(this.designation);
    if (!parsed) return { reason: this.designation ? t('error.designation.malformed') : t('job.missing') };
    if (this.reason) return { reason: this.reason };
    if (this.rule.value === 'simple') return parsed;
    const uncertainty = parseMeasured(this.uncertainty.value);
    return uncertainty === null ? { reason: t('job.uncertainty_missing') } : { ...parsed, uncertainty };
  }

  #typed() {
    clearTimeout(this.timer);
    this.reason = '';
    this.timer = setTimeout(() => this.#look(), ECHO_MS);
  }

  #ruleChanged() {
    this.uncertainty.disabled = this.rule.value === 'simple';
    this.#changed();
  }

  /** Asks the service what was typed, and says how it was understood. */
  async #look() {
    clearTimeout(this.timer);
    const typed = this.designation;
    const parsed = parseDesignation(typed);
    if (!parsed) {
      this.#show(null, typed ? t('error.designation.malformed') : t('job.missing'));
      return;
    }
    try {
      const limits = await getJson(url(['limits', parsed.text]));
      if (typed === this.designation) this.#show(limits, '');
    } catch (problem) {
      if (typed !== this.designation) return;
      // A service that is away says nothing about the designation: values may queue.
      this.#show(null, problem.status === undefined ? '' : explain(problem));
    }
  }

  #show(limits, reason) {
    this.limits = limits;
    this.reason = reason;
    this.echo.classList.toggle('wrong', reason !== '');
    this.echo.replaceChildren(...(limits ? this.#understood(limits) : [reason]));
    this.#changed();
  }

  #understood(limits) {
    return [
      h('strong', `Ø ${number(limits.designation)}`),
      h('span', t(`feature.${limits.feature}`)),
      h('span.figures', limitsText(limits)),
      h('span', t('limits.tolerance', { um: toleranceText(limits) })),
      limits.basis === 'custom' && h('span', t('limits.custom')),
    ].filter(Boolean);
  }
}
