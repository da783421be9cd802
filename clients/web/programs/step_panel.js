/** Below the moves of a run: the block, what it has changed, and breakpoints. */

import { h, refill } from '../dom.js';
import { number, t } from '../i18n.js';
import { keepBreaks, keptBreaks, readBreaks, toggleBreak } from './breaks.js';
import { fileName } from './disk.js';
import { placeText } from './findings.js';
import { Steps } from './steps.js';

const text = (value) => (value === undefined ? '–' : typeof value === 'string' ? `"${value}"` : number(String(value)));

export class StepPanel {
  /** @param trace with blocks; @param program that was run; @param times where the time of each tool is shown; @param onBlock takes a block and the index of the last move at its end (-1: none) */
  constructor(trace, program, times, onBlock) {
    Object.assign(this, { program, times, onBlock, steps: new Steps(trace) });
    this.at = this.steps.length - 1;
    this.said = h('p', { role: 'status' });
    this.changed = h('div');
    this.all = h('dl.parameters');
    this.breaks = h('input', { type: 'text', name: 'breaks', autocomplete: 'off', spellcheck: 'false', placeholder: '31, 82551.h:35, Q5 > 10', onchange: () => keepBreaks(program, this.breaks.value) });
    this.note = h('p.note', { role: 'alert' });
    const button = (name, act) => h('button', { type: 'button', onclick: act }, t(name));
    this.element = h('section.stepping', { 'aria-label': t('steps.title') }, this.said, this.changed,
      h('details', h('summary', t('steps.watched')), this.all),
      h('div.line.breaks', h('label.field', h('span.label', t('steps.breaks')), this.breaks),
        button('steps.here', () => this.#toggle()), button('steps.back_to', () => this.#find(-1)), button('steps.on_to', () => this.#find(1))),
      this.note);
    this.showBreaks();
    this.#say();
    this.#drawTimes();
  }

  /** The block of a move. */
  showMove(move) {
    this.at = this.steps.blockAt[move] ?? this.at;
    this.#say();
  }

  /** Goes so many blocks on, or back. */
  step(way) {
    this.goTo(this.at + way);
  }

  goTo(at) {
    this.at = Math.min(Math.max(at, 0), this.steps.length - 1);
    this.#say();
    this.onBlock(this.steps.blocks[this.at], this.steps.lastMove[this.at]);
  }

  #say() {
    const block = this.steps.blocks[this.at];
    this.said.textContent = [t('steps.of', { at: this.at + 1, count: this.steps.length }), `${fileName(block.program)} ${placeText(block)}`].join(' · ');
    const changes = this.steps.changesAt(this.at);
    const origins = (block.origins ?? []).map((each) => h('p.aside', `${fileName(each.program)} ${placeText(each)}: `, h('span', { lang: 'en' }, each.message)));
    refill(this.changed, changes.length ? h('dl.parameters', changes.map(([name, before, after]) => h('div', h('dt', name), h('dd', before === undefined ? text(after) : `${text(before)} → ${text(after)}`)))) : h('p.aside', t('steps.unchanged')), origins);
    this.all.hidden = !Object.keys(block.values).length;
    refill(this.all, Object.entries(block.values).map(([name, value]) => h('div', h('dt', name), h('dd', text(value)))));
  }

  #toggle() {
    const { block, program } = this.steps.blocks[this.at];
    toggleBreak(this.program, program, block);
  }

  /** As they are kept now. */
  showBreaks() {
    this.breaks.value = keptBreaks(this.program);
    this.#read();
  }

  /** @returns the breakpoints, or null where one cannot be read */
  #read() {
    this.note.textContent = '';
    try {
      return readBreaks(this.breaks.value, this.program, (typed) => t('steps.malformed', { text: typed }));
    } catch (problem) {
      this.note.textContent = problem.message;
      return null;
    }
  }

  #find(way) {
    const breaks = this.#read();
    if (!breaks) return;
    const found = this.steps.find(breaks, this.at, way);
    if (found < 0) this.note.textContent = t('steps.none');
    else this.goTo(found);
  }

  /** How long each tool was in the spindle. */
  #drawTimes() {
    const times = this.steps.toolTimes();
    const seconds = (value) => `${number(value.toFixed(1))} s`;
    const kinds = ['rapid', 'feed', 'arc', 'probe'].filter((kind) => times.some((one) => one.seconds[kind] > 0));
    refill(this.times, h('div.wide', { tabindex: 0, role: 'region', 'aria-label': t('steps.times') }, h('table', h('caption', t('steps.times')),
      h('thead', h('tr', h('th', { scope: 'col' }, t('field.tool')), kinds.map((kind) => h('th.number', { scope: 'col' }, t(`programs.kind.${kind}`))), h('th.number', { scope: 'col' }, t('steps.total')))),
      h('tbody', times.map((one) => h('tr', h('th', { scope: 'row' }, one.tool || '–'), kinds.map((kind) => h('td.number', seconds(one.seconds[kind]))), h('td.number', seconds(one.total))))))));
  }
}
