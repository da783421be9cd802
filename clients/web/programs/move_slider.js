/** Goes through the moves of a run: where the machine is, with which feed, and which line of the program it comes from. */

import { h } from '../dom.js';
import { number, t } from '../i18n.js';
import { fileName } from './disk.js';

const AXES = ['X', 'Y', 'Z'];
const place = (point) => AXES.filter((axis) => axis in point).map((axis) => `${axis} ${number(String(point[axis]))}`).join('  ');

export class MoveSlider {
  /** @param trace a Trace; @param onMove takes the move that is shown */
  constructor(trace, onMove) {
    Object.assign(this, { trace, onMove });
    this.said = h('output');
    this.slider = h('input', { type: 'range', min: 0, max: trace.length - 1, 'aria-label': t('programs.move'), oninput: () => this.#show() });
    this.slider.value = trace.length - 1;
    this.element = h('div.moves', this.slider, this.said);
  }

  /** Goes to the first move that a line of a program commands; another time to the next one. */
  toLine(program, line) {
    const isOf = (path) => fileName(path).toLowerCase() === fileName(program).toLowerCase();
    const after = this.trace.indexOf(line, isOf, Number(this.slider.value) + 1);
    const found = after >= 0 ? after : this.trace.indexOf(line, isOf);
    if (found < 0) return;
    this.slider.value = found;
    this.#show();
  }

  #show() {
    const at = Number(this.slider.value);
    const move = this.trace.at(at);
    const contact = move.contact_mm && `${t('programs.kind.contact')} ${place(move.contact_mm)}`;
    this.said.textContent = [t('programs.move_of', { at: at + 1, count: this.trace.length }), `${fileName(move.program)} ${t('programs.line', { line: move.line })}`,
      t(`programs.kind.${move.kind}`), place(move.end_mm), move.kind !== 'rapid' && `F ${number(String(move.feed_mm_min))}`, contact].filter(Boolean).join(' · ');
    this.onMove(move);
  }
}
