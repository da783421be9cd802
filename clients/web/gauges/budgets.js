/** Uncertainty budgets as a table: a row for each contribution, evaluated as one types, with a model where the quantity is computed of others. */

import { getJson, request, url } from '../api.js';
import { Asked } from '../asked.js';
import { mayDrop, readDocument, sayStoredFirst, writeDocument } from '../documents.js';
import { field, h, refill } from '../dom.js';
import { explain, number, t } from '../i18n.js';
import { inTurn, Latest } from '../latest.js';
import { forget, readJson, store as keep, storedKeys } from '../stored.js';

const NUMBERS = ['value', 'standard_uncertainty', 'half_width', 'sensitivity', 'degrees_of_freedom'];
const DISTRIBUTIONS = ['normal', 'rectangular', 'triangular', 'u_shaped', 't'];
const DIVISOR = { rectangular: Math.sqrt(3), triangular: Math.sqrt(6), u_shaped: Math.sqrt(2) };
const COLUMNS = ['name', ...NUMBERS.slice(0, 3), 'distribution', ...NUMBERS.slice(3)];
const DIGITS = 4;
const DRAFTS = 'budget-draft/';
const pathOf = (name) => ['uncertainties', name];

/** What is no number goes as it was typed: the service says what is wrong with it. */
const numberOf = (text) => (/^[+-]?(\d+([.,]\d*)?|[.,]\d+)(e[+-]?\d+)?$/i.test(text) ? Number(text.replace(',', '.')) : text);
const shown = (value) => number(String(Number(value.toPrecision(DIGITS))));

/** With as many decimals as two digits of its uncertainty have. */
const resultText = (value, u) => number(value.toFixed(u > 0 ? Math.min(Math.max(1 - Math.floor(Math.log10(u)), 0), 15) : 6));

/** The standard uncertainty of a contribution without a model's sensitivity. */
export function uncertaintyOf({ standard_uncertainty: own, half_width: half, limits_half_width: inexact, distribution = 'rectangular' }) {
  if (own !== undefined) return own;
  return half / (DIVISOR[distribution] ?? 1) * Math.sqrt(1 + (inexact ? (inexact / half) ** 2 / 3 : 0));
}

export class Budgets {
  #opened = null; // {name, tag, body}; the name is '' and the tag null while it is new
  #before = '';

  /** @param name of the budget shown first; @param onName is told of another; @param leaving ends it */
  constructor({ name, onName, leaving }) {
    Object.assign(this, { onName, leaving });
    this.computing = new Latest(leaving);
    this.opening = new Latest(leaving);
    this.choice = h('select', { name: 'stored-budget', onchange: () => this.#choose() });
    this.name = h('input', { type: 'text', name: 'budget-name', maxlength: 200, autocomplete: 'off', spellcheck: 'false' });
    this.model = h('input', { type: 'text', name: 'model', autocomplete: 'off', spellcheck: 'false', placeholder: 'L*(1 + a*(20 - t))', onchange: () => this.evaluate() });
    this.rows = h('tbody', { onchange: () => this.evaluate() });
    this.note = h('p.note', { role: 'alert' });
    this.done = h('p.aside', { role: 'status' });
    this.result = h('dl.tiles');
    this.adding = h('button', { type: 'button', onclick: () => this.#add() }, t('budget.add'));
    this.element = h('section.sheet.budgets', { 'aria-label': t('budget.title') }, h('h2', t('budget.title')),
      h('div.line', field(t('budget.stored'), this.choice), field(t('budget.name'), this.name), field(t('budget.model'), this.model, t('budget.model_hint'))),
      h('div.wide', { tabindex: 0, role: 'region', 'aria-label': t('budget.contributions') }, h('table', h('caption', t('budget.contributions')),
        h('thead', h('tr', [...COLUMNS, 'u', 'share'].map((column) => h('th', { scope: 'col' }, t(`budget.${column}`))), h('td'))), this.rows)),
      h('p.aside', t('budget.how')), this.note, this.result,
      h('p.actions', this.adding,
        h('button.primary', { type: 'button', onclick: () => this.#try(() => this.#store()) }, t('budget.store')), this.done));
    new Asked(async () => {
      await this.#list(this.#opened?.name ?? name);
      if (!this.#opened) await this.#begin(name);
    }, { say: (text) => { this.note.textContent = text; }, leaving }).run();
    addEventListener('pagehide', () => this.#keepDraft(), { signal: leaving });
    leaving.addEventListener('abort', () => this.#keepDraft());
  }

  async #try(act) {
    this.note.textContent = this.done.textContent = '';
    try {
      await act();
    } catch (problem) {
      if (!this.leaving.aborted) this.#complain(problem);
    }
  }

  async #list(chosen) {
    const { uncertainties } = await getJson(url(['uncertainties']), { signal: this.leaving });
    refill(this.choice, h('option', { value: '' }, t('budget.new')), uncertainties.map(({ name }) => h('option', { value: name }, name)));
    this.choice.value = chosen;
  }

  /** The choice says what is open until another is. */
  #choose() {
    const { value } = this.choice;
    this.choice.value = this.#opened?.name ?? '';
    return this.#change(value);
  }

  #change(name) {
    return this.#try(async () => { if (!this.#opened || this.#text === this.#before || await mayDrop()) await this.open(name); });
  }

  /** Shows a stored budget; '' begins another. */
  async open(name) {
    const found = await this.opening.run(async (signal) => (name ? readDocument(pathOf(name), signal) : { body: { contributions: [{}, {}] }, tag: null }));
    if (!found) return;
    this.#opened = { name, ...found };
    this.#fill(found.body, name);
    this.#before = this.#text;
    this.onName(name);
    await this.evaluate();
  }

  #fill({ model = '', contributions }, typed) {
    this.choice.value = this.#opened.name;
    this.name.value = typed;
    this.model.value = model;
    this.rows.replaceChildren(...contributions.map((one) => this.#row(one)));
  }

  /** Goes on with what was typed and not stored: of no name, with any. */
  async #begin(name) {
    const kept = name ? DRAFTS + name : storedKeys(DRAFTS, 'session')[0];
    const draft = kept && readJson(kept, null, 'session');
    if (!draft) return this.open(name);
    forget(kept, 'session');
    this.#opened = draft.opened;
    this.#before = draft.before;
    this.#fill(draft.value, draft.typed);
    this.onName(draft.opened.name);
    return this.evaluate();
  }

  /** What was changed and not stored is kept while the window lives. */
  #keepDraft() {
    if (!this.#opened) return;
    const kept = DRAFTS + this.#opened.name;
    if (this.#text === this.#before) forget(kept, 'session');
    else keep(kept, JSON.stringify({ opened: this.#opened, before: this.#before, typed: this.name.value, value: this.value }), 'session');
  }

  /** What it would store, as one text: to see whether something was changed. */
  get #text() {
    return JSON.stringify([this.name.value.trim(), this.value]);
  }

  #row(one) {
    const input = (column) => h('input', { type: 'text', name: column, inputmode: NUMBERS.includes(column) && 'decimal', autocomplete: 'off', spellcheck: 'false', 'aria-label': t(`budget.${column}`) });
    const row = h('tr', COLUMNS.map((column) => {
      const control = column === 'distribution' ? h('select', { name: column, 'aria-label': t('budget.distribution') }, ['', ...DISTRIBUTIONS].map((value) => h('option', { value }, value ? t(`budget.of.${value}`) : '–'))) : input(column);
      control.value = one[column] === undefined ? '' : number(String(one[column])).replace('−', '-');
      return h('td', control);
    }), h('td.u'), h('td.share'), h('td', h('button.quiet', { type: 'button', 'aria-label': t('budget.remove_this', { name: one.name ?? '' }), onclick: () => this.#remove(row) }, t('budget.remove'))));
    // What the table has no column for stays as it was.
    row.kept = Object.fromEntries(Object.entries(one).filter(([name]) => !COLUMNS.includes(name)));
    return row;
  }

  #remove(row) {
    const next = row.nextElementSibling ?? row.previousElementSibling;
    row.remove();
    (next?.querySelector('input') ?? this.adding).focus();
    this.evaluate();
  }

  #add() {
    this.rows.append(this.#row({}));
    this.rows.lastElementChild.querySelector('input').focus();
  }

  /** The rows in which something is typed. */
  get #filled() {
    return [...this.rows.children].filter((row) => [...row.querySelectorAll('input, select')].some(({ value }) => value.trim()));
  }

  /** The budget as it is typed. */
  get value() {
    const { model: _, contributions: __, ...kept } = this.#opened?.body ?? {};
    const contributions = this.#filled.map((row) => ({ ...Object.fromEntries([...row.querySelectorAll('input, select')]
      .map(({ name, value }) => [name, NUMBERS.includes(name) ? value.trim() && numberOf(value.trim()) : value.trim()]).filter(([, value]) => value !== '')), ...row.kept }));
    return { ...kept, ...(this.model.value.trim() && { model: this.model.value.trim() }), contributions };
  }

  /** Shows what the service makes of it; nothing before a row is filled. */
  async evaluate() {
    const budget = this.value;
    this.#clear();
    if (!budget.contributions.length) return;
    try {
      const answer = await this.computing.run(async (signal) => (await request('POST', url(['uncertainty']), { body: budget, signal })).json());
      if (answer) this.#show(budget, answer);
    } catch (problem) {
      this.#complain(problem);
    }
  }

  #clear() {
    this.note.textContent = '';
    this.result.replaceChildren();
    for (const cell of this.rows.querySelectorAll('.u, .share')) cell.textContent = '';
    for (const control of this.rows.querySelectorAll('[aria-invalid]')) control.removeAttribute('aria-invalid');
  }

  #show(budget, answer) {
    const combined = answer.combined_standard_uncertainty;
    this.#filled.forEach((row, i) => {
      const one = budget.contributions[i];
      const own = Math.abs(answer.sensitivities?.[i].contribution ?? uncertaintyOf(one) * (one.sensitivity ?? 1));
      row.querySelector('.u').textContent = shown(own);
      // Contributions that depend on each other do not add up.
      if (!budget.correlations?.length && combined > 0) row.querySelector('.share').textContent = `${number((100 * (own / combined) ** 2).toFixed(0))} %`;
    });
    const freedom = answer.effective_degrees_of_freedom;
    const tile = (name, value) => h('div', h('dt', t(`budget.${name}`)), h('dd', value));
    refill(this.result, answer.value != null && tile('result', resultText(answer.value, combined)), tile('combined', shown(combined)), tile('freedom', freedom == null || freedom > 1e6 ? '∞' : shown(freedom)),
      tile('factor', number(answer.coverage_factor.toFixed(2))), tile('expanded', `± ${shown(answer.expanded_uncertainty)}`));
  }

  #complain(problem) {
    this.note.textContent = explain(problem);
    for (const { pointer } of problem.errors ?? []) {
      const [, row, name] = /^\/contributions\/(\d+)\/(\w+)/.exec(pointer) ?? [];
      this.#filled[row]?.querySelector(`[name="${name}"]`)?.setAttribute('aria-invalid', 'true');
    }
  }

  /** @param replacing whether what stands there now is replaced, whoever has written it */
  #store = inTurn(async ({ replacing = false } = {}) => {
    const name = this.name.value.trim();
    if (!name) throw new Error(t('budget.name_missing'));
    const opened = this.#opened;
    const isNew = name !== opened?.name;
    const [body, text] = [this.value, this.#text];
    try {
      const tag = await writeDocument(pathOf(name), body, replacing ? undefined : isNew ? null : opened.tag);
      if (this.#opened === opened) {
        this.#opened = { name, tag, body };
        this.#before = text;
        this.onName(name);
      }
    } catch (problem) {
      if (problem.status !== 412) throw problem;
      sayStoredFirst(this.note, name, isNew, { open: () => this.#change(name), replace: () => this.#try(() => this.#store({ replacing: true })) });
      return;
    }
    await this.#list(this.#opened.name);
    this.done.textContent = t('budget.done', { name });
  }, () => this.#text);
}
