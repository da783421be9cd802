/** A plan as a form: part number, name, and its characteristics in their order. */

import { freshId, h, refill } from '../dom.js';
import { gaugeNames } from '../gauge/in_use.js';
import { explain, t } from '../i18n.js';
import { getJson, url } from '../api.js';
import { Characteristic } from './characteristic.js';
import { sortable } from './sorting.js';

const HEAD = ['name', 'size', 'kind', 'limits', 'gauge'];
const NO_PLAN = { characteristics: [{ name: '' }] };

/** The names that fields offer; none where the service has none. */
const OFFERED = {
  gauge: gaugeNames,
  catalogue: async (signal) => (await getJson(url(['catalogues']), { signal, asks: false })).catalogues.map(({ name }) => name),
  picture: async (signal) => (await getJson(url(['files']), { signal, asks: false })).files.map(({ path }) => path.replace(/^TNC:\\/, '').replaceAll('\\', '/')).filter((path) => /\.(png|jpe?g|gif|svg|webp)$/i.test(path)),
};

export class PlanForm {
  /** @param onChange is told that something was typed; @param leaving ends the view */
  constructor({ onChange, leaving }) {
    this.onChange = onChange;
    this.lists = Object.fromEntries(Object.keys(OFFERED).map((name) => [name, freshId(`plan-${name}`)]));
    const offers = Object.values(this.lists).map((id) => h('datalist', { id }));
    this.offer = (name) => OFFERED[name](leaving).then((names) => refill(offers[Object.keys(OFFERED).indexOf(name)], names.map((value) => h('option', { value }))), () => {});
    for (const name of Object.keys(OFFERED)) this.offer(name);
    const text = (attributes) => h('input', { type: 'text', autocomplete: 'off', spellcheck: 'false', maxlength: 200, oninput: () => this.#changed(), ...attributes });
    this.part = text({ name: 'part', required: true });
    this.name = text({ name: 'name' });
    this.part_pattern = text({ name: 'part_pattern', placeholder: 'SN-####', title: t('plans.hint.part_pattern') });
    this.notes = { part: h('span.note'), name: h('span.note'), part_pattern: h('span.note') };
    this.list = h('ol.characteristics');
    this.said = h('p.said-of-order', { role: 'status' });
    this.drawing = h('p.aside');
    this.rows = new Map();
    sortable(this.list, (row) => this.#moved(row));
    const head = (name) => h('label.field', h('span.label', t(`plans.${name}`)), this[name], this.notes[name]);
    this.element = h('div.plan-form', h('div.pair', head('part'), head('name'), head('part_pattern')), this.drawing,
      h('div.head-of-rows', { 'aria-hidden': 'true' }, HEAD.map((each) => h('span.label', t(`plans.member.${each}`)))),
      this.list, this.said, h('p.actions', h('button', { type: 'button', onclick: () => this.add({ name: '' }).focus() }, t('plans.add')), h('span.hint', t('plans.hint.size'))), offers);
  }

  /** Shows a plan; what the form has no field for stays as it is. */
  fill(plan = NO_PLAN) {
    const { part = '', name = '', part_pattern: pattern = '', characteristics, ...rest } = plan;
    this.rest = rest;
    this.part.value = part;
    this.name.value = name;
    this.part_pattern.value = pattern;
    this.rows.clear();
    this.list.replaceChildren();
    for (const one of characteristics) this.#put(one);
    this.#number();
    this.clear();
    this.said.textContent = '';
    const { drawing } = rest;
    this.drawing.textContent = drawing ? t('plans.drawing', { part: drawing.part ?? '–', digest: drawing.digest.slice(0, 8) }) : '';
    return this;
  }

  get inOrder() {
    return [...this.list.children].map((element) => this.rows.get(element));
  }

  /** The plan as it is sent, without its part number: that is in the path. */
  get value() {
    const [name, pattern] = [this.name, this.part_pattern].map(({ value }) => value.trim());
    return { ...(name && { name }), ...(pattern && { part_pattern: pattern }), ...this.rest, characteristics: this.inOrder.map((row) => row.value) };
  }

  /** What it would store, as one text: to see whether something was changed. */
  get text() {
    return JSON.stringify({ part: this.part.value.trim(), ...this.value });
  }

  /** The field of the first size that somebody has to type; undefined if there is none. */
  firstEmpty() {
    return this.inOrder.map((row) => row.fields.size).find(({ value }) => !value);
  }

  /** Puts characteristics behind the others; an empty row gives way. @returns the first */
  addAll(list) {
    const empty = this.inOrder.filter((row) => !row.fields.name.value && !row.fields.size.value);
    const added = list.map((one) => this.#put(one));
    for (const row of empty) this.#take(row);
    this.#changed();
    return added[0];
  }

  add(one, after = this.list.lastElementChild) {
    const row = this.#put(one, after);
    this.#changed();
    return row;
  }

  #put(one, after = this.list.lastElementChild) {
    const row = new Characteristic(one, this.lists, {
      change: () => this.onChange(), copy: (which) => this.#copy(which), remove: (which) => this.#remove(which),
    });
    this.rows.set(row.element, row);
    if (after) after.after(row.element);
    else this.list.append(row.element);
    return row;
  }

  #take(row) {
    this.rows.delete(row.element);
    row.element.remove();
  }

  #changed() {
    this.#number();
    this.onChange();
  }

  #number() {
    this.inOrder.forEach((row, i) => row.show(i + 1));
  }

  /** Of a drawing only the row itself is; its copy is typed. */
  #copy(row) {
    const { entity, ...one } = JSON.parse(JSON.stringify(row.value));
    const names = new Set(this.inOrder.map(({ name }) => name));
    const stem = one.name.replace(/ \(\d+\)$/, '');
    let number = 2;
    while (names.has(`${stem} (${number})`)) ++number;
    this.add({ ...one, name: `${stem} (${number})` }, row.element).focus();
  }

  #remove(row) {
    const before = row.element.previousElementSibling;
    const one = JSON.parse(JSON.stringify(row.value));
    this.#take(row);
    this.#changed();
    const back = () => {
      const again = this.#put(one, before);
      if (!before) this.list.prepend(again.element);
      this.#changed();
      this.said.textContent = '';
      again.focus();
    };
    const undo = h('button', { type: 'button', onclick: back }, t('plans.undo'));
    refill(this.said, t('plans.removed', { name: row.name }), ' ', undo);
    undo.focus();
  }

  #moved(element) {
    this.#changed();
    const row = this.rows.get(element);
    this.said.textContent = t('plans.moved', { name: row.name, number: row.number, count: this.rows.size });
  }

  clear() {
    for (const row of this.rows.values()) row.clear();
    for (const note of Object.values(this.notes)) note.textContent = '';
  }

  /** Says what is wrong at each field. @param problem of the service. @returns what has no field, as texts */
  mark(problem) {
    this.clear();
    const rows = this.inOrder;
    const left = problem.errors.filter((error) => {
      const [, member, at, own] = (error.pointer ?? '').split('/');
      const known = explain({ status: problem.status, code: error.code, errors: [{ ...error, pointer: '' }], reason: error.detail });
      const text = error.detail && error.detail !== known ? `${known} (${error.detail})` : known;
      if (member === 'characteristics') return !rows[at]?.mark(own ?? 'name', text);
      if (!this.notes[member]) return true;
      this.notes[member].textContent = text;
      return false;
    });
    this.element.querySelector('[aria-invalid]')?.focus();
    return left.map(({ detail }) => detail);
  }
}
