/**
 * The one input of a gauging station: keyboards and gauges that type like one. Enter posts and clears
 * it; an Enter with nothing new typed is the second of a pair (CR LF, a bouncing key) for 300 ms.
 */

import { h } from '../dom.js';
import { LARGEST_NM, mmText, nmFromMm, parseMeasured } from '../exact.js';
import { number, t } from '../i18n.js';

const SECOND_ENTER_MS = 300;

export class Entry {
  /**
   * @param job gives {nominal_nm} or a reason why nothing can be gauged: {reason}
   * @param onValue takes {text, correcting}: the exact decimal, and the record it corrects
   * @param onOpen takes what was typed and is not taken as it is
   * @param onDropped takes the decimal of a value that was asked about and not kept
   */
  constructor({ job, onValue, onOpen, onDropped }) {
    this.job = job;
    this.onValue = onValue;
    this.onOpen = onOpen;
    this.onDropped = onDropped;
    this.lastEnter = -Infinity;
    this.asked = null;
    this.correcting = null;
    this.input = h('input.value', {
      id: 'value', name: 'value', type: 'text', inputmode: 'decimal', autocomplete: 'off',
      autocapitalize: 'off', spellcheck: 'false', 'aria-describedby': 'entry-note', enterkeyhint: 'send',
      oninput: () => this.#typed(), onkeydown: (event) => this.#key(event),
    });
    this.label = h('label.label', { for: 'value' }, t('entry.label'));
    this.note = h('p.note', { id: 'entry-note', role: 'alert' });
    this.element = h('form.entry', { novalidate: true, onsubmit: (event) => this.#enter(event) },
      this.label,
      h('div.line', this.input, h('span.unit', { 'aria-hidden': 'true' }, 'mm'),
        h('button.primary', { type: 'submit' }, t('entry.judge'))),
      this.note);
  }

  focus() {
    this.input.focus();
  }

  /** The next value corrects a record. */
  correct(record) {
    this.#reset();
    this.correcting = record;
    this.label.textContent = t('entry.correcting', { mm: number(mmText(nmFromMm(record.measured_mm))) });
    this.element.classList.add('correcting');
    this.#say(t('entry.correct_how'));
    this.focus();
  }

  #enter(event) {
    event.preventDefault();
    const now = performance.now();
    const second = now - this.lastEnter < SECOND_ENTER_MS;
    this.lastEnter = now;
    if (this.unchanged) {
      if (second) return;
      if (this.asked) return this.#accept(this.asked);
    }
    this.unchanged = true;
    this.#judge();
  }

  #judge() {
    const typed = this.input.value.trim();
    const { reason, nominal_nm: nominal } = this.job();
    if (reason) return this.#refuse(reason);
    if (typed === '') return this.#refuse(t('entry.empty'));
    const text = parseMeasured(typed);
    if (text === null) return this.#refuse(t('entry.malformed', { typed }));
    const nm = nmFromMm(text);
    if (nm <= 0 || nm > LARGEST_NM) return this.#refuse(t('entry.out_of_range', { typed }));
    if (2 * nm < nominal || nm > 2 * nominal) return this.#ask(text, nominal);
    this.#accept(text);
  }

  #accept(text) {
    const { correcting } = this;
    this.#reset();
    this.unchanged = true;
    this.onValue({ text, correcting });
  }

  /** Half to twice the nominal size is left by a wrong class, a lost point or a gauge in inches. */
  #ask(text, nominal) {
    this.asked = text;
    this.element.classList.add('asking');
    this.onOpen(this.input.value.trim());
    this.#say(t('entry.ask', { mm: number(text), nominal: number(mmText(nominal, 0)) }));
    this.input.select();
  }

  #refuse(reason) {
    this.element.classList.add('refusing');
    if (this.input.value.trim()) this.onOpen(this.input.value.trim());
    this.#say(reason);
    this.input.select();
  }

  #typed() {
    this.unchanged = false;
    if (this.asked) this.onDropped(this.asked);
    this.asked = null;
    this.element.classList.remove('asking', 'refusing');
    this.#say(this.correcting ? t('entry.correct_how') : '');
  }

  #key(event) {
    if (event.key === 'Enter' && event.repeat) event.preventDefault();
    if (event.key === 'Escape') {
      if (this.asked) this.onDropped(this.asked);
      this.#reset();
    }
  }

  #reset() {
    this.asked = null;
    this.correcting = null;
    this.unchanged = false;
    this.input.value = '';
    this.label.textContent = t('entry.label');
    this.element.classList.remove('asking', 'refusing', 'correcting');
    this.#say('');
  }

  #say(text) {
    if (this.note.textContent !== text) this.note.textContent = text;
  }
}
