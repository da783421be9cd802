/**
 * What became of the values that were typed while the service was away: counted by verdict, each that
 * is not good named, until somebody has touched it. Kept in the browser, so that a reload hides nothing.
 */

import { h, refill } from '../dom.js';
import { number, t } from '../i18n.js';
import { readJson, store } from '../stored.js';
import { distanceText, measuredText, verdictMark, VERDICTS } from '../verdict.js';

const KEPT = 'arrivals';

export class Arrivals {
  constructor() {
    this.counts = readJson(KEPT, { stored: 0, refused: 0, verdicts: {}, bad: [] });
    this.element = h('section.arrived', { role: 'alert', hidden: true });
    this.#draw();
  }

  stored(record) {
    ++this.counts.stored;
    this.counts.verdicts[record.verdict] = (this.counts.verdicts[record.verdict] ?? 0) + 1;
    if (record.verdict !== 'good') this.counts.bad.push({ record });
    this.#keep();
  }

  refused(shown, reason) {
    ++this.counts.refused;
    this.counts.bad.push({ shown, reason });
    this.#keep();
  }

  #seen() {
    this.counts = { stored: 0, refused: 0, verdicts: {}, bad: [] };
    this.#keep();
  }

  #keep() {
    store(KEPT, JSON.stringify(this.counts));
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
