/** Log-in by a badge: a code with an API key, read by the scanner like everything else. */

import { forgetKey, getJson, keyInUse, signOf, url, useKey } from '../api.js';
import { h, refill } from '../dom.js';
import { explain, t } from '../i18n.js';
import { queue } from '../queue.js';
import { readJson, store } from '../stored.js';

const KEY = /^fg_[0-9a-f]{64}$/;
/** Enough of a key to tell it from others, too little to use it. */
const SHOWN = 7;
const KEPT_NAME = 'key-name';

export const isBadge = (text) => KEY.test(text);

export class Badge {
  /** @param onIn is told that somebody has logged in */
  constructor({ onIn }) {
    this.onIn = onIn;
    this.element = h('p.badge', { role: 'status' });
    this.draw();
  }

  /** Whether values are still on their way with the key in use. */
  get #isUsed() {
    return keyInUse() && queue.own.length > 0;
  }

  /** From here on everything is done with this key, if it is valid. */
  async take(key) {
    if (this.#isUsed) return this.draw(t('badge.waiting', { count: queue.own.length }));
    useKey(key);
    this.onIn();
    try {
      await getJson(url(['plans']), { asks: false });
      queue.send();
      return this.draw();
    } catch (problem) {
      return this.draw(problem.status === 401 ? t('key.invalid') : explain(problem));
    }
  }

  /** The name of the key in use, as a record has it. */
  named(caller) {
    const key = keyInUse();
    if (!key || !caller || caller === this.#nameOf(key)) return;
    store(KEPT_NAME, JSON.stringify({ [signOf(key)]: caller }), 'session');
    this.draw();
  }

  #nameOf(key) {
    return readJson(KEPT_NAME, {}, 'session')[signOf(key)];
  }

  draw(problem = '') {
    const key = keyInUse();
    const name = key && this.#nameOf(key);
    this.element.classList.toggle('wrong', problem !== '');
    const [held] = queue.held;
    this.drawn = queue.held.length;
    refill(this.element, problem,
      held && h('span.held', t('badge.held', { count: queue.held.length, key: held.sign.slice(0, SHOWN) })),
      held && h('button', { type: 'button', onclick: () => queue.adopt() }, t('badge.adopt')),
      key && h('span', name ? t('badge.name', { name, key: key.slice(0, SHOWN) }) : t('badge.in', { key: key.slice(0, SHOWN) })),
      key && h('button.quiet', { type: 'button', onclick: () => this.#out() }, t('badge.out')));
  }

  /** What waits for another key may have become more. */
  renew() {
    if (this.drawn !== queue.held.length) this.draw();
  }

  #out() {
    if (this.#isUsed) return this.draw(t('badge.waiting', { count: queue.own.length }));
    return forgetKey();
  }
}
