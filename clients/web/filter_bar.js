/** Of which values a view is: machine, tool, order, operator and time, and whether confirmed ones are among them, in the address of Trend, Overview and Parts alike. */

import { getJson, url } from './api.js';
import { connection } from './connection.js';
import { field, h, refill } from './dom.js';
import { keptPrefixes } from './gauge/prefixes.js';
import { nameIn } from './gauge/reading.js';
import { date, t } from './i18n.js';

const NAMES = ['machine', 'tool', 'order', 'operator'];
/** By whom, where no name was given: the name of a key, as of a badge, is asked for and kept as this. */
const KEY = 'caller';
/** Those in the first row: the others are folded, with their number. */
const FIRST = ['machine', 'order'];
const DAYS = ['from', 'to'];
const PERIODS = ['today', 'yesterday', 'shift'];
/** Hours at which shifts begin, on the clock of the wall. */
const SHIFTS = [6, 14, 22];
const MOST_OFFERED = 200;

/** When a day begins here, or the hour of a day so many days later. */
const momentOf = (date, days = 0, hour = 0) => new Date(date.getFullYear(), date.getMonth(), date.getDate() + days, hour);

/** When a day that was typed begins here, or the day so many later, as the service takes it; '' without one. */
export function dayOf(text, later = 0) {
  const [year, month, day] = text.split('-').map(Number);
  return text ? momentOf(new Date(year, month - 1, day), later).toISOString() : '';
}

/** [from, to] of a period at a moment; the last one may be open. */
export function periodOf(period, now) {
  if (period === 'today') return [momentOf(now), null];
  if (period === 'yesterday') return [momentOf(now, -1), momentOf(now)];
  const begun = SHIFTS.filter((hour) => hour <= now.getHours()).at(-1);
  return [begun === undefined ? momentOf(now, -1, SHIFTS.at(-1)) : momentOf(now, 0, begun), null];
}

/** What was typed or scanned into the field of a search: one of those offered stays, another loses what a scanner and the shop write before it. A prefix of letters alone may be of the name. */
export function searched(input) {
  const typed = input.value.trim();
  const isOffered = [...input.list?.options ?? []].some(({ value }) => value === typed);
  const prefixes = Object.fromEntries(Object.entries(keptPrefixes()).filter(([, prefix]) => /[^\p{L}\p{N}]$/u.test(prefix)));
  if (!isOffered) input.value = nameIn(typed, input.name, prefixes) ?? typed;
}

const ofKey = (name) => t('filter.of_key', { name });

export class FilterBar {
  /** @param options of the address; @param onChange is told of another choice */
  constructor(options, onChange) {
    const changed = () => { this.#nameKey(); this.#press(); onChange(); };
    this.changed = changed;
    this.inputs = Object.fromEntries([
      ...NAMES.map((name) => [name, h('input', { type: 'text', name, list: `filter-${name}`, autocomplete: 'off', spellcheck: 'false', onchange: ({ target }) => { searched(target); changed(); } })]),
      ...DAYS.map((name) => [name, h('input', { type: 'date', name, onchange: () => this.#choose('', changed) })]),
    ]);
    for (const [name, input] of Object.entries(this.inputs)) input.value = options[name] ?? '';
    if (options[KEY]) this.inputs.operator.value = ofKey(options[KEY]);
    this.keys = new Set([options[KEY]].filter(Boolean));
    this.operators = new Set();
    this.period = PERIODS.includes(options.period) ? options.period : '';
    this.lists = NAMES.map((name) => h('datalist', { id: `filter-${name}` }));
    this.chips = PERIODS.map((period) => h('button', { type: 'button', onclick: () => this.#choose(this.period === period ? '' : period, changed) }, t(`period.${period}`)));
    this.isWithout = options.confirmed === 'false';
    this.without = h('button', { type: 'button', title: t('confirmed.rule'), onclick: () => { this.isWithout = !this.isWithout; changed(); } }, t('confirmed.without'));
    this.rule = h('p.hint', t('confirmed.rule'));
    this.folded = Object.keys(this.inputs).filter((name) => !FIRST.includes(name));
    const fieldsOf = (names) => names.map((name) => field(t(`field.${name}`), this.inputs[name]));
    this.summary = h('summary');
    this.more = h('details.of-more', this.summary, h('div.line', fieldsOf(this.folded), h('div.chips', this.without), this.rule));
    this.element = [fieldsOf(FIRST), h('div.chips', this.chips), this.more, this.lists];
    this.#press();
    this.more.open = this.isWithout || [...this.folded, KEY].some((name) => options[name]);
  }

  /** Says that a name is that of a key. */
  #nameKey() {
    const key = this.#names[KEY];
    if (key) this.inputs.operator.value = ofKey(key);
  }

  #choose(period, changed) {
    this.period = period;
    if (period) for (const name of DAYS) this.inputs[name].value = '';
    changed();
  }

  /** What is chosen is pressed, and named where it is folded. */
  #press() {
    this.chips.forEach((chip, i) => chip.setAttribute('aria-pressed', PERIODS[i] === this.period));
    this.without.setAttribute('aria-pressed', this.isWithout);
    this.rule.hidden = !this.isWithout;
    const chosen = this.folded.map((name) => [name, this.inputs[name].value.trim()]).filter(([, value]) => value)
      .map(([name, value]) => `${t(`field.${name}`)} ${DAYS.includes(name) ? date(new Date(dayOf(value))) : value}`);
    this.summary.textContent = [t('filter.more'), ...chosen, this.isWithout && t('confirmed.without')].filter(Boolean).join(' · ');
  }

  /** Asks which names there are. */
  offer(signal) {
    const namesOf = async (name) => (await getJson(url(['measurements', 'summary'], { group_by: name }), { signal, asks: false })).groups.map((group) => group[name]).filter(Boolean);
    const fill = (name, values) => refill(this.lists[NAMES.indexOf(name)], values.slice(0, MOST_OFFERED).map((value) => h('option', { value })));
    for (const name of NAMES.filter((each) => each !== 'operator')) namesOf(name).then((values) => fill(name, values), () => {});
    Promise.all([namesOf('operator'), namesOf(KEY)]).then(([operators, keys]) => {
      const before = this.#names[KEY];
      for (const name of operators) this.operators.add(name);
      for (const name of keys) this.keys.add(name);
      fill('operator', [...operators, ...keys.map(ofKey)]);
      if (this.#names[KEY] !== before) this.changed();
    }, () => {});
  }

  /** A name that only a key has is that of the key. */
  get #names() {
    const { operator, ...names } = Object.fromEntries(NAMES.map((name) => [name, this.inputs[name].value.trim()]));
    const key = [...this.keys].find((name) => operator === ofKey(name) || (operator === name && !this.operators.has(name)));
    return { ...names, operator: key ? '' : operator, [KEY]: key ?? '' };
  }

  /** As the address has it. */
  get options() {
    return { ...this.#names, confirmed: this.isWithout ? 'false' : '', period: this.period, ...Object.fromEntries(DAYS.map((name) => [name, this.inputs[name].value])) };
  }

  /** As the service takes it: the last day is among those shown. */
  get query() {
    const [from, to] = this.period ? periodOf(this.period, connection.now()).map((at) => at?.toISOString() ?? '') : [dayOf(this.inputs.from.value), dayOf(this.inputs.to.value, 1)];
    return { ...this.#names, confirmed: this.isWithout ? 'false' : '', from, to };
  }

  /** Whether a record that has just come is of it. */
  has(record) {
    const { from, to, confirmed, ...names } = this.query;
    const at = new Date(record.measured_at);
    return Object.entries(names).every(([name, value]) => !value || record[name] === value) && !(confirmed && record.confirmed) && (!from || at >= new Date(from)) && (!to || at < new Date(to));
  }
}
