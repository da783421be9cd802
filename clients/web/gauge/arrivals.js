/**
 * What became of the values that were typed while the service was away: counted by verdict, each that
 * is not good named, until somebody has touched it. Kept in the browser, so that a reload hides nothing.
 */

import { h, refill } from '../dom.js';
import { number, t } from '../i18n.js';
import { readJson, store } from '../stored.js';
import { distanceText, measuredText, verdictMark, VERDICTS } from '../verdict.js';

const KEPT = 'arrivals';

const NOTHING = { stored: 0, refused: 0, verdicts: {}, bad: [], ids: [] };

export class Arrivals {
  /** The tabs of a browser are one station: each shows what came through any of them. @param leaving ends it */
  constructor(leaving) {
    this.element = h('section.arrived', { role: 'alert', hidden: true });
    addEventListener('storage', () => this.#draw(), { signal: leaving });
    this.#draw();
  }

  get counts() {
    return { ...NOTHING, ...readJson(KEPT, this.kept ?? {}) };
  }

  /** A value that two tabs have sent is one. */
  stored(record) {
    const { counts } = this;
    if (counts.ids.includes(record.id)) return;
    const { verdict } = record;
    this.#keep({
      ...counts, stored: counts.stored + 1, ids: [...counts.ids, record.id], verdicts: { ...counts.verdicts, [verdict]: (counts.verdicts[verdict] ?? 0) + 1 },
      bad: verdict === 'good' ? counts.bad : [...counts.bad, { record }],
    });
  }

  refused(shown, reason) {
    const { counts } = this;
    this.#keep({ ...counts, refused: counts.refused + 1, bad: [...counts.bad, { shown, reason }] });
  }

  #seen() {
    this.#keep(NOTHING);
  }

  #keep(counts) {
    this.kept = counts;
    store(KEPT, JSON.stringify(counts));
    this.#draw();
  }

  #draw() {
    const { stored, refused, verdicts, bad } = this.counts;
    this.element.hidden = stored + refused === 0;
    this.element.classList.toggle('bad', bad.length > 0);
    const parts = VERDICTS.filter((verdict) => verdicts[verdict])
      .map((verdict) => h('strong', { class: verdict }, t(`arrived.${verdict}`, { count: verdicts[verdict] })));
    if (refused) parts.push(h('strong.reject', t('arrived.refused', { count: refused })));
    refill(this.element,
      h('p', t('arrived.stored', { count: stored }), ' ', parts.flatMap((part, i) => (i ? [', ', part] : [part]))),
      h('button', { type: 'button', onclick: () => this.#seen() }, t('arrived.seen')),
      bad.length > 0 && h('ol', bad.map((each) => this.#item(each))));
  }

  #item({ record, shown, reason }) {
    return h('li', record ? verdictMark(record.verdict) : h('span', t('panel.refused')),
      h('span.figure', record ? `${measuredText(record)} mm` : `${number(shown.measured)} mm`),
      h('span', [(record ?? shown).part_id, (record ?? shown).characteristic, (record ?? shown).designation].filter(Boolean).join(' · ')),
      h('span.aside', record ? distanceText(record) : reason));
  }
}
