/** A table of the control with a field for each cell; Enter and the arrows go up and down. */

import { h, refill } from '../dom.js';
import { t } from '../i18n.js';
import { readTable, withCell, withoutRow, withRow } from './table_text.js';

export class TableEditor {
  /** @param editor whose text it is */
  constructor(editor) {
    this.editor = editor;
    this.note = h('p.note', { role: 'alert' });
    this.place = h('div.scroll', { tabindex: 0, role: 'region', 'aria-label': t('table.title') });
    this.element = h('div.table-editor', this.note, this.place, h('p.actions', h('button', { type: 'button', onclick: () => this.#put(withRow(this.editor.text, this.table)) }, t('table.add'))));
  }

  /** Shows the text as it is now. @returns whether it is a table */
  show() {
    this.table = readTable(this.editor.text);
    this.note.textContent = '';
    if (this.table) this.#draw();
    return this.table !== null;
  }

  #draw() {
    const { columns, rows } = this.table;
    refill(this.place, h('table', h('thead', h('tr', columns.map(({ name }) => h('th', { scope: 'col' }, name)), h('td'))),
      h('tbody', rows.map(({ cells }, row) => h('tr', cells.map((value, column) => h(column ? 'td' : 'th', column ? {} : { scope: 'row' }, this.#cell(value, row, column))),
        h('td', h('button.quiet', { type: 'button', 'aria-label': t('table.remove_this', { row: cells[0] }), onclick: () => this.#put(withoutRow(this.editor.text, this.table, row)) }, t('table.remove'))))))));
  }

  #cell(value, row, column) {
    const { name, width } = this.table.columns[column];
    const input = h('input', {
      type: 'text', autocomplete: 'off', spellcheck: 'false', 'aria-label': t('table.cell', { name, row: this.table.rows[row].cells[0] }), size: Math.min(Math.max(Number.isFinite(width) ? width : value.length, 4), 24),
      onchange: () => this.#change(input, row, column), onkeydown: (event) => this.#browse(event, row, column),
    });
    input.value = value;
    return input;
  }

  #change(input, row, column) {
    const value = input.value.trim();
    const { name } = this.table.columns[column];
    if (!column && !value) return this.#refuse(input, t('table.number'));
    try {
      this.#put(withCell(this.editor.text, this.table, row, column, value));
      return undefined;
    } catch (problem) {
      if (!(problem instanceof RangeError)) throw problem;
      return this.#refuse(input, t('table.wide', { name, count: problem.message }));
    }
  }

  #refuse(input, text) {
    this.note.textContent = text;
    input.setAttribute('aria-invalid', 'true');
  }

  #put(text) {
    this.editor.replace(text);
    this.show();
  }

  #browse(event, row, column) {
    const way = { ArrowUp: -1, ArrowDown: 1, Enter: 1 }[event.key];
    if (!way) return;
    event.preventDefault();
    event.target.dispatchEvent(new Event('change'));
    this.place.querySelectorAll('tbody tr')[row + way]?.querySelectorAll('input')[column]?.focus();
  }
}
