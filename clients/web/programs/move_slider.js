/** Goes through the moves of a run: where the machine is, with which feed, and which line of the program it comes from. */

import { h, refill } from '../dom.js';
import { number, t } from '../i18n.js';
import { fileName } from './disk.js';
import { placeText } from './findings.js';
import { StepPanel } from './step_panel.js';

const AXES = ['X', 'Y', 'Z'];
const place = (point) => AXES.filter((axis) => axis in point).map((axis) => `${axis} ${number(String(point[axis]))}`).join('  ');
/** What a move changes is bold. */
const changed = ({ start_mm: start, end_mm: end }) => AXES.filter((axis) => axis in end)
  .flatMap((axis, i) => [i > 0 && '  ', h(start[axis] === end[axis] ? 'span' : 'strong', place({ [axis]: end[axis] }))]);

export class MoveSlider {
  /** @param trace a Trace; @param program that was run; @param times where the time of each tool is shown; @param onMove takes the move that is shown, and the block where that is another one */
  constructor(trace, program, times, onMove) {
    Object.assign(this, { trace, onMove });
    this.said = h('output');
    this.slider = h('input', { type: 'range', min: 0, max: trace.length - 1, 'aria-label': t('programs.move'), oninput: () => this.#show() });
    this.slider.value = trace.length - 1;
    this.panel = trace.blocks?.length ? new StepPanel(trace, program, times, (block, last) => this.#showBlock(block, last)) : null;
    const button = (sign, name, find) => h('button', { type: 'button', 'aria-label': t(name), title: t(name), onclick: () => find() }, sign);
    this.element = h('div.moves', h('div.steps', button('«', 'programs.block_back', () => this.#block(-1)), button('‹', 'programs.step_back', () => this.#go(this.#at - 1)), this.slider,
      button('›', 'programs.step', () => this.#go(this.#at + 1)), button('»', 'programs.block', () => this.#block(1))), this.said, this.panel?.element ?? []);
    this.#say(trace.at(trace.length - 1));
  }

  get #at() {
    return Number(this.slider.value);
  }

  #go(at) {
    this.slider.value = Math.min(Math.max(at, 0), this.trace.length - 1);
    this.#show();
  }

  /** To the next block, or the one before: of a run without blocks to the first move of another line. @param way 1 or -1 */
  #block(way) {
    if (this.panel) return this.panel.step(way);
    const blockOf = (i) => JSON.stringify([this.trace.at(i).program, this.trace.at(i).line]);
    const isInside = (i) => i >= 0 && i < this.trace.length;
    const own = blockOf(this.#at);
    let at = this.#at + way;
    while (isInside(at) && blockOf(at) === own) at += way;
    if (way < 0) while (isInside(at - 1) && blockOf(at - 1) === blockOf(at)) at -= 1;
    return this.#go(at);
  }

  /** A block that moved nothing is shown at the last move before it. */
  #showBlock(block, last) {
    const move = this.trace.at(Math.max(last, 0));
    this.slider.value = Math.max(last, 0);
    this.#say(move);
    this.onMove(move, block);
  }

  /** Goes to the first move that a line of a program commands; another time to the next one. */
  toLine(program, line) {
    const isOf = (path) => fileName(path).toLowerCase() === fileName(program).toLowerCase();
    const after = this.trace.indexOf(line, isOf, this.#at + 1);
    const found = after >= 0 ? after : this.trace.indexOf(line, isOf);
    if (found < 0) return;
    this.#go(found);
  }

  #show() {
    const move = this.trace.at(this.#at);
    this.panel?.showMove(this.#at);
    this.#say(move);
    this.onMove(move);
  }

  #say(move) {
    const contact = move.contact_mm && `${t('programs.kind.contact')} ${place(move.contact_mm)}`;
    const parts = [t('programs.move_of', { at: this.#at + 1, count: this.trace.length }), `${fileName(move.program)} ${placeText(move)}`,
      t(`programs.kind.${move.kind}`), changed(move), move.kind !== 'rapid' && `F ${number(String(move.feed_mm_min))}`, contact].filter(Boolean);
    refill(this.said, parts.flatMap((part, i) => [i > 0 && ' · ', part]));
  }
}
