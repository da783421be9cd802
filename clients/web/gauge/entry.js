/**
 * The one door for keys: whatever is scanned into any field, or typed outside another field, comes here whole, and is
 * read at Enter, Tab or CR LF. An Enter with nothing new typed is the second of a pair (CR LF, a bouncing key).
 */

import { designationText } from '../designation.js';
import { h } from '../dom.js';
import { LARGEST_NM, leastOf, mmText, nmFromMm, parseMeasured } from '../exact.js';
import { number, t } from '../i18n.js';
import { PAIR_MS } from '../press.js';
import { forget, readJson, store } from '../stored.js';
import { isBadge } from './badge.js';
import { BURST_GAP_MS, BurstWatch, gaugeValue, isFar, isOfPattern, isReading, mmOfInches, readLine, scannerTest } from './reading.js';

/** Where characters are typed: what is chosen or ticked takes none of a gauge's. */
const FIELDS = 'input:not([type="checkbox"], [type="radio"]), textarea, dialog, [contenteditable]';
/** The fields of the station besides this one: a scan into any of them comes here. */
const OTHERS = '.station :is(input[type="text"], textarea)';
const FEWEST_KEYS = 3;
const KEPT = 'typed';
/** After such a pause another line begins in a field; a scan that stutters within it is whole, and typed. */
const PAUSE_MS = 500;
const writes = ({ key, ctrlKey, altKey, metaKey }) => key.length === 1 && !ctrlKey && !altKey && !metaKey;

export class Entry {
  /**
   * @param job gives {nominal_nm, limits} or a reason why nothing can be gauged: {reason}
   * @param subject gives all that goes into the next record besides the value, as one text
   * @param gauged gives the same, also where no value is taken now; @param isSize whether a field is that of the size
   * @param prefixes gives what stands before a scan of each field: {part_id: 'P:', …}; @param pattern gives that of the numbers of parts, '' where any is one
   * @param onValue takes {text, correcting, confirmed}: the exact decimal, the record it corrects, and whether somebody confirmed it though it is far outside
   * @param onJob takes a designation and whether it was scanned, and resolves to whether there is such a one, undefined where nobody can say
   * @param onField takes (name, text, correcting); @param isName whether a field of that name is of the job
   * @param onBadge takes a key that was scanned
   * @param isKnown tells whether a text names something known, such as a plan; @param onTyped is told of the first character
   * @param onOpen takes what was typed and is not taken as it is, and why; @param onAsk takes {text, question, choices}, null once it is answered
   * @param recordOf gives the record in force of an id; @param onCorrecting takes the record that the next line corrects and what of it, null once it is corrected or left
   * @param onTest takes what a scanner has made of the test code
   * @param onDropped takes the decimal of a value that was asked about and not kept
   */
  constructor(door) {
    Object.assign(this, door);
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
    this.element = h('form.entry', { id: 'entry', novalidate: true, onsubmit: (event) => this.#enter(event) },
      this.label,
      h('div.line', this.input, h('span.unit', { 'aria-hidden': 'true' }, 'mm'),
        h('button.primary', { type: 'submit' }, t('entry.judge'))),
      this.note);
  }

  focus() {
    this.input.focus();
  }

  /** What was typed and not ended before a reload is there again, and is not stored; a correction goes on. */
  resume() {
    const { typed, id, what } = readJson(KEPT, {}, 'session');
    const record = id && this.recordOf(id);
    if (record) this.correct(record, what);
    if (!typed || (id && !record)) return;
    this.input.value = typed;
    this.#keep();
    this.input.select(); // the next line replaces it
    this.#say(t('entry.resumed', { typed }));
  }

  /** No key for the service is kept. */
  #keep() {
    const typed = /^fg_/.test(this.input.value) ? '' : this.input.value;
    store(KEPT, JSON.stringify({ typed, id: this.correcting?.record.id, what: this.correcting?.what }), 'session');
  }

  /** Sends the keys of the page here that no other field takes. */
  takeKeys(signal) {
    document.addEventListener('keydown', (event) => this.#watchOthers(event), { signal, capture: true });
    document.addEventListener('keydown', (event) => {
      if (!writes(event) || event.key === ' ' || event.target.closest?.(FIELDS)) return;
      // The character itself follows the focus, so nothing before it is lost.
      this.focus();
      this.#follow(event);
    }, { signal, capture: true });
  }

  /** Keys that came before the page stood are typed now; none of them ends a line from before a reload, which nobody had seen then. */
  takeFirst() {
    const keys = globalThis.firstKeys ?? [];
    let unseen = this.input.value !== '';
    for (const event of keys) {
      unseen &&= !writes(event);
      if (unseen && ['Enter', 'Tab'].includes(event.key)) continue;
      this.#key(event);
      if (writes(event)) {
        this.input.setRangeText(event.key, this.input.selectionStart, this.input.selectionEnd, 'end');
        this.#typed();
      } else if (event.key === 'Enter' && !event.repeat) this.#enter(event);
    }
    if (keys.length) this.focus();
  }

  /** A line that came into another field as fast as a scanner types: the field is as it was, and the line comes here. */
  #watchOthers(event) {
    const field = event.target.closest?.(OTHERS);
    const gap = event.timeStamp - (this.scan?.last ?? -Infinity);
    if (!field || field === this.input) {
      this.scan = null;
    } else if (event.key.length === 1 && !event.ctrlKey && !event.metaKey) {
      if (gap > PAUSE_MS || this.scan?.field !== field) this.scan = { field, before: field.named ?? field.value, text: '', isFast: true };
      else if (gap > BURST_GAP_MS) this.scan.isFast = false;
      Object.assign(this.scan, { text: this.scan.text + event.key, last: event.timeStamp });
    } else if (['Enter', 'Tab'].includes(event.key) && this.scan?.isFast && this.scan.text.length >= FEWEST_KEYS) {
      const { before, text } = this.scan;
      const read = readLine(text, { burst: true, prefixes: this.prefixes(), pattern: this.pattern() });
      this.scan = null;
      if (this.isSize(field) && ['job', 'nothing'].includes(read.kind)) return;
      event.preventDefault();
      event.stopPropagation();
      field.value = before;
      // The second Enter of its pair comes here.
      this.lastEnter = event.timeStamp;
      this.unchanged = true;
      this.focus();
      this.#scanned(field.name, text.trim(), read, event.getModifierState('CapsLock'));
    }
  }

  /** A scan into the field of a name names it, unless it says what else it is. */
  #scanned(name, text, read, caps) {
    const isElse = !this.isName(name) || isBadge(text) || this.isKnown(text) || caps || ['error', 'inches', 'test'].includes(read.kind) || (read.kind === 'field' && read.name !== name);
    if (isElse) return this.take(text, true);
    if (this.named(text, true) === null) return undefined;
    const named = ['doubt', 'field'].includes(read.kind) ? read.text : text;
    if (read.kind === 'doubt' || (name === 'part_id' && !isOfPattern(named, this.pattern()))) return this.#doubt(text, named, name);
    return this.onField(name, named);
  }

  /**
   * The name that a text is in the place of one; null where it is a value, which is judged, or held until Enter where its
   * line was not ended. @param isWords whether no number is such a name
   */
  named(text, ended, isWords = false) {
    if (!isReading(text, this.gauged()) && !(isWords && gaugeValue(text) !== null)) return text;
    if (ended) this.take(text);
    else this.hold(text);
    return null;
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
    this.#keep();
    this.onCorrecting(record, what);
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
    const second = now - this.lastEnter < PAIR_MS;
    this.lastEnter = now;
    if (this.unchanged) {
      if (second) return undefined;
      if (this.asked) return this.asked.safe();
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
    if (this.correcting?.what === 'part_id') return this.#correctPart(typed, burst);
    if (!this.correcting && parseMeasured(typed) === null && this.isKnown(typed)) return this.#finish(() => this.onField('part_id', typed));
    const read = readLine(typed, { burst, prefixes: this.prefixes(), pattern: this.pattern() });
    if (read.kind === 'value') return this.#judge(read.text);
    if (['error', 'inches'].includes(read.kind)) return this.#refuse(t(`entry.${read.kind}`, { typed }));
    if (read.kind === 'test') return this.#finish(() => this.onTest(scannerTest(typed)));
    if (this.correcting) return this.#refuse(t('entry.malformed', { typed }));
    if (read.kind === 'job') return this.#adopt(read, burst);
    if (read.kind === 'doubt') return this.#doubt(typed, read.text, read.name);
    if (read.kind === 'field') return this.#finish(() => this.onField(read.name, read.text));
    return this.#refuse(t('entry.malformed', { typed }));
  }

  /** `25.013in` is written like a size and a class, the number of a part like a thread: the service knows whether there is one. */
  async #adopt({ text, name }, scanned) {
    // What is typed until it is known is another line.
    this.#finish(() => {});
    this.adopting = true;
    this.element.setAttribute('aria-busy', true);
    const known = await this.onJob(text, scanned);
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

  #correctPart(typed, burst) {
    const { record } = this.correcting;
    if (isReading(typed, { limits: record })) return this.#refuse(t('entry.reading', { typed }));
    const read = readLine(typed, { burst, prefixes: this.prefixes(), pattern: this.pattern() });
    if (read.kind === 'test' || (read.kind === 'field' && read.name !== 'part_id')) return this.#refuse(t('entry.malformed', { typed }));
    const part = ['doubt', 'field'].includes(read.kind) ? read.text : typed;
    if (part === record.part_id) return this.#refuse(t('correct.nothing'));
    if (read.kind === 'doubt') return this.#doubt(typed, part, 'part_id', record);
    return this.#finish(() => this.onField('part_id', part, record));
  }

  #job() {
    return this.correcting ? { limits: this.correcting.record } : this.job();
  }

  #judge(text) {
    const job = this.#job();
    if (job.reason) return this.#refuse(job.reason);
    const nm = nmFromMm(text);
    const typed = this.input.value.trim();
    const least = leastOf(job.limits);
    if (nm < 0 && least > 0) return this.#refuse(t('entry.malformed', { typed }));
    if (nm < least || nm > LARGEST_NM) return this.#refuse(t('entry.out_of_range', { typed }));
    if (this.correcting && nm === nmFromMm(this.correcting.record.measured_mm)) return this.#refuse(t('correct.nothing'));
    if (isFar(nm, job)) return this.#ask(text, job);
    return this.#accept(text);
  }

  #accept(text, confirmed = false) {
    const { correcting } = this;
    const { reason } = this.#job(); // it may have come while a question stood there
    if (reason) return this.#refuse(reason);
    return this.#finish(() => this.onValue({ text, correcting: correcting?.record, confirmed }));
  }

  #finish(act) {
    act();
    this.#reset();
    this.unchanged = true;
  }

  /** Far outside lie a wrong class, a lost point, a gauge in inches, and the number of a part. */
  #ask(text, job) {
    const { limits, nominal_nm: nominal } = job;
    const typed = this.input.value.trim();
    const mm = mmOfInches(text);
    const size = limits?.designation ? designationText(limits.designation) : number(mmText(nominal, 0));
    this.#question(t('entry.ask', { mm: number(text), size }), text, [
      { label: t('entry.ask_drop'), act: () => this.#drop() },
      !isFar(nmFromMm(mm), job) && { label: t('entry.ask_inches', { mm: number(mm) }), act: () => this.#answer(text, () => this.#accept(mm)) },
      !this.correcting && { label: `${t('field.part_id')} ${typed}`, act: () => this.#answer(text, () => this.#finish(() => this.onField('part_id', typed))) },
      { label: t('entry.ask_keep', { mm: number(text) }), act: () => this.#answer(null, () => this.#accept(text, true)) },
    ]);
  }

  /**
   * A scan that may have come through another layout of keys, is an address, or no number of the plan's parts.
   * @param record whose part it is to be; without one it goes into the field of the station, and what was corrected goes on
   */
  #doubt(typed, text, name, record) {
    const { correcting } = this;
    const goOn = () => correcting && this.correct(correcting.record, correcting.what);
    this.input.value = typed;
    const pattern = name === 'part_id' ? this.pattern() : '';
    const field = t(`field.${name}`);
    this.#question(t(isOfPattern(text, pattern) ? 'entry.doubt' : 'entry.doubt_pattern', { field, text, pattern }), null, [
      { label: t('entry.doubt_no'), act: () => { this.#drop(); goOn(); } },
      { label: `${field} ${text}`, act: () => this.#answer(null, () => {
        this.#finish(() => this.onField(name, text, record));
        if (!record) goOn();
      }) },
    ]);
  }

  /** The first choice is the safe one: Enter takes it. @param dropped the value that is not kept then */
  #question(question, dropped, choices) {
    const given = choices.filter(Boolean);
    this.asked = { dropped, safe: given[0].act, subject: this.subject() };
    this.unchanged = true;
    this.element.classList.add('asking');
    this.onAsk({ text: this.input.value.trim(), question, choices: given });
    this.#say(t('entry.ask_how'));
    this.input.select();
    this.focus();
  }

  #answer(dropped, act) {
    this.asked = null;
    this.onAsk(null);
    if (dropped) this.onDropped(dropped);
    act();
    this.focus();
  }

  #drop() {
    this.#withdraw();
    this.#reset();
    this.focus();
  }

  /** A question about what was gauged before ends. Its line stays, and Enter reads it anew. */
  jobChanged() {
    if (!this.asked || this.correcting || this.asked.subject === this.subject()) return;
    this.asked = null;
    this.onAsk(null);
    this.element.classList.remove('asking');
    this.#say(t('entry.resumed', { typed: this.input.value.trim() }));
  }

  /** A question that nobody answers keeps nothing. */
  #withdraw() {
    if (!this.asked) return;
    const { dropped } = this.asked;
    this.asked = null;
    this.onAsk(null);
    if (dropped) this.onDropped(dropped);
  }

  #refuse(reason) {
    this.element.classList.add('refusing');
    if (this.input.value.trim()) this.onOpen(this.input.value.trim(), reason);
    this.#say(reason);
    this.input.select();
    this.#forgetKeys();
  }

  #typed() {
    this.unchanged = false;
    if (this.input.value) this.onTyped();
    this.#keep();
    if (this.input.value === '') this.#forgetKeys();
    this.#withdraw();
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
    this.#withdraw();
    if (this.correcting) this.onCorrecting(null);
    this.correcting = null;
    this.unchanged = false;
    this.input.value = '';
    forget(KEPT, 'session');
    this.#forgetKeys();
    this.label.textContent = t('entry.label');
    this.element.classList.remove('asking', 'refusing', 'correcting');
    this.#say('');
  }

  #say(text) {
    if (this.note.textContent !== text) this.note.textContent = text;
  }
}
