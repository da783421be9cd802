/** The gauges in use with their calibrations: what each period says, a form for the next, and one for a gauge. */

import { getJson, request, url } from '../api.js';
import { Asked } from '../asked.js';
import { connection } from '../connection.js';
import { findDocument, writeDocument } from '../documents.js';
import { field, h, refill } from '../dom.js';
import { dayShown, gaugeInUse } from '../gauge/in_use.js';
import { dayText, explain, number, t } from '../i18n.js';
import { Latest } from '../latest.js';

const CALIBRATION = ['from', 'due', 'certificate', 'laboratory', 'status', 'uncertainty', 'comment'];
const COLUMNS = ['from', 'due', 'status', 'certificate', 'laboratory', 'uncertainty', 'comment'];
const STATES = ['in_use', 'blocked'];

const control = (name, attributes = {}) => h('input', { type: name, autocomplete: 'off', spellcheck: 'false', maxlength: 200, ...attributes });
const valuesOf = (inputs) => Object.fromEntries(Object.entries(inputs).map(([name, { value }]) => [name, value.trim()]).filter(([, value]) => value));

export class Calibrations {
  /** @param gauge whose calibrations are shown first; @param onGauge is told of another; @param leaving ends it */
  constructor({ gauge, onGauge, leaving }) {
    Object.assign(this, { gauge, onGauge, leaving });
    this.reading = new Latest(leaving);
    this.asked = new Asked(() => this.reading.run((signal) => this.#read(signal)), { say: (text) => { this.note.textContent = text; }, leaving });
    this.budgets = h('datalist', { id: 'budgets' });
    this.rows = h('tbody');
    this.empty = h('p.empty', { hidden: true }, t('gauges.none'));
    this.table = h('div.scroll.listed', { tabindex: 0, role: 'region', 'aria-label': t('view.gauges'), hidden: true },
      h('table', h('thead', h('tr', ['field.gauge', 'calibration.due', 'calibration.status', 'gauges.uncertainty'].map((name) => h('th', { scope: 'col' }, t(name))))), this.rows));
    this.own = { name: control('text', { name: 'gauge' }), calibration_due: control('date', { name: 'calibration_due' }), uncertainty: control('text', { name: 'budget', list: 'budgets' }) };
    this.note = h('p.note', { role: 'status' });
    this.ofOne = h('section.of-gauge');
    this.inputs = Object.fromEntries(CALIBRATION.map((name) => [name, name === 'status' ? h('select', { name }, STATES.map((state) => h('option', { value: state }, t(`calibration.${state}`))))
      : control(['from', 'due'].includes(name) ? 'date' : 'text', { name, list: name === 'uncertainty' && 'budgets' })]));
    this.element = h('section.gauges-in-use', this.note, this.empty, this.table, this.ofOne,
      h('details.add-gauge', h('summary', t('gauges.add')), h('form.line', { novalidate: true, onsubmit: (event) => this.#send(event, () => this.#storeGauge()) },
        field(t('field.gauge'), this.own.name), field(t('calibration.due'), this.own.calibration_due), field(t('calibration.uncertainty'), this.own.uncertainty),
        h('button.primary', { type: 'submit' }, t('gauges.store')))), this.budgets);
    this.asked.run();
    getJson(url(['uncertainties']), { signal: leaving, asks: false }).then(({ uncertainties }) => refill(this.budgets, uncertainties.map(({ name }) => h('option', { value: name }))), () => {});
  }

  /** @param event of a form, whose second click sends nothing again */
  async #send(event, act) {
    event.preventDefault();
    if (this.isSending) return;
    this.isSending = true;
    this.note.textContent = '';
    try {
      await act();
    } catch (problem) {
      if (!this.leaving.aborted) this.note.textContent = explain(problem);
    } finally {
      this.isSending = false;
    }
  }

  async #read(signal) {
    const { gauges } = await getJson(url(['gauges-in-use']), { signal });
    const all = await Promise.all(gauges.map(({ name }) => gaugeInUse(name, signal)));
    if (signal.aborted) return;
    this.empty.hidden = gauges.length > 0;
    this.table.hidden = !gauges.length;
    refill(this.rows, all.filter(Boolean).map((one) => h('tr', h('th', { scope: 'row' },
      h('button.quiet', { type: 'button', 'aria-current': one.name === this.gauge && 'true', onclick: () => this.#choose(one.name) }, one.name)),
    h('td', one.blocked ? '–' : one.day), h('td', { class: one.overdue && 'overdue' }, t(`calibration.${one.blocked ? 'blocked' : one.overdue ? 'overdue' : 'in_use'}`)),
    h('td', one.uncertainty_um ? `u = ${number(one.uncertainty_um)} µm` : '–'))));
    if (this.gauge) await this.#open(this.gauge, signal);
    else this.ofOne.replaceChildren();
  }

  /** The form of another gauge takes nothing that was typed for this one. */
  #choose(name) {
    if (name !== this.gauge) {
      this.ofOne.replaceChildren();
      this.#clear();
    }
    this.gauge = name;
    this.onGauge(name);
    this.note.textContent = '';
    this.asked.run();
  }

  #clear() {
    for (const [name, input] of Object.entries(this.inputs)) input.value = name === 'status' ? STATES[0] : '';
  }

  async #open(gauge, signal) {
    const { calibrations } = await getJson(url(['gauges-in-use', gauge, 'calibrations']), { signal });
    if (signal.aborted) return;
    const cell = { from: dayShown, due: dayShown, status: (state) => t(`calibration.${state}`) };
    this.inputs.from.value ||= dayText(connection.now());
    refill(this.ofOne, h('h2', t('calibration.title', { gauge })), calibrations.length ? h('div.scroll.listed', { tabindex: 0, role: 'region', 'aria-label': t('calibration.title', { gauge }) },
      h('table', h('thead', h('tr', COLUMNS.map((name) => h('th', { scope: 'col' }, t(`calibration.${name}`))))), h('tbody', [...calibrations].reverse().map((one) => h('tr', COLUMNS.map((name) =>
        h('td', { class: name === 'status' && one.status === 'blocked' && 'overdue' }, one[name] ? (cell[name] ?? String)(one[name]) : '–'))))))) : h('p.aside', t('calibration.none')),
    h('form.sheet', { novalidate: true, onsubmit: (event) => this.#send(event, () => this.#record(gauge)) },
      h('div.study-fields', CALIBRATION.map((name) => field(t(`calibration.${name}`), this.inputs[name]))), h('p.actions', h('button.primary', { type: 'submit' }, t('calibration.record')))));
  }

  async #record(gauge) {
    await request('POST', url(['gauges-in-use', gauge, 'calibrations']), { body: valuesOf(this.inputs), signal: this.leaving });
    if (this.gauge === gauge) this.#clear();
    await this.asked.run();
    this.note.textContent = t('calibration.recorded', { gauge });
  }

  /** Of a gauge that is there, what is not typed stays as it is. */
  async #storeGauge() {
    const { name = '', ...typed } = valuesOf(this.own);
    const path = ['gauges-in-use', name || ' '];
    const { body, tag } = await findDocument(path, this.leaving);
    await writeDocument(path, { ...body, ...typed }, tag);
    this.#choose(name);
    for (const input of Object.values(this.own)) input.value = '';
  }
}
