/** A table of the control with a field for each cell; Enter and the arrows go up and down. */

import { h, refill } from '../dom.js';
import { t } from '../i18n.js';
import { readTable, withCell, withoutRow, withRow } from './table_text.js';

/** Row and column of a field or button. */
const placeOf = (element) => ({ row: element.closest('tr').sectionRowIndex, column: element.closest('td, th').cellIndex });

export class TableEditor {
  /** @param editor whose text it is */
  constructor(editor) {
    this.editor = editor;
    this.note = h('p.note', { role: 'alert' });
    this.place = h('div.scroll', { tabindex: 0, role: 'region', 'aria-label': t('table.title') });
    this.element = h('div.table-editor', this.note, this.place, h('p.actions', h('button', { type: 'button', onclick: () => this.#add() }, t('table.add'))));
  }

  /** Shows the text as it is now. @returns whether it is a table */
  show() {
    const { text } = this.editor;
    this.note.textContent = '';
    if (text === this.text && !this.place.querySelector('[aria-invalid]')) return this.table !== null;
    this.text = text;
    this.table = readTable(text);
    if (this.table) this.#draw();
    return this.table !== null;
  }

  #draw() {
    const { columns, rows } = this.table;
    this.body = h('tbody', {
      onchange: ({ target }) => this.#change(target), onkeydown: (event) => this.#browse(event), onclick: ({ target }) => target.closest('button') && this.#remove(target),
    }, rows.map((row) => this.#row(row)));
    refill(this.place, h('table', h('thead', h('tr', columns.map(({ name }) => h('th', { scope: 'col' }, name)), h('td'))), this.body));
  }

  #row({ cells }) {
    const row = h('tr', cells.map((value, column) => h(column ? 'td' : 'th', column ? {} : { scope: 'row' }, this.#cell(value, column))),
      h('td', h('button.quiet', { type: 'button' }, t('table.remove'))));
    this.#label(row, cells[0]);
    return row;
  }

  #cell(value, column) {
    const input = h('input', { type: 'text', autocomplete: 'off', spellcheck: 'false', size: this.#size(column, value) });
    input.value = value;
    return input;
  }

  #size(column, value) {
    const { width } = this.table.columns[column];
    return Math.min(Math.max(Number.isFinite(width) ? width : value.length, 4), 24);
  }

  /** Names the fields of a row by its number. */
  #label(row, number) {
    row.querySelectorAll('input').forEach((input, column) => input.setAttribute('aria-label', t('table.cell', { name: this.table.columns[column].name, row: number })));
    row.querySelector('button').setAttribute('aria-label', t('table.remove_this', { row: number }));
  }

  #change(input) {
    const { row, column } = placeOf(input);
    const { name } = this.table.columns[column];
    const size = this.#size(column, '');
    const value = input.value.trim().replaceAll(/\s/g, ' ');
    if (!column && !/^[^;[]/.test(value)) return this.#refuse(input, t('table.number'));
    try {
      if (value !== this.table.rows[row].cells[column]) this.#put(withCell(this.text, this.table, row, column, value));
    } catch (problem) {
      if (!(problem instanceof RangeError)) throw problem;
      return this.#refuse(input, t('table.wide', { name, count: problem.message }));
    }
    this.note.textContent = '';
    input.removeAttribute('aria-invalid');
    input.value = value;
    const now = this.#size(column, '');
    if (now !== size) for (const { cells } of this.body.rows) cells[column].firstChild.size = now;
    if (!column) this.#label(input.closest('tr'), value);
    return undefined;
  }

  #refuse(input, text) {
    this.note.textContent = text;
    input.setAttribute('aria-invalid', 'true');
  }

  #add() {
    this.#put(withRow(this.text, this.table));
    this.body.append(this.#row(this.table.rows.at(-1)));
  }

  #remove(button) {
    const { row } = placeOf(button);
    this.#put(withoutRow(this.text, this.table, row));
    this.body.rows[row].remove();
    (this.body.rows[row] ?? this.body.rows[row - 1])?.querySelector('button').focus();
  }

  /** Stores an edit of this table, which may grow beyond the size that opens as one. */
  #put(text) {
    this.editor.replace(text);
    this.text = text;
    this.table = readTable(text, Infinity);
  }

  #browse(event) {
    const way = { ArrowUp: -1, ArrowDown: 1, Enter: 1 }[event.key];
    if (!way || event.target.tagName !== 'INPUT') return;
    event.preventDefault();
    const { row, column } = placeOf(event.target);
    this.#change(event.target);
    this.body.rows[row + way]?.querySelectorAll('input')[column]?.focus();
  }
}
