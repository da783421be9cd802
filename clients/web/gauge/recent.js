/** The values of this station, the newest first, with what became of each. */

import { h } from '../dom.js';
import { number, t, time } from '../i18n.js';
import { readJson, store } from '../stored.js';
import { distanceText, measuredText, noteText, verdictMark, verdictShape } from '../verdict.js';

const MOST = 100;
const KEPT = 'recent';

export class Recent {
  /** @param onCorrect takes the record to correct, and what of it: `measured_mm` or `part_id` */
  constructor({ onCorrect }) {
    this.onCorrect = onCorrect;
    this.rows = readJson(KEPT, [], 'session');
    this.list = h('ol');
    this.element = h('section.recent', { 'aria-labelledby': 'recent-title' },
      h('h2', { id: 'recent-title' }, t('recent.title')), this.list);
    this.#draw();
  }

  /** The last record that can be corrected. */
  get last() {
    return this.rows.find((row) => row.state === 'stored' && !row.corrected)?.record;
  }

  /** @param row {key, state: waiting | stored | refused | dropped, shown, record, reason} */
  set(row) {
    const at = this.rows.findIndex((other) => other.key === row.key);
    if (at >= 0) this.rows[at] = { note: this.rows[at].note, ...row };
    else this.rows.unshift(row);
    const corrected = this.rows.find((other) => row.record && other.record?.id === row.record.correction_of);
    if (corrected) corrected.corrected = true;
    this.rows.length = Math.min(this.rows.length, MOST);
    this.#keep();
  }

  /** Shows what was noted about a value. */
  noted(key, note) {
    const row = this.rows.find((other) => other.key === key);
    if (!row) return;
    row.note = note;
    this.#keep();
  }

  #keep() {
    store(KEPT, JSON.stringify(this.rows), 'session');
    this.#draw();
  }

  #draw() {
    this.element.hidden = this.rows.length === 0;
    this.list.replaceChildren(...this.rows.map((row) => this.#item(row)));
  }

  #item(row) {
    const { shown, record, state } = row;
    return h('li', { class: row.corrected ? 'corrected' : state },
      record ? verdictMark(record.verdict) : h('span.mark-of', verdictShape('waiting'), t(`recent.${state}`)),
      h('span.figure', record ? measuredText(record) : number(shown.measured)),
      h('span.aside', [(record ?? shown).part_id, record?.designation ?? shown.designation, time(new Date(shown.at)),
        row.corrected && t('recent.corrected')].filter(Boolean).join(' · ')),
      h('span.aside', record ? distanceText(record) : row.reason ?? ''), row.note && h('span.aside.noted', noteText(row.note)),
      state === 'stored' && !row.corrected && h('span.fix',
        this.#fix(record, 'measured_mm', 'recent.correct'), this.#fix(record, 'part_id', 'recent.correct_part')));
  }

  #fix(record, what, name) {
    return h('button.quiet', {
      type: 'button', onclick: () => this.onCorrect(record, what),
      'aria-label': t(`${name}_this`, { mm: measuredText(record), part: record.part_id ?? t('part.none') }),
    }, t(name));
  }
}
