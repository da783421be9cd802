/** Custom tolerance classes: what there is, a new one from pasted rows, and back to the standard. */

import { request, url } from '../api.js';
import { confirm } from '../confirm.js';
import { field, h, refill } from '../dom.js';
import { Decimal, parseMeasured, parseSigned } from '../exact.js';
import { explain, t } from '../i18n.js';
import { isoClass } from './catalogue.js';

/** One row a line: over; up to; upper; lower. With `;` or tabs a decimal comma is read. */
function readRows(text) {
  return text.split('\n').filter((line) => line.trim()).map((line, i) => {
    const cells = line.split(/[;\t]/.test(line) ? /[;\t]/ : /[,\s]+/).map((cell) => cell.trim()).filter(Boolean);
    const [over, upTo, upper, lower] = [parseMeasured, parseMeasured, parseSigned, parseSigned].map((parse, at) => parse(cells[at] ?? ''));
    if (cells.length !== 4 || [over, upTo, upper, lower].includes(null)) throw new Error(t('own.row_malformed', { line: i + 1, text: line.trim() }));
    return { over_mm: new Decimal(over), up_to_mm: new Decimal(upTo), upper_um: new Decimal(upper), lower_um: new Decimal(lower) };
  });
}

export class OwnColumns {
  /** @param onChange is told of a change; @param onShow takes the name of a column to look at */
  constructor({ onChange, onShow }) {
    this.onChange = onChange;
    this.onShow = onShow;
    this.list = h('ul.own-list');
    this.name = h('input', { type: 'text', autocomplete: 'off', spellcheck: 'false', maxlength: 16, required: true });
    this.rows = h('textarea', { rows: 4, spellcheck: 'false', placeholder: '18; 30; +15; -3', required: true });
    this.note = h('p.note', { role: 'alert' });
    this.element = h('section.own', h('h2', t('own.title')), this.list,
      h('details', h('summary', t('own.add')),
        h('form', { novalidate: true, onsubmit: (event) => { event.preventDefault(); this.#store(); } },
          field(t('own.name'), this.name, t('own.name_hint')), field(t('own.rows'), this.rows, t('own.rows_hint')),
          h('p.actions', h('button.primary', { type: 'submit' }, t('own.store')),
            h('button', { type: 'button', onclick: () => this.#remove(this.name.value.trim()) }, t('own.back'))))),
      this.note);
  }

  show(feature, names) {
    this.feature = feature;
    refill(this.list, names.map((name) => h('li',
      h('button.quiet', { type: 'button', onclick: () => this.onShow(name) }, name),
      h('button', { type: 'button', 'aria-label': t('own.remove_this', { name }), onclick: () => this.#remove(name) }, t('own.remove')))));
    if (!names.length) this.list.replaceChildren(h('li.aside', t('own.none')));
  }

  async #store() {
    const name = this.name.value.trim();
    // Every answer and verdict of that class changes with it.
    if (isoClass(name) && !await confirm(t('own.overwrite_sure', { name }), t('own.overwrite'))) return;
    await this.#change(() => {
      const rows = readRows(this.rows.value);
      return ['PUT', name, { rows }];
    }, 'own.stored');
  }

  #remove(name) {
    return this.#change(() => ['DELETE', name], 'own.removed');
  }

  async #change(order, done) {
    try {
      const [method, name, body] = order();
      await request(method, url(['tables', this.feature, 'classes', name]), { body });
      this.note.setAttribute('role', 'status');
      this.note.textContent = t(done, { name });
      this.onChange();
    } catch (problem) {
      this.note.setAttribute('role', 'alert');
      this.note.textContent = explain(problem);
    }
  }
}
