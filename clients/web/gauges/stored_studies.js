/** The gauge studies that the service keeps: a table of them, and what stores the one of the form. */

import { getJson, request, url } from '../api.js';
import { connection } from '../connection.js';
import { field, h, refill } from '../dom.js';
import { gaugeNames } from '../gauge/in_use.js';
import { date, dayText, explain, t } from '../i18n.js';

const COLUMNS = ['study.name', 'field.gauge', 'study.kind', 'study.at'];

export class StoredStudies {
  /** @param orderOf gives the {kind, input} of the form; @param onStudy shows one that is chosen or was stored; @param leaving ends it */
  constructor({ leaving, orderOf, onStudy }) {
    Object.assign(this, { leaving, orderOf, onStudy });
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
    this.#try(() => this.#list());
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
        h('button.quiet', { type: 'button', onclick: () => this.#try(() => this.#open(name)) }, name)), h('td', gauge), h('td', t(`study.kind.${kind}`)), h('td', date(new Date(at)))))))) : h('p.aside', t('study.stored_none')));
  }

  async #open(name) {
    const study = await getJson(url(['studies', name]), { signal: this.leaving });
    this.inputs.name.value = name;
    this.inputs.gauge.value = study.gauge;
    this.inputs.at.value = study.at.slice(0, 10);
    await this.onStudy(study);
  }

  async #store() {
    const { name, gauge, at } = Object.fromEntries(Object.entries(this.inputs).map(([key, { value }]) => [key, value.trim()]));
    if (!name || !gauge) throw new Error(t('study.name_missing'));
    const { kind, input } = await this.orderOf();
    const stored = await request('PUT', url(['studies', name]), { body: { gauge, at, kind, input }, signal: this.leaving });
    await this.#list();
    await this.onStudy(await stored.json());
    this.done.textContent = t('study.done', { name });
  }
}
