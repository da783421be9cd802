/** The text of a program that the open one calls, at the line of the move that is shown. It is only read here. */

import { h } from '../dom.js';
import { explain, t } from '../i18n.js';
import { brokenBlocks, toggleBreak } from './breaks.js';
import { fileName, readFile, relative } from './disk.js';
import { Editor } from './editor.js';

export class CalledProgram {
  #editor = null;
  #wanted = null;

  /** @param onLine takes the number of a line that was touched, and the program it is of */
  constructor(onLine) {
    this.onLine = onLine;
    this.name = h('h3.aside');
    this.note = h('p.note', { hidden: true });
    this.element = h('section.called', { hidden: true }, this.name, this.note);
  }

  /** Shows a line; the text is asked for once. @param by the path of the program that is open */
  async show(program, line, by) {
    const isThere = this.#wanted?.program === program;
    this.#wanted = { program, line, by };
    this.element.hidden = false;
    if (isThere) return this.#reveal();
    this.name.textContent = t('programs.called', { name: fileName(program), by: fileName(by) });
    this.text = null;
    this.note.hidden = true;
    try {
      const { text, reason, size } = await readFile(relative(program));
      if (this.#wanted?.program !== program) return null;
      this.text = text;
      this.note.hidden = text !== null;
      if (text === null) this.note.textContent = t(`programs.${reason}`, { name: fileName(program), size });
    } catch (problem) {
      if (this.#wanted?.program !== program) return null;
      Object.assign(this.note, { hidden: false, textContent: explain(problem) });
    }
    if (!this.#editor) {
      this.#editor = new Editor({ onChange() {}, onStore() {}, onLine: (at) => this.onLine(at, this.#wanted.program), onBreak: (block) => toggleBreak(this.#wanted.by, this.#wanted.program, block) });
      this.element.append(h('div.listing', this.#editor.element));
    }
    this.#editor.element.hidden = this.text === null;
    this.#editor.show(this.text ?? '', { label: t('editor.text', { name: fileName(program) }), isProgram: true, readOnly: true });
    this.showBreaks();
    return this.#reveal();
  }

  showBreaks() {
    if (this.#wanted) this.#editor?.showBreaks(brokenBlocks(this.#wanted.by, this.#wanted.program));
  }

  #reveal() {
    this.#editor?.showLine(this.#wanted.line);
  }

  close() {
    this.#wanted = null;
    this.element.hidden = true;
  }

  destroy() {
    this.#editor?.destroy();
  }
}
