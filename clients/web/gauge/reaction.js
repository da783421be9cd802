/**
 * What a plan demands after a value that is not good: it stands there, and no value is taken, until somebody
 * says that it is done. Kept with the window, so that a reload skips nothing.
 */

import { h, refill } from '../dom.js';
import { t } from '../i18n.js';
import { readJson, store } from '../stored.js';
import { verdictMark } from '../verdict.js';

const KEPT = 'reactions';

export class Reactions {
  /** @param onDone is told when nothing is left to be done */
  constructor(onDone) {
    this.onDone = onDone;
    this.open = readJson(KEPT, [], 'session');
    this.element = h('section.reactions', { role: 'alert', 'aria-label': t('reaction.label') });
    this.#draw();
  }

  /** Why no value is taken; '' where one is. */
  get reason() {
    return this.open.length ? t('reaction.first', { reaction: this.open[0].reaction }) : '';
  }

  /** Notes how a value was: as the page judges it when it is typed, then as the service does. */
  judged(key, { part_id, characteristic, reaction }, verdict) {
    const rest = this.open.filter((one) => one.key !== key);
    const known = rest.length < this.open.length;
    if (verdict === 'good') this.open = rest;
    else if (reaction && verdict && !known) this.open = [...rest, { key, part_id, characteristic, reaction, verdict }];
    else return;
    this.#keep();
  }

  #done(key) {
    this.open = this.open.filter((one) => one.key !== key);
    this.#keep();
    if (!this.open.length) this.onDone();
  }

  #keep() {
    store(KEPT, JSON.stringify(this.open), 'session');
    this.#draw();
  }

  #draw() {
    this.element.hidden = !this.open.length;
    refill(this.element, this.open.map((one) => h('div.line', verdictMark(one.verdict),
      h('span', [one.part_id, one.characteristic].filter(Boolean).join(' · ')), h('strong', one.reaction),
      h('button.primary', { type: 'button', onclick: () => this.#done(one.key) }, t('reaction.done')))));
  }
}
