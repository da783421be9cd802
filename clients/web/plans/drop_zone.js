/** The place for drawings and tables: a file is dropped anywhere on the view, or chosen. */

import { h } from '../dom.js';
import { explain, t } from '../i18n.js';
import { DrawingReview } from './drawing_review.js';
import { readDrawing } from './plan_store.js';
import { planOfRows, rowsOfText } from './plan_table.js';
import { rowsOfWorkbook } from './workbook.js';

const LARGEST_BYTES = 64 << 20;
const STEP = /^\s*ISO-10303-21/;
const ZIP = /^PK\x03\x04/;

export class DropZone {
  /** @param on {onDrawing, onStored, onRows, onShow}: a draft to go on with, a stored plan, rows of a table, whether a drawing is shown */
  constructor(on) {
    this.on = on;
    this.chooser = h('input.unseen', { type: 'file', id: 'plan-file', accept: '.stp,.step,.p21,.csv,.txt,.tsv,.xlsx,model/step,text/csv', onchange: () => this.#chosen() });
    this.said = h('p.note', { role: 'status' });
    this.words = h('span');
    this.zone = h('label.drop', { for: 'plan-file' }, this.chooser, this.words, h('span.choose', { 'aria-hidden': 'true' }, t('file.choose')));
    this.place = h('div');
    this.element = h('section.drop-zone', this.zone, this.said, this.place);
    this.small = false;
  }

  /** Beside a form it is one line. */
  set small(isSmall) {
    this.zone.classList.toggle('small', isSmall);
    this.words.textContent = t(isSmall ? 'plans.import' : 'file.drop');
    this.chooser.setAttribute('aria-label', this.words.textContent);
  }

  listen(element, signal) {
    const over = (isOver) => (event) => {
      if (![...event.dataTransfer.types].includes('Files')) return;
      event.preventDefault();
      this.zone.classList.toggle('over', isOver);
    };
    element.addEventListener('dragover', over(true), { signal });
    element.addEventListener('dragleave', over(false), { signal });
    element.addEventListener('drop', (event) => {
      over(false)(event);
      const [file] = event.dataTransfer.files;
      if (file) this.read(file);
    }, { signal });
  }

  #chosen() {
    const [file] = this.chooser.files;
    if (file) this.read(file);
    this.chooser.value = '';
  }

  /** Reads a file by what it begins with. */
  async read(file) {
    const { name } = file;
    this.said.textContent = t('file.reading', { name });
    this.zone.setAttribute('aria-busy', 'true');
    try {
      this.said.textContent = await this.#taken(file) ?? '';
    } catch (problem) {
      const reason = problem.code?.startsWith('drawing.') ? `${explain(problem)} ${problem.reason}` : explain(problem);
      this.said.textContent = t('file.broken', { name, reason });
    } finally {
      this.zone.removeAttribute('aria-busy');
    }
  }

  /** @returns why it was not, if so */
  async #taken(file) {
    const { name } = file;
    if (file.size > LARGEST_BYTES) return t('file.too_large', { name });
    const head = new TextDecoder('latin1').decode(await file.slice(0, 256).arrayBuffer());
    if (STEP.test(head) || /\.(stp|step|p21)$/i.test(name)) return this.#drawing(file);
    const rows = ZIP.test(head) ? await rowsOfWorkbook(await file.arrayBuffer()) : rowsOfText(textOf(await file.arrayBuffer()));
    const found = planOfRows(rows);
    if (found.problem) return t(found.problem, { name, ...found.values });
    this.on.onRows({ file: name, ...found });
    return undefined;
  }

  async #drawing(file) {
    const review = new DrawingReview(await readDrawing(file), file, {
      onStored: (part, count) => { this.#close(); this.on.onStored(part, count); }, onCancel: () => this.#close(),
      onDraft: (plan, tag) => { this.#close(); this.on.onDrawing(plan, tag); },
    });
    await review.ready;
    this.place.replaceChildren(review.element);
    this.zone.hidden = true;
    this.on.onShow(true);
    review.focus();
  }

  #close() {
    this.place.replaceChildren();
    this.zone.hidden = false;
    this.on.onShow(false);
  }
}

/** Spreadsheets write UTF-8, or the code page of Windows. */
function textOf(bytes) {
  try {
    return new TextDecoder('utf-8', { fatal: true }).decode(bytes);
  } catch {
    return new TextDecoder('windows-1252').decode(bytes);
  }
}
