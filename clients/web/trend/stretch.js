/** Which stretch of the values a chart shows: all, or what was chosen, which a slider moves. */

import { h } from '../dom.js';
import { t } from '../i18n.js';

/** Fewer points than this are no stretch. */
const FEWEST = 5;

export class Stretch {
  #chosen = null;
  #count = 0;

  constructor(onChange) {
    this.onChange = onChange;
    this.said = h('span');
    this.slider = h('input', { type: 'range', min: 0, 'aria-label': t('trend.move'), oninput: () => this.#move(Number(this.slider.value)) });
    this.element = h('div.line.stretch', { hidden: true }, this.said, this.slider,
      h('button', { type: 'button', onclick: () => this.clear() }, t('trend.whole')));
  }

  /** {from, to} of `count` points, both included. */
  of(count) {
    this.#count = count;
    const chosen = this.#chosen && Math.min(this.#chosen.length, count);
    const from = chosen ? Math.min(this.#chosen.from, count - chosen) : 0;
    const view = { from, to: chosen ? from + chosen - 1 : Math.max(count - 1, 0) };
    this.#say(view);
    return view;
  }

  choose(from, to) {
    const length = Math.max(to - from + 1, FEWEST);
    this.#chosen = length < this.#count ? { from: Math.min(from, this.#count - length), length } : null;
    this.onChange();
  }

  /** Moves so far that a point is in sight. */
  reveal(index) {
    if (!this.#chosen) return;
    const { from, length } = this.#chosen;
    this.#chosen = { length, from: Math.min(Math.max(from, index - length + 1), index) };
  }

  clear() {
    this.#chosen = null;
    this.onChange();
  }

  #move(from) {
    this.#chosen = { ...this.#chosen, from };
    this.onChange();
  }

  #say({ from, to }) {
    this.element.hidden = !this.#chosen;
    this.said.textContent = t('trend.stretch', { from: from + 1, to: to + 1, count: this.#count });
    this.slider.max = Math.max(this.#count - (to - from + 1), 0);
    this.slider.value = from;
  }
}
