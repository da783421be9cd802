/**
 * The one door for keys: whatever is typed or scanned outside another field comes here whole, and is
 * read at Enter, Tab or CR LF. An Enter with nothing new typed is the second of a pair (CR LF, a
 * bouncing key) for 300 ms.
 */

import { designationText } from '../designation.js';
import { h } from '../dom.js';
import { LARGEST_NM, mmText, nmFromMm, parseMeasured } from '../exact.js';
import { number, t } from '../i18n.js';
import { isBadge } from './badge.js';
import { BurstWatch, isFar, isReading, readLine } from './reading.js';

const SECOND_ENTER_MS = 300;
/** Where characters are typed: what is chosen or ticked takes none of a gauge's. */
const FIELDS = 'input:not([type="checkbox"], [type="radio"]), textarea, dialog, [contenteditable]';

export class Entry {
  /**
   * @param job gives {nominal_nm, limits} or a reason why nothing can be gauged: {reason}
   * @param prefixes gives what stands before a scan of each field: {part_id: 'P:', …}
   * @param onValue takes {text, correcting}: the exact decimal, and the record it corrects
   * @param onJob takes a designation, and resolves to whether there is such a one, undefined where nobody can say; @param onField takes (name, text, correcting)
   * @param onBadge takes a key that was scanned
   * @param isName tells whether a text names something known, such as a plan; @param onTyped is told of the first character
   * @param onOpen takes what was typed and is not taken as it is
   * @param onDropped takes the decimal of a value that was asked about and not kept
   */
  constructor({ job, prefixes, onValue, onJob, onField, onBadge, isName, onTyped, onOpen, onDropped }) {
    Object.assign(this, { job, prefixes, onValue, onJob, onField, onBadge, isName, onTyped, onOpen, onDropped });
    this.lastEnter = -Infinity;
    this.asked = null;
    this.correcting = null;
    this.burst = new BurstWatch();
    this.input = h('input.value', {
      id: 'value', name: 'value', type: 'text', inputmode: 'decimal', autocomplete: 'off', maxlength: 300,
      autocapitalize: 'off', spellcheck: 'false', 'aria-describedby': 'entry-note', enterkeyhint: 'send',
      oninput: () => this.#typed(), onkeydown: (event) => this.#key(event),
    });
    this.label = h('label.label', { for: 'value' }, t('entry.label'));
    this.note = h('p.note', { id: 'entry-note', role: 'alert' });
    this.choices = h('p.actions', { hidden: true });
    this.element = h('form.entry', { novalidate: true, onsubmit: (event) => this.#enter(event) },
      this.label,
      h('div.line', this.input, h('span.unit', { 'aria-hidden': 'true' }, 'mm'),
        h('button.primary', { type: 'submit' }, t('entry.judge'))),
      this.note, this.choices);
  }

  focus() {
    this.input.focus();
  }

  /** Sends the keys of the page here that no other field takes. */
  takeKeys(signal) {
    document.addEventListener('keydown', (event) => {
      const writes = event.key.length === 1 && event.key !== ' ' && !event.ctrlKey && !event.altKey && !event.metaKey;
      if (!writes || event.target.closest?.(FIELDS)) return;
      // The character itself follows the focus, so nothing before it is lost.
      this.focus();
      this.#follow(event);
    }, { signal, capture: true });
  }

  /** Says why what a gauge sent is no value; what is typed meanwhile stays. */
  unread(reason) {
    this.element.classList.add('refusing');
    this.#say(reason);
  }

  /** A line that came another way: by a wire, or typed into the dialog for keys. @param burst whether it came as fast as a scanner types */
  take(text, burst = false) {
    if (this.adopting) {
      // What is measured now is still being asked: the value belongs to nothing.
      if (parseMeasured(text) !== null) this.onDropped(parseMeasured(text));
      return this.unread(t('entry.busy'));
    }
    this.input.value = text;
    this.#typed();
    if (burst) this.burst.took(text);
    return this.#enter();
  }

  /** A value that was typed where a name goes: it stands in the field, and Enter stores it. */
  hold(text) {
    this.input.value = text;
    this.#typed();
    this.focus();
    this.#refuse(t('entry.reading', { typed: text }));
  }

  /** The next value, or the next name, corrects a record. @param what `measured_mm` or `part_id` */
  correct(record, what = 'measured_mm') {
    this.#reset();
    this.correcting = { record, what };
    this.label.textContent = what === 'measured_mm'
      ? t('entry.correcting', { mm: number(mmText(nmFromMm(record.measured_mm))) })
      : t('entry.correcting_part', { part: record.part_id ?? t('part.none') });
    this.element.classList.add('correcting');
    this.#say(t(`entry.correct_how.${what}`));
    this.focus();
  }

  #enter(event) {
    event?.preventDefault();
    // When the key was struck, not when a busy page has time for it: the second of a pair would answer for somebody.
    const now = this.struck ?? event?.timeStamp ?? performance.now();
    this.struck = undefined;
    // A size is being asked for: what is typed stays in the field.
    if (this.adopting) return this.input.value.trim() ? this.#refuse(t('entry.busy')) : undefined;
    const second = now - this.lastEnter < SECOND_ENTER_MS;
    this.lastEnter = now;
    if (this.unchanged) {
      if (second) return undefined;
      if (this.asked) return this.#accept(this.asked);
    }
    this.unchanged = true;
    return this.#read();
  }

  #read() {
    const typed = this.input.value.trim();
    if (typed === '') return this.#refuse(t('entry.empty'));
    if (isBadge(typed)) return this.#finish(() => this.onBadge(typed));
    const burst = this.burst.isBurst(typed);
    // A scanner's 25H7 comes as 25h7 then: another thing.
    if (burst && this.caps && parseMeasured(typed) === null) return this.#refuse(t('entry.caps'));
    if (this.correcting?.what === 'part_id') return this.#correctPart(typed);
    if (!this.correcting && parseMeasured(typed) === null && this.isName(typed)) return this.#finish(() => this.onField('part_id', typed));
    const read = readLine(typed, { burst, prefixes: this.prefixes() });
    if (read.kind === 'value') return this.#judge(read.text);
    if (this.correcting) return this.#refuse(t('entry.malformed', { typed }));
    if (read.kind === 'job') return this.#adopt(read);
    if (read.kind === 'field') return this.#finish(() => this.onField(read.name, read.text));
    return this.#refuse(t('entry.malformed', { typed }));
  }

  /** `25.013in` is written like a size and a class, the number of a part like a thread: the service knows whether there is one. */
  async #adopt({ text, name }) {
    // What is typed until it is known is another line.
    this.#finish(() => {});
    this.adopting = true;
    this.element.setAttribute('aria-busy', true);
    const known = await this.onJob(text);
    this.adopting = false;
    this.element.removeAttribute('aria-busy');
    if (known) return;
    if (known === false && name) {
      this.onField(name, text);
      return;
    }
    this.input.value ||= text;
    this.#refuse(t('entry.malformed', { typed: text }));
  }

  #correctPart(typed) {
    const { record } = this.correcting;
    if (isReading(typed, { limits: record })) return this.#refuse(t('entry.reading', { typed }));
    return this.#finish(() => this.onField('part_id', this.#withoutPrefix(typed), record));
  }

  #withoutPrefix(typed) {
    const read = readLine(typed, { prefixes: this.prefixes() });
    return read.kind === 'field' && read.name === 'part_id' ? read.text : typed;
  }

  #judge(text) {
    const job = this.correcting ? { limits: this.correcting.record } : this.job();
    if (job.reason) return this.#refuse(job.reason);
    const nm = nmFromMm(text);
    if (nm <= 0 || nm > LARGEST_NM) return this.#refuse(t('entry.out_of_range', { typed: this.input.value.trim() }));
    if (isFar(nm, job)) return this.#ask(text, job);
    return this.#accept(text);
  }

  #accept(text) {
    const { correcting } = this;
    this.#finish(() => this.onValue({ text, correcting: correcting?.record }));
  }

  #finish(act) {
    act();
    this.#reset();
    this.unchanged = true;
  }

  /** Far outside lie a wrong class, a lost point, a gauge in inches, and the number of a part. */
  #ask(text, { limits, nominal_nm: nominal }) {
    this.asked = text;
    this.element.classList.add('asking');
    this.onOpen(this.input.value.trim());
    const typed = this.input.value.trim();
    this.#say(t('entry.ask', { mm: number(text), nominal: limits?.designation ? designationText(limits.designation).replace('Ø ', '') : number(mmText(nominal, 0)) }));
    const choice = (label, act) => h('button', { type: 'button', onclick: act }, label);
    this.#offer([
      choice(t('entry.ask_keep'), () => this.#accept(text)),
      !this.correcting && choice(t('entry.ask_part', { part: typed }), () => {
        this.onDropped(text);
        this.#finish(() => this.onField('part_id', typed));
      }),
      choice(t('entry.ask_drop'), () => this.#drop()),
    ]);
    this.input.select();
  }

  #drop() {
    if (this.asked) this.onDropped(this.asked);
    this.#reset();
    this.focus();
  }

  #refuse(reason) {
    this.element.classList.add('refusing');
    if (this.input.value.trim()) this.onOpen(this.input.value.trim());
    this.#say(reason);
    this.input.select();
    this.#forgetKeys();
  }

  #typed() {
    this.unchanged = false;
    if (this.input.value) this.onTyped();
    if (this.input.value === '') this.#forgetKeys();
    if (this.asked) this.onDropped(this.asked);
    this.asked = null;
    this.#offer([]);
    this.element.classList.remove('asking', 'refusing');
    this.#say(this.correcting ? t(`entry.correct_how.${this.correcting.what}`) : '');
  }

  #key(event) {
    const { selectionStart, selectionEnd, value } = this.input;
    if (event.key.length === 1) {
      // A character over a selection of all begins a new line.
      if (selectionStart === 0 && selectionEnd === value.length) this.#forgetKeys();
      this.#follow(event);
    }
    if (event.key === 'Enter' && event.repeat) event.preventDefault();
    else if (event.key === 'Enter') this.struck = event.timeStamp;
    if (event.key === 'Tab' && !event.shiftKey && value.trim() && !this.asked) this.#enter(event);
    if (event.key === 'Escape') this.#drop();
  }

  #follow(event) {
    this.burst.key(event.timeStamp);
    this.caps ||= event.getModifierState('CapsLock');
  }

  #forgetKeys() {
    this.burst.reset();
    this.caps = false;
  }

  #reset() {
    this.asked = null;
    this.correcting = null;
    this.unchanged = false;
    this.input.value = '';
    this.#forgetKeys();
    this.#offer([]);
    this.label.textContent = t('entry.label');
    this.element.classList.remove('asking', 'refusing', 'correcting');
    this.#say('');
  }

  #offer(choices) {
    this.choices.replaceChildren(...choices.filter(Boolean));
    this.choices.hidden = choices.length === 0;
  }

  #say(text) {
    if (this.note.textContent !== text) this.note.textContent = text;
  }
}
