/**
 * A form made of a schema of /openapi.json: a field for each member, and what is wrong with one at its field. Names and
 * explanations that no table of texts has are the schema's own, in English.
 */

import { getJson } from './api.js';
import { h } from './dom.js';
import { has, t } from './i18n.js';

let asked;
/** The schemas of the service by name; asked for once. */
export function schemas() {
  asked ??= getJson('/openapi.json').then((document) => document.components.schemas, (problem) => {
    asked = undefined;
    throw problem;
  });
  return asked;
}

/** A schema with what it refers to. */
export const resolved = (schema, all) => (schema.$ref ? { ...all[schema.$ref.split('/').at(-1)], description: schema.description } : schema);

const isNumber = ({ type }) => [type].flat().some((name) => name === 'number' || name === 'integer');
/** What is no number is sent as it was typed: the service says what is wrong with it. */
const numberOf = (text) => (/^[+-]?\d+([.,]\d+)?$/.test(text) ? Number(text.replace(',', '.')) : text);
const wordsOf = (text) => text.split(/[\s;]+/).filter(Boolean);
const linesOf = (text) => text.split('\n').map((line) => line.trim()).filter(Boolean);
const given = (list) => (list.length ? list : undefined);

const input = (attributes) => h('input', { type: 'text', autocomplete: 'off', spellcheck: 'false', ...attributes });
const area = (rows) => h('textarea', { rows, spellcheck: 'false' });

/** A control of one text: {element, read, fill}. */
function texts(element, read, fill = String) {
  return {
    element,
    read: () => (element.value.trim() ? read(element.value.trim()) : undefined),
    fill: (value) => { element.value = value === undefined ? '' : fill(value); },
  };
}

function choice(words, texted) {
  const element = h('select', h('option', { value: '' }, '–'), words.map((word) => h('option', { value: String(word), lang: !texted && 'en' }, texted?.(word) ?? word)));
  return texts(element, (text) => words.find((word) => String(word) === text));
}

function choices(words) {
  const boxes = words.map((word) => h('input', { type: 'checkbox', value: word }));
  const text = (word) => (has(`verdict.${word}`) ? t(`verdict.${word}`) : h('span', { lang: 'en' }, word));
  return {
    element: h('span.line', boxes.map((box, i) => h('label.choice', box, text(words[i])))),
    read: () => given(boxes.filter(({ checked }) => checked).map(({ value }) => value)),
    fill: (value = []) => boxes.forEach((box) => { box.checked = value.includes(box.value); }),
  };
}

/** A few numbers, such as X, Y and Z. */
function tuple({ maxItems }, label) {
  const inputs = Array.from({ length: maxItems }, (_, i) => input({ inputmode: 'decimal', 'aria-label': `${label} ${'XYZ'[i]}` }));
  return {
    element: h('span.tuple', inputs),
    read: () => (inputs.some(({ value }) => value.trim()) ? inputs.map(({ value }) => numberOf(value.trim())) : undefined),
    fill: (value = []) => inputs.forEach((one, i) => { one.value = value[i] ?? ''; }),
  };
}

const json = () => texts(area(3), (text) => {
  try {
    return JSON.parse(text);
  } catch {
    return text;
  }
}, (value) => JSON.stringify(value));

function listOf(schema, items, label) {
  if (items.enum) return choices(items.enum);
  if (isNumber(items) && schema.maxItems <= 3) return tuple(schema, label);
  if (items.type === 'array') {
    return texts(area(5), (text) => linesOf(text).map((line) => wordsOf(line).map(numberOf)), (rows) => rows.map((row) => row.join(' ')).join('\n'));
  }
  if (items.type === 'string') return texts(area(2), linesOf, (value) => value.join('\n'));
  return json();
}

const map = () => texts(area(3), (text) => Object.fromEntries(linesOf(text).map((line) => {
  const [name, ...rest] = line.split('=');
  return [name.trim(), rest.join('=').trim()];
})), (value) => Object.entries(value).map(([name, text]) => `${name} = ${text}`).join('\n'));

function nested(schema, all) {
  const form = new SchemaForm(schema, all);
  return {
    element: h('details', h('summary', t('schema.more')), form.element), form,
    read: () => (Object.keys(form.value).length ? form.value : undefined), fill: (value) => form.fill(value),
  };
}

function controlOf(schema, { name, label, all }) {
  if (schema.enum) return choice(schema.enum);
  if (schema.type === 'boolean') return choice([true, false], (value) => t(value ? 'schema.yes' : 'schema.no'));
  if (schema.type === 'array') return listOf(schema, resolved(schema.items, all), label);
  if (schema.properties) return nested(schema, all);
  if (schema.type === 'object') return map();
  const placeholder = schema.default ?? '';
  if (isNumber(schema)) return texts(input({ inputmode: 'decimal', placeholder }), numberOf);
  return texts(input({ type: name === 'password' ? 'password' : 'text', maxlength: schema.maxLength, placeholder }), (text) => text);
}

export class SchemaForm {
  /**
   * @param schema of an object, resolved; members that allow one value have no field
   * @param texts what the texts of its members are called, `schema`; without one the schema's own stand there
   */
  constructor(schema, all, texts = '') {
    this.texts = texts;
    this.fixed = {};
    this.rest = {};
    this.fields = new Map();
    for (const [name, member] of Object.entries(schema.properties)) {
      const own = resolved(member, all);
      const only = own.const ?? (own.enum?.length === 1 ? own.enum[0] : undefined);
      if (only === undefined) this.fields.set(name, this.#field(name, own, schema.required?.includes(name), all));
      else this.fixed[name] = only;
    }
    this.element = h('div.schema-fields', [...this.fields.values()].map(({ place }) => place));
  }

  #field(name, schema, required, all) {
    const text = `${this.texts}.${name}`;
    const known = has(text);
    const named = known ? t(text) : name;
    const control = controlOf(schema, { name, label: named, all });
    const note = h('span.note', { role: 'alert' });
    const label = h('span.label', known ? named : h('code', { lang: 'en' }, name), required && ' *');
    const hint = !known && schema.description && h('span.hint', { lang: 'en' }, schema.description);
    // A group of controls is no label's: each has a name of its own.
    const single = ['INPUT', 'SELECT', 'TEXTAREA'].includes(control.element.tagName);
    const place = single ? h('label.field', label, control.element, hint, note) : h('div.field', { role: 'group', 'aria-label': named }, label, control.element, hint, note);
    return { ...control, place, note };
  }

  /** What was filled in; members that the form has no field for stay as they were. */
  get value() {
    const filled = [...this.fields].map(([name, { read }]) => [name, read()]).filter(([, value]) => value !== undefined);
    return { ...this.fixed, ...this.rest, ...Object.fromEntries(filled) };
  }

  fill(value = {}) {
    this.rest = Object.fromEntries(Object.entries(value).filter(([name]) => !this.fields.has(name) && !(name in this.fixed)));
    for (const [name, { fill }] of this.fields) fill(value[name]);
    return this;
  }

  /** Says what is wrong at each field. @param errors {pointer, text}, from this object on. @returns those of no field */
  mark(errors) {
    for (const { note } of this.fields.values()) note.textContent = '';
    return errors.filter(({ pointer, text }) => {
      const [, name, ...deeper] = pointer.split('/');
      const own = this.fields.get(name);
      if (!own) return true;
      const inner = own.form?.mark([{ pointer: `/${deeper.join('/')}`, text }]) ?? [{ text }];
      if (inner.length) own.note.textContent = text;
      return false;
    });
  }
}
