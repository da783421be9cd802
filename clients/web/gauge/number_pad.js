/** Figures to touch, for tablets: the value field without the keyboard of the system over the verdict. */

import { h } from '../dom.js';
import { number, t } from '../i18n.js';
import { readStored, store } from '../stored.js';

const KEPT = 'number-pad';
const FIGURES = ['7', '8', '9', '4', '5', '6', '1', '2', '3', '0'];

export class NumberPad {
  /** @param input the field it writes to */
  constructor(input) {
    this.input = input;
    const point = number('0.1').charAt(1);
    this.minus = h('button.minus', { type: 'button', hidden: true, onclick: () => this.#write('-'), 'aria-label': t('pad.minus') }, number('-'));
    const key = (text, act, label) => h('button', { type: 'button', onclick: act, 'aria-label': label }, text);
    this.element = h('div.pad', { role: 'group', 'aria-label': t('pad.label') },
      // The field keeps the focus and its caret.
      FIGURES.map((figure) => key(figure, () => this.#write(figure))), key(point, () => this.#write(point)), key('⌫', () => this.#back(), t('pad.back')),
      h('button.primary', { type: 'button', onclick: () => this.input.form.requestSubmit(), 'aria-label': t('entry.judge') }, '⏎'), this.minus);
    this.element.addEventListener('pointerdown', (event) => event.preventDefault());
    const touched = matchMedia('(pointer: coarse)').matches ? 'on' : 'off';
    const on = (readStored(KEPT) ?? touched) === 'on';
    this.choice = h('label.choice', h('input', { type: 'checkbox', name: 'pad', checked: on, onchange: ({ target }) => {
      store(KEPT, target.checked ? 'on' : 'off');
      this.#show(target.checked);
    } }), h('span', t('job.pad')));
    this.#show(on);
  }

  /** Has a key for the sign where a value may be below 0. */
  signed(on) {
    this.minus.hidden = !on;
  }

  #show(on) {
    this.element.hidden = !on;
    this.input.inputMode = on ? 'none' : 'decimal';
  }

  #write(text) {
    const { input } = this;
    input.focus();
    input.setRangeText(text, input.selectionStart, input.selectionEnd, 'end');
    input.dispatchEvent(new InputEvent('input', { bubbles: true, data: text }));
  }

  #back() {
    const { input } = this;
    if (input.selectionStart === input.selectionEnd) input.setSelectionRange(Math.max(input.selectionStart - 1, 0), input.selectionEnd);
    this.#write('');
  }
}
