/** The rule a value is judged by, with the uncertainty and the coverage factor that it needs. */

import { field, h } from '../dom.js';
import { Decimal, nmFromUm, parseMeasured } from '../exact.js';
import { number, t } from '../i18n.js';

const RULES = ['simple', 'guard_band', 'conformance'];
const COVERAGE = '2';
const THOUSAND = 1000;

export class Rule {
  /** @param given `rule`, `uncertainty_um` and `coverage_factor` of the address; @param onChange is told of other numbers; @param onRule of another rule */
  constructor(given, { onChange, onRule }) {
    this.select = h('select', { name: 'rule', onchange: () => {
      this.#allow();
      onRule();
    } }, RULES.map((rule) => h('option', { value: rule }, t(`rule.${rule}`))));
    const decimal = (name, placeholder) => h('input', { type: 'text', inputmode: 'decimal', name, autocomplete: 'off', placeholder, onchange: onChange });
    this.uncertainty = decimal('uncertainty_um');
    this.coverage = decimal('coverage_factor', number(COVERAGE));
    this.fields = [field(t('field.rule'), this.select), field(t('field.uncertainty_um'), this.uncertainty), field(t('field.coverage_factor'), this.coverage)];
    this.set(given);
  }

  set({ rule, uncertainty_um, coverage_factor }) {
    this.select.value = RULES.includes(rule) ? rule : 'simple';
    this.uncertainty.value = uncertainty_um ?? '';
    this.coverage.value = coverage_factor ?? '';
    this.filled = undefined;
    this.#allow();
    this.fill(this.ofGauge);
  }

  /** Takes the uncertainty of a gauge, now and for each rule to come, unless somebody has typed one or none is needed. @returns whether it took it now */
  fill(um) {
    this.ofGauge = um;
    if (!um || this.isSimple || this.uncertainty.value.trim()) return false;
    this.filled = um;
    this.uncertainty.value = um;
    return true;
  }

  /** Another gauge: what the one before gave is none of its own. */
  unfill() {
    if (this.filled !== undefined && this.uncertainty.value.trim() === this.filled) this.uncertainty.value = '';
    this.filled = this.ofGauge = undefined;
  }

  get isSimple() {
    return this.select.value === 'simple';
  }

  /** Only a guard band has a factor of its own. */
  get #factor() {
    return this.select.value === 'guard_band' ? this.coverage.value.trim() : '';
  }

  /** Why nothing can be judged by it; '' where something can. */
  get reason() {
    if (this.isSimple) return '';
    if (parseMeasured(this.uncertainty.value) === null) return t('job.uncertainty_missing');
    return this.#factor && parseMeasured(this.#factor) === null ? t('job.coverage_wrong') : '';
  }

  /** As the URL has it. */
  get options() {
    return this.isSimple ? {} : { rule: this.select.value, uncertainty_um: this.uncertainty.value.trim(), coverage_factor: this.#factor };
  }

  /** As a measurement has it. */
  get body() {
    if (this.isSimple) return {};
    const factor = this.#factor && { coverage_factor: new Decimal(parseMeasured(this.#factor)) };
    return { rule: this.select.value, uncertainty_um: new Decimal(parseMeasured(this.uncertainty.value)), ...factor };
  }

  /** k times u in nm; NaN where it is no whole number of them, and where the rule is not judged by one. */
  get guard() {
    if (this.isSimple) return 0;
    const decimals = [parseMeasured(this.uncertainty.value), parseMeasured(this.#factor || COVERAGE)];
    const exact = decimals.every((text) => text !== null && (text.split('.')[1] ?? '').length <= 3);
    if (this.select.value !== 'guard_band' || !exact) return NaN;
    const [u, k] = decimals.map(nmFromUm);
    return (u * k) % THOUSAND ? NaN : (u * k) / THOUSAND;
  }

  #allow() {
    this.uncertainty.disabled = this.isSimple;
    this.coverage.disabled = this.select.value !== 'guard_band';
  }
}
