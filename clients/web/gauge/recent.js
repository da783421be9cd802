/** The values of this station, the newest first, with what became of each. */

import { h } from '../dom.js';
import { number, t, time } from '../i18n.js';
import { LaterStore, readJson, store } from '../stored.js';
import { distanceText, measuredText, noteText, verdictMark, verdictShape } from '../verdict.js';

const MOST = 100;
const KEPT = 'recent';

/** What was judged by the limits held is no record yet: it says both. */
const waitingMark = (state, { verdict }) => (verdict && state === 'waiting'
  ? h('span.mark-of', { 'data-verdict': verdict }, verdictShape(verdict), t(`verdict.${verdict}`), h('span.aside', t('recent.waiting')))
  : h('span.mark-of', verdictShape('waiting'), t(`recent.${state}`)));

export class Recent {
  /** @param onCorrect takes the record to correct, and what of it: `measured_mm` or `part_id`; @param leaving ends it */
  constructor({ onCorrect, leaving }) {
    this.onCorrect = onCorrect;
    this.kept = new LaterStore(() => store(KEPT, JSON.stringify(this.rows), 'session'), leaving);
    this.rows = readJson(KEPT, [], 'session');
    this.list = h('ol');
    this.element = h('section.recent', { 'aria-labelledby': 'recent-title' },
      h('h2', { id: 'recent-title' }, t('recent.title')), this.list);
    this.list.append(...this.rows.map((row) => this.#item(row)));
    this.element.hidden = this.rows.length === 0;
  }

  /** The last value that was taken: its record, null while it is not stored, undefined where there is none. */
  get last() {
    const row = this.rows.find(({ state, corrected }) => ['stored', 'waiting'].includes(state) && !corrected);
    return row && (row.record ?? null);
  }

  /** @param row {key, state: waiting | stored | refused | dropped, shown, record, reason} */
  set(row) {
    const at = this.rows.findIndex((other) => other.key === row.key);
    if (at >= 0) {
      this.rows[at] = { note: this.rows[at].note, ...row };
      this.#redraw(at);
    } else {
      this.rows.unshift(row);
      this.list.prepend(this.#item(row));
    }
    const corrected = row.record ? this.rows.findIndex((other) => other.record && other.record.id === row.record.correction_of) : -1;
    if (corrected >= 0) {
      this.rows[corrected].corrected = true;
      this.#redraw(corrected);
    }
    for (; this.rows.length > MOST; this.rows.pop()) this.list.lastElementChild.remove();
    this.element.hidden = false;
    this.kept.changed();
  }

  /** Shows what was noted about a value. */
  noted(key, note) {
    const at = this.rows.findIndex((other) => other.key === key);
    if (at < 0) return;
    this.rows[at].note = note;
    this.#redraw(at);
    this.kept.changed();
  }

  #redraw(at) {
    this.list.children[at].replaceWith(this.#item(this.rows[at]));
  }

  #item(row) {
    const { shown, record, state } = row;
    return h('li', { class: row.corrected ? 'corrected' : state },
      record ? verdictMark(record.verdict) : waitingMark(state, shown),
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
