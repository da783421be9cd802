/** A gauge study: its readings in a grid that a gauge fills with Enter, or the records of a characteristic; the service computes and keeps it. */

import { getJson, request, url } from '../api.js';
import { parseDesignation } from '../designation.js';
import { field, h, refill } from '../dom.js';
import { Decimal, mmText, nmFromUm } from '../exact.js';
import { dayOf } from '../filter_bar.js';
import { limitsOf } from '../gauge/held.js';
import { gaugeValue } from '../gauge/reading.js';
import { explain, t } from '../i18n.js';
import { Latest } from '../latest.js';
import { readJson, store } from '../stored.js';
import { operatorOf } from '../verdict.js';
import { StoredStudies } from './stored_studies.js';
import { masterResult, variationResult } from './study_result.js';

const KEPT = 'study';
const BEGUN = { kind: 'grr', tolerance: '', parts: '10', operators: 'A, B, C', trials: '3', reference: '', values: '', resolution: '', u_cal: '', u_bi: '', u_evr: '', cells: {} };
/** What the capability of the measuring process (ISO 22514-7) is computed of. */
const PROCESS = ['resolution', 'u_cal', 'u_bi', 'u_evr'];
const FIELDS = ['tolerance', 'parts', 'operators', 'trials', 'reference', 'values', ...PROCESS];
const KINDS = { grr: ['tolerance', 'parts', 'operators', 'trials', ...PROCESS], type1: ['tolerance', 'reference', 'values', 'resolution', 'u_cal'] };
const MOST = { parts: 100, operators: 20, trials: 20 };
/** So many records are read for a study at the most. */
const MOST_RECORDS = 1000;

/** Names stand between commas; where there is a semicolon it alone is between them, and a comma is of a name. */
const listOf = (text) => [...new Set(text.split(text.includes(';') ? ';' : /[,\n]/).map((one) => one.trim()).filter(Boolean))];
/** "10" are parts 1 to 10; "A, B" are named. One more than fit stands for any number. */
const namesOf = (text, most) => (/^\d+$/.test(text.trim()) ? Array.from({ length: Math.min(Number(text), most + 1) }, (_, i) => String(i + 1)) : listOf(text));

/** Whether the grid would show a part of a study. */
const isTooLarge = (names) => Object.entries(MOST).some(([of, most]) => names[of].length > most);

export class StudyForm {
  constructor(leaving) {
    this.leaving = leaving;
    this.computing = new Latest(leaving);
    this.state = { ...BEGUN, ...readJson(KEPT, {}) };
    const text = (name) => h(name === 'values' ? 'textarea' : 'input', { name, type: name !== 'values' && 'text', rows: name === 'values' && 6, autocomplete: 'off', spellcheck: 'false', oninput: () => this.#typed() });
    this.inputs = Object.fromEntries(FIELDS.map((name) => [name, text(name)]));
    this.kind = h('select', { name: 'kind', onchange: () => this.#typed() }, Object.keys(KINDS).map((kind) => h('option', { value: kind }, t(`study.kind.${kind}`))));
    this.fields = Object.fromEntries(FIELDS.map((name) => [name, field(t(`study.${name}`), this.inputs[name])]));
    this.taken = h('select', { name: 'characteristic', onchange: () => this.#take() }, h('option', { value: '' }, t('study.take')));
    [this.since, this.until] = ['records-from', 'records-to'].map((name) => h('input', { name, type: 'date' }));
    this.taking = h('div.study-fields', field(t('field.from'), this.since), field(t('field.to'), this.until), field(t('study.from'), this.taken));
    this.grid = h('div.scroll.study-grid', { tabindex: 0, role: 'region', 'aria-label': t('study.readings') });
    this.note = h('p.note', { role: 'alert' });
    this.said = h('p.note', { role: 'status' });
    this.result = h('section.study-result', { 'aria-live': 'polite' });
    this.element = h('section.study', h('h2', t('study.title')), h('form.sheet', { novalidate: true, onsubmit: (event) => { event.preventDefault(); this.#compute(); } },
      h('div.study-fields', field(t('study.kind'), this.kind), FIELDS.filter((name) => !PROCESS.includes(name)).map((name) => this.fields[name])),
      h('details', h('summary', t('study.process')), h('div.study-fields', PROCESS.map((name) => this.fields[name]))), this.taking, this.grid, this.note, this.said,
      h('p.actions', h('button.primary', { type: 'submit' }, t('study.compute')), h('button', { type: 'button', onclick: () => this.#clear() }, t('study.clear')))), this.result);
    this.stored = new StoredStudies({ leaving, orderOf: () => this.#order(), textOf: () => JSON.stringify(this.state), onStudy: (study) => this.#open(study) });
    this.element.append(this.stored.element);
    this.#show();
    this.#offer();
  }

  #show() {
    for (const name of FIELDS) this.inputs[name].value = this.state[name];
    this.kind.value = this.state.kind;
    this.#draw();
  }

  /** The characteristics that were recorded. */
  async #offer() {
    const { groups } = await getJson(url(['measurements', 'summary'], { group_by: 'characteristic' }), { signal: this.leaving, asks: false }).catch(() => ({ groups: [] }));
    this.taken.append(...groups.map(({ characteristic }) => characteristic).filter(Boolean).map((name) => h('option', { value: name }, name)));
  }

  /** A result is of the readings that it was computed of. */
  #keep() {
    this.computing.run(() => {});
    this.result.replaceChildren();
    store(KEPT, JSON.stringify(this.state));
  }

  #typed() {
    Object.assign(this.state, { kind: this.kind.value }, Object.fromEntries(FIELDS.map((name) => [name, this.inputs[name].value])));
    this.#keep();
    this.#draw();
  }

  #clear() {
    this.stored.begin();
    this.#fill({ cells: {}, values: '' });
  }

  get #names() {
    const { parts, operators, trials } = this.state;
    return { parts: namesOf(parts, MOST.parts), operators: listOf(operators), trials: namesOf(trials, MOST.trials) };
  }

  /** The grid: a part a row, a trial of an operator a column. */
  #draw() {
    const { kind } = this.state;
    for (const name of FIELDS) this.fields[name].hidden = !KINDS[kind].includes(name);
    this.grid.hidden = kind !== 'grr';
    this.taking.hidden = kind !== 'grr';
    const names = this.#names;
    const [parts, operators, trials] = Object.entries(MOST).map(([of, most]) => names[of].slice(0, most));
    this.note.textContent = kind === 'grr' && isTooLarge(names) ? t('study.too_large', MOST) : '';
    const columns = operators.flatMap((operator) => trials.map((trial) => ({ operator, trial })));
    const drawn = JSON.stringify([parts, columns]);
    if (drawn === this.drawn) return;
    this.drawn = drawn;
    const cells = columns.map(({ operator, trial }) => parts.map((part) => this.#cell(JSON.stringify([part, operator, trial]), `${t('field.part_id')} ${part}, ${operator}, ${trial}`)));
    // Down the parts, then the next trial: in the order in which a study is measured.
    const order = cells.flat();
    order.forEach((cell, i) => cell.addEventListener('keydown', (event) => {
      if (event.key !== 'Enter') return;
      event.preventDefault();
      (order[i + 1] ?? this.element.querySelector('.primary')).focus();
    }));
    refill(this.grid, h('table', h('thead', h('tr', h('th', { rowspan: 2, scope: 'col' }, t('field.part_id')), operators.map((operator) => h('th', { colspan: trials.length, scope: 'colgroup' }, operator))),
      h('tr', columns.map(({ trial }) => h('th', { scope: 'col' }, trial)))), h('tbody', parts.map((part, row) => h('tr', h('th', { scope: 'row' }, part), cells.map((column) => h('td', column[row])))))));
  }

  #cell(key, label) {
    const cell = h('input', { type: 'text', inputmode: 'decimal', autocomplete: 'off', 'aria-label': label, onfocus: () => cell.select(), oninput: () => { this.state.cells[key] = cell.value; this.#keep(); } });
    cell.value = this.state.cells[key] ?? '';
    return cell;
  }

  /** Takes the newest records of a characteristic that count: their parts, their operators, and as trials the values of both in order. */
  async #take() {
    const characteristic = this.taken.value;
    this.taken.value = '';
    if (!characteristic) return;
    this.said.textContent = '';
    try {
      const asked = { characteristic, sort: 'newest', set_aside: 'false', from: dayOf(this.since.value), to: dayOf(this.until.value, 1), limit: MOST_RECORDS };
      const { measurements, next } = await getJson(url(['measurements'], asked), { signal: this.leaving });
      const records = measurements.filter((record) => record.part_id && operatorOf(record));
      if (!records.length) throw Object.assign(new Error(t('study.no_records')));
      const { tolerance_um: um } = records[0];
      this.stored.begin();
      const kept = fitting(records.map((record) => ({ part: record.part_id, operator: operatorOf(record), value: record.measured_mm })));
      this.#fill({ ...gridOf(kept.reverse()), tolerance: um === undefined ? '' : mmText(nmFromUm(um), 0) });
      if (next || kept.length < records.length) this.said.textContent = t('study.cut', { count: kept.length });
    } catch (problem) {
      this.note.textContent = explain(problem);
    }
  }

  #fill(state) {
    Object.assign(this.state, state);
    this.#keep();
    this.drawn = '';
    this.said.textContent = '';
    this.#show();
  }

  /** Shows a study that was stored, as it was computed then. */
  async #open({ kind, input, result }) {
    const { tolerance = '', reference = '', measurements = [], values = [], measuring_process: process, measuring_system: system } = input;
    const filled = { ...Object.fromEntries(PROCESS.map((name) => [name, (process ?? system)?.[name] ?? ''])), kind, tolerance, reference, values: values.join('\n') };
    this.#fill({ ...Object.fromEntries(Object.entries(filled).map(([name, value]) => [name, String(value)])), ...(measurements.length && gridOf(measurements)) });
    await this.#put(async () => {
      if (result.method && !result.tolerance_percent) throw new Error(t('study.other', { method: result.method }));
      return (await this.#order()).shown(result);
    });
  }

  #compute() {
    return this.#put(async (signal) => {
      const { kind, input, shown } = await this.#order();
      return shown(await (await request('POST', url(['statistics', kind]), { body: input, signal })).json());
    });
  }

  /** Shows the result that `work` makes of the readings. */
  async #put(work) {
    this.note.textContent = '';
    try {
      const made = await this.computing.run(work);
      if (!made) return;
      refill(this.result, made);
      this.result.scrollIntoView({ block: 'nearest' });
    } catch (problem) {
      this.result.replaceChildren();
      this.note.textContent = explain(problem);
    }
  }

  /** The study as it is typed: {kind, input} for the service, and what shows its result. @throws Error that says what is missing */
  #order() {
    return this.state.kind === 'grr' ? this.#variation() : this.#master();
  }

  /** What is typed of the measuring process; undefined if nothing is. */
  #process(kind) {
    const typed = PROCESS.filter((name) => KINDS[kind].includes(name) && this.state[name].trim());
    return typed.length ? Object.fromEntries(typed.map((name) => [name, new Decimal(valueOf(this.state[name].trim()))])) : undefined;
  }

  /** In mm as text, of a number or of a size and class; undefined without one. */
  async #tolerance() {
    const typed = this.state.tolerance.trim();
    if (!typed) return undefined;
    const designation = parseDesignation(typed);
    return designation ? mmText(nmFromUm((await limitsOf(designation.text)).tolerance_um), 0) : valueOf(typed);
  }

  async #variation() {
    const { parts, operators, trials } = this.#names;
    if (isTooLarge({ parts, operators, trials })) throw new Error(t('study.too_large', MOST));
    const tolerance = await this.#tolerance();
    const all = parts.flatMap((part) => operators.flatMap((operator) => trials.map((trial) => ({ part, operator, trial, typed: (this.state.cells[JSON.stringify([part, operator, trial])] ?? '').trim() }))));
    const read = all.filter(({ typed }) => typed).map(({ typed, ...of }) => ({ ...of, text: valueOf(typed) }));
    if (!read.length) throw new Error(t('study.empty'));
    const measured = (name, names) => names.filter((one) => read.some((reading) => reading[name] === one));
    const input = { ...(tolerance && { tolerance: new Decimal(tolerance) }), measurements: read.map(({ text, ...of }) => ({ ...of, value: new Decimal(text) })), measuring_process: this.#process('grr') };
    const of = { parts: measured('part', parts), operators: measured('operator', operators) };
    return { kind: 'grr', input, shown: async (study) => variationResult(study, { ...of, readings: read.map(({ text, ...each }) => ({ ...each, value: Number(text) })), charts: await this.#charts(input.measurements, of).catch((problem) => { this.note.textContent = t('study.charts_failed', { reason: explain(problem) }); }) }) };
  }

  /** The charts of averages and ranges, a subgroup each part of each operator; null if a trial is missing or there is one alone. */
  async #charts(readings, { parts, operators }) {
    const subgroups = operators.flatMap((operator) => parts.map((part) => readings.filter((one) => one.part === part && one.operator === operator).map(({ value }) => value)));
    if (subgroups.some(({ length }) => length < 2 || length !== subgroups[0].length)) return null;
    return (await (await request('POST', url(['statistics', 'chart']), { body: { kind: 'xbar_r', subgroups }, signal: this.leaving })).json()).charts;
  }

  async #master() {
    const values = this.state.values.split(/[\s;]+/).filter(Boolean).map(valueOf);
    const reference = valueOf(this.state.reference.trim());
    const tolerance = await this.#tolerance() ?? valueOf('');
    const input = { values: values.map((text) => new Decimal(text)), reference: new Decimal(reference), tolerance: new Decimal(tolerance), measuring_system: this.#process('type1') };
    return { kind: 'type1', input, shown: (study) => masterResult(study, { values: values.map(Number), reference: Number(reference), tolerance: Number(tolerance) }) };
  }
}

/** Of readings [{part, operator, value}] in their order those that a study takes: no more parts, operators and trials of both. */
function fitting(readings) {
  const [parts, operators, counts] = [new Set(), new Set(), new Map()];
  return readings.filter(({ part, operator }) => {
    const of = JSON.stringify([part, operator]);
    const count = counts.get(of) ?? 0;
    if (count === MOST.trials || (!parts.has(part) && parts.size === MOST.parts) || (!operators.has(operator) && operators.size === MOST.operators)) return false;
    parts.add(part);
    operators.add(operator);
    return counts.set(of, count + 1);
  });
}

/** As listOf and namesOf read it. */
const textOf = (names) => (names.some((name) => name.includes(',')) || /^\d+$/.test(names.join()) ? `${names.join('; ')};` : names.join(', '));

/** The grid of readings [{part, operator, trial, value}]; without a trial they count up within part and operator. */
function gridOf(readings) {
  const counts = new Map();
  const cells = {};
  const trials = new Set();
  for (const { part, operator, trial, value } of readings) {
    const of = JSON.stringify([part, operator]);
    counts.set(of, (counts.get(of) ?? 0) + 1);
    const name = String(trial ?? counts.get(of));
    trials.add(name);
    cells[JSON.stringify([String(part), String(operator), name])] = String(value);
  }
  const all = (name) => textOf([...new Set(readings.map((reading) => String(reading[name])))]);
  const counted = [...trials].every((name) => Number(name) >= 1 && Number(name) <= trials.size);
  return { cells, parts: all('part'), operators: all('operator'), trials: counted ? String(trials.size) : [...trials].join(', ') };
}

/** The decimal of what was typed or sent by a gauge. @throws Error that says what is no value */
function valueOf(typed) {
  const value = gaugeValue(typed);
  if (value === null) throw new Error(typed ? t('study.wrong', { typed }) : t('study.incomplete'));
  return value;
}
