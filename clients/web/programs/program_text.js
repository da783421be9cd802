/** The text of a file of the control: edited, checked as one types, stored when it is wanted. */

import { Asked } from '../asked.js';
import { h, refill } from '../dom.js';
import { t } from '../i18n.js';
import { inTurn, Latest } from '../latest.js';
import { brokenBlocks, toggleBreak } from './breaks.js';
import { CalledProgram } from './called_program.js';
import { check, fileName, isProgram, readFile, relative, writeFile } from './disk.js';
import { Editor } from './editor.js';
import { findingList } from './findings.js';
import { TableEditor } from './table_editor.js';
import { isTable } from './table_text.js';

/** A pause in typing after which the text is checked; longer texts only by the button. */
const PAUSE_MS = 400;
const LONGEST_CHECKED = 1_000_000;

/** Texts that are not stored yet, {text, tag} by path: they outlive the view, not the window. */
const drafts = new Map();
/** The views that are not left: a file that one stores may be open in the next. */
const views = new Set();
addEventListener('beforeunload', (event) => { if (drafts.size) event.preventDefault(); });

/** A file as it is on the disk; where it is not there, or not any more, what is not stored of it. */
async function fileOf(path) {
  const draft = drafts.get(path);
  if (draft?.tag !== null) {
    try {
      return await readFile(path);
    } catch (problem) {
      if (!draft || problem.status !== 404) throw problem;
      draft.tag = null;
    }
  }
  return draft;
}

export class ProgramText {
  #timer = 0;
  #opening;

  /**
   * @param leaving the signal of the view that is left
   * @param onLine takes the number of a line that was touched, and its program if that is a called one; @param onState is called when the text is stored or changed
   * @param onStore called on Ctrl+S
   */
  constructor({ leaving, onLine, onState, onStore }) {
    this.onState = onState;
    this.checking = new Latest(leaving);
    this.checked = new Asked(() => this.#checkAlone(), { say: (reason) => reason && refill(this.list, h('li', h('p.aside', t('programs.not_checked', { reason })))), leaving });
    this.editor = new Editor({ onLine, onStore, onChange: () => this.#edited(), onBreak: (block) => toggleBreak(this.path, this.path, block) });
    this.list = h('ol.findings');
    this.note = h('p.aside', { hidden: true });
    this.called = new CalledProgram(onLine);
    this.table = new TableEditor(this.editor);
    this.looks = ['table', 'text'].map((look) => h('button', { type: 'button', 'aria-pressed': 'false', onclick: () => this.#look(look === 'table' && this.table.show()) }, t(`table.as_${look}`)));
    this.switch = h('div.switch', { role: 'group', 'aria-label': t('table.title'), hidden: true }, this.looks);
    this.element = h('div.texts', this.switch, h('div.listing', this.table.element, this.editor.element, this.note, this.list), this.called.element);
    views.add(this);
    leaving.addEventListener('abort', () => {
      views.delete(this);
      clearTimeout(this.#timer);
      this.editor.destroy();
      this.called.destroy();
    });
  }

  /** Whether there is something to store. */
  get dirty() {
    return drafts.has(this.path);
  }

  /** The paths of what is not stored. */
  static get unstored() {
    return [...drafts.keys()];
  }

  /** Begins a file that is not on the disk. */
  static begin(path, text) {
    if (!drafts.has(path)) drafts.set(path, { text, tag: null });
  }

  /** Until the file is there, what is shown, edited and stored is the one before. @returns whether it is there: another may be asked for meanwhile */
  async open(path) {
    clearTimeout(this.#timer);
    this.#opening = path;
    const file = await fileOf(path);
    if (this.#opening !== path) return false;
    const draft = drafts.get(path);
    this.path = path;
    this.called.close();
    this.tag = draft ? draft.tag : file.tag;
    this.stored = this.tag === null ? null : file.text;
    this.lineBreak = file.text?.includes('\r\n') ? '\r\n' : '\n';
    const reason = file.reason ?? '';
    this.note.hidden = !reason;
    this.note.textContent = reason && t(`programs.${reason}`, { name: fileName(path), size: file.size });
    this.editor.element.hidden = file.text === null;
    this.editor.show(draft?.text ?? file.text ?? '', { label: t('editor.text', { name: fileName(path) }), isProgram: isProgram(path), readOnly: Boolean(reason) });
    this.showBreaks();
    this.switch.hidden = this.table.element.hidden = true;
    if (!reason && isTable(path) && this.table.show()) this.#look(true);
    this.show([]);
    this.onState();
    if (!reason) this.#checkSoon(0);
    return true;
  }

  /** A table as cells, or as its text. */
  #look(isCells) {
    this.switch.hidden = false;
    this.table.element.hidden = !isCells;
    this.editor.element.hidden = isCells;
    this.looks.forEach((button, i) => button.setAttribute('aria-pressed', String((i === 0) === isCells)));
  }

  /** Checks the text as it stands. @returns the findings */
  async check() {
    const { path } = this;
    if (!path) return undefined;
    try {
      const found = await this.checking.run((signal) => check(path, this.editor.text || '\n', signal));
      if (found && this.path === path) this.show(found);
      return found;
    } catch (problem) {
      if (this.path === path) this.show([]); // what was found is of another text
      throw problem;
    }
  }

  show(diagnostics) {
    const isOwn = (each) => relative(each.program).toLowerCase() === this.path.toLowerCase();
    const own = diagnostics.filter(isOwn);
    this.editor.mark(own);
    refill(this.list, findingList(own, diagnostics.filter((each) => !isOwn(each)), (each) => this.editor.goTo(each)));
  }

  /** The breakpoints of the program, here and in the text of one that it calls. */
  showBreaks() {
    if (this.path) this.editor.showBreaks(brokenBlocks(this.path, this.path));
    this.called.showBreaks();
  }

  /** Shows the line of a move; the text of a called program stands below that of the one that is open. */
  showLine(program, line) {
    const isOwn = fileName(program).toLowerCase() === fileName(this.path).toLowerCase();
    this.editor.showLine(isOwn ? line : 0);
    if (isOwn) this.called.close();
    else this.called.show(program, line, this.path);
  }

  /** One after the other. @errors precondition.failed where somebody else stored the file meanwhile */
  store = inTurn(async () => {
    if (!this.dirty) return;
    const { path } = this;
    const text = this.editor.text.replaceAll('\n', this.lineBreak);
    const tag = await writeFile(path, text, this.tag === null ? { 'If-None-Match': '*' } : { 'If-Match': this.tag });
    const draft = drafts.get(path);
    if (draft?.text === text) drafts.delete(path);
    else if (draft) draft.tag = tag;
    for (const view of views) if (view.path === path) view.#took(tag, text);
  }, () => `${this.path}\n${this.editor.text}`);

  /** Forgets what is not stored of a file. */
  static forget(path) {
    drafts.delete(path);
  }

  #edited() {
    this.#remember();
    this.#checkSoon(PAUSE_MS);
  }

  #took(tag, stored) {
    Object.assign(this, { tag, stored });
    this.#remember();
  }

  #remember() {
    const text = this.editor.text.replaceAll('\n', this.lineBreak);
    if (text === this.stored) drafts.delete(this.path);
    else drafts.set(this.path, { text, tag: this.tag });
    this.onState();
  }

  #checkSoon(pause) {
    clearTimeout(this.#timer);
    this.#timer = setTimeout(() => this.checked.run(), pause);
  }

  #checkAlone() {
    return this.editor.text.length > LONGEST_CHECKED ? undefined : this.check();
  }
}
