/** The gauge studies that the service keeps: a table of them, and what stores the one of the form. */

import { getJson, url } from '../api.js';
import { Asked } from '../asked.js';
import { connection } from '../connection.js';
import { readDocument, sayStoredFirst, writeDocument } from '../documents.js';
import { field, h, refill } from '../dom.js';
import { dayShown, gaugeNames } from '../gauge/in_use.js';
import { dayText, explain, t } from '../i18n.js';
import { inTurn } from '../latest.js';

const COLUMNS = ['study.name', 'field.gauge', 'study.kind', 'study.at'];
const NONE = { name: '', tag: null };
const pathOf = (name) => ['studies', name];
/** A date is the same day everywhere; a time is of the day that it is here. */
const dayOfStudy = (at) => (at.length === 10 ? at : dayText(new Date(at)));

export class StoredStudies {
  /** That of the form, as it was read. */
  #current = NONE;
  /** The time of the one that was opened, which the day in the form lacks. */
  #at = '';

  /** @param orderOf gives the {kind, input} of the form; @param textOf gives all that is typed there; @param onStudy shows one that is chosen or was stored; @param leaving ends it */
  constructor({ leaving, orderOf, textOf, onStudy }) {
    Object.assign(this, { leaving, orderOf, textOf, onStudy });
    const input = (name, attributes) => h('input', { name, type: 'text', maxlength: 200, autocomplete: 'off', spellcheck: 'false', ...attributes });
    this.inputs = { name: input('study-name'), gauge: input('study-gauge', { list: 'gauges-of-studies' }), at: input('study-at', { type: 'date' }) };
    this.inputs.at.value = dayText(connection.now());
    this.gauges = h('datalist', { id: 'gauges-of-studies' });
    this.note = h('p.note', { role: 'alert' });
    this.done = h('p.aside', { role: 'status' });
    this.rows = h('div');
    this.element = h('section.stored-studies', h('h2', t('study.stored')), this.rows,
      h('form.line', { novalidate: true, onsubmit: (event) => { event.preventDefault(); this.#try(() => this.#store()); } },
        field(t('study.name'), this.inputs.name), field(t('field.gauge'), this.inputs.gauge), field(t('study.at'), this.inputs.at), h('button', { type: 'submit' }, t('study.store'))),
      this.note, this.done, this.gauges);
    this.listing = new Asked(() => this.#list(), { say: (text) => { this.note.textContent = text; }, leaving });
    this.listing.run();
    gaugeNames(leaving).then((names) => refill(this.gauges, names.map((value) => h('option', { value }))));
  }

  async #try(act) {
    this.note.textContent = this.done.textContent = '';
    try {
      await act();
    } catch (problem) {
      if (!this.leaving.aborted) this.note.textContent = explain(problem);
    }
  }

  async #list() {
    const { studies } = await getJson(url(['studies']), { signal: this.leaving });
    refill(this.rows, studies.length ? h('div.scroll.listed', { tabindex: 0, role: 'region', 'aria-label': t('study.stored') }, h('table',
      h('thead', h('tr', COLUMNS.map((name) => h('th', { scope: 'col' }, t(name))))), h('tbody', studies.map(({ name, gauge, kind, at }) => h('tr', h('th', { scope: 'row' },
        h('button.quiet', { type: 'button', onclick: () => this.#try(() => this.#open(name)) }, name)), h('td', gauge), h('td', t(`study.kind.${kind}`)), h('td', dayShown(at))))))) : h('p.aside', t('study.stored_none')));
  }

  /** The form begins another study. */
  begin() {
    this.#current = NONE;
    this.#at = '';
  }

  async #read(name) {
    const { body, tag } = await readDocument(pathOf(name), this.leaving);
    this.#current = { name, tag };
    return body;
  }

  async #open(name) {
    const study = await this.#read(name);
    this.inputs.name.value = name;
    this.inputs.gauge.value = study.gauge;
    this.#at = study.at;
    this.inputs.at.value = dayOfStudy(study.at);
    await this.onStudy(study);
  }

  /** @param replacing whether what stands there now is replaced, whoever has written it */
  #store = inTurn(async ({ replacing = false } = {}) => {
    const { name, gauge, at: day } = Object.fromEntries(Object.entries(this.inputs).map(([key, { value }]) => [key, value.trim()]));
    if (!name || !gauge) throw new Error(t('study.name_missing'));
    const at = this.#at && day === dayOfStudy(this.#at) ? this.#at : day;
    const typed = this.textOf();
    const { kind, input } = await this.orderOf();
    const isNew = name !== this.#current.name;
    try {
      await writeDocument(pathOf(name), { gauge, at, kind, input }, replacing ? undefined : isNew ? null : this.#current.tag);
    } catch (problem) {
      if (problem.status !== 412) throw problem;
      sayStoredFirst(this.note, name, isNew, { open: () => this.#try(() => this.#open(name)), replace: () => this.#try(() => this.#store({ replacing: true })) });
      return;
    }
    const study = await this.#read(name);
    if (this.textOf() === typed) await this.onStudy(study);
    await this.listing.run();
    this.done.textContent = t('study.done', { name });
  }, () => this.textOf() + Object.values(this.inputs).map(({ value }) => value).join());
}
