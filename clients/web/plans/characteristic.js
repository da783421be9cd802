/** A characteristic of a plan as a row of a form: name, size, what is measured, gauge; the rest when it is opened. */

import { getJson, keyInUse, url } from '../api.js';
import { writeOrAsk } from '../documents.js';
import { freshId, h, refill } from '../dom.js';
import { Decimal, parseMeasured } from '../exact.js';
import { ownLimits } from '../gauge/plan.js';
import { explain, has, t } from '../i18n.js';
import { writeFile } from '../programs/disk.js';
import { limitsText } from '../verdict.js';
import { KINDS, kindOf, LIMITS, sizeMembers, sizeTyped } from './sizes.js';
import { iconButton } from './sorting.js';

const RULES = ['simple', 'guard_band', 'conformance'];
const ASK_MS = 250;
/** What is typed for numbers; other text is sent as it is, so that the service says what is wrong with it. */
const numberOf = (text) => {
  const decimal = parseMeasured(text);
  return decimal === null ? text : new Decimal(decimal);
};
const textOf = (value) => value;
/** The members below the row: how each is read; `area` takes lines, `list` offers names. */
const MORE = {
  frequency: { read: textOf, hint: true }, subgroup_size: { read: numberOf }, count: { read: numberOf },
  size_operator: { read: textOf }, rule: { read: textOf, choices: RULES }, uncertainty_um: { read: numberOf }, coverage_factor: { read: numberOf },
  inside_corner: { read: (text) => ({ true: true, false: false })[text] ?? text, choices: ['true'], said: (word) => ({ true: t('schema.yes'), false: t('schema.no') })[word] ?? word },
  reaction: { read: textOf, area: true }, catalogue: { read: textOf, list: true }, picture: { read: textOf, list: true },
};
const OWN = ['name', 'gauge', ...Object.keys(MORE), ...LIMITS, 'feature', 'quantity'];
/** At which field the service's word about a member stands. */
const fieldOf = (member) => (LIMITS.includes(member) ? 'size' : ['feature', 'quantity'].includes(member) ? 'kind' : member);

const asked = new Map();
/** The limits of a designation, asked for once; '' if there are none. */
function limitsOf(designation) {
  if (!asked.has(designation)) {
    asked.set(designation, getJson(url(['limits', designation]), { asks: false }).then(limitsText, (problem) => {
      if (!problem.status) asked.delete(designation);
      return '';
    }));
  }
  return asked.get(designation);
}

/** The limits of a characteristic in mm, for people. */
export const limitsSaid = async (one) => {
  const designation = one.designation ?? (one.tolerance_class && `${one.nominal_mm} ${one.tolerance_class}`);
  if (designation) return limitsOf(designation);
  const own = one.nominal_mm === undefined ? null : ownLimits(JSON.parse(JSON.stringify(one)));
  return own ? limitsText(own) : '';
};

export class Characteristic {
  /** @param one as the plan has it; @param lists ids of the names on offer; @param on {change, copy, remove} */
  constructor(one, lists, on) {
    this.one = one;
    this.notes = {};
    this.fields = {};
    const put = (name, control, value) => {
      this.fields[name] = control;
      control.value = value ?? '';
      control.addEventListener('input', () => this.#changed(name, on));
      const note = h('span.note', { id: freshId('note') });
      this.notes[name] = note;
      control.setAttribute('aria-describedby', note.id);
      return h('label.field', { class: `field of-${name}` }, h('span.label', t(`plans.member.${name}`)), control, MORE[name]?.hint && h('span.hint', t(`plans.hint.${name}`)), note);
    };
    const input = (attributes = {}) => h('input', { type: 'text', autocomplete: 'off', spellcheck: 'false', ...attributes });
    const choice = (words, text) => h('select', words.map((value) => h('option', { value }, text(value))));
    const control = (name) => {
      const { area, choices, list, said = (word) => (has(`rule.${word}`) ? t(`rule.${word}`) : word) } = MORE[name];
      if (area) return h('textarea', { rows: 2 });
      return choices ? choice([...new Set(['', ...choices, this.#typed(name)])], (word) => (word ? said(word) : '–')) : input(list && { list: lists[name] });
    };
    this.limits = h('output.limits-said');
    this.aside = h('p.aside.said');
    this.more = h('div.more-of', { id: freshId('more'), hidden: true }, Object.keys(MORE).map((name) => put(name, control(name), this.#typed(name))), this.#picture(),
      one.entity && h('p.aside', t('plans.entity', { entity: one.entity })));
    this.opener = iconButton('more', '', { 'aria-expanded': 'false', 'aria-controls': this.more.id, onclick: () => this.open(this.more.hidden) });
    this.buttons = {
      move_this: iconButton('grip', ''), more_this: this.opener,
      copy_one: iconButton('copy', '', { onclick: () => on.copy(this) }), remove_one: iconButton('remove', '', { onclick: () => on.remove(this) }),
    };
    const { move_this: grip, ...others } = this.buttons;
    this.group = h('div.characteristic', { role: 'group' }, grip,
      put('name', input({ maxlength: 200, required: true }), one.name), put('size', input({ placeholder: '25 H7' }), sizeTyped(one)),
      put('kind', choice(Object.keys(KINDS), (kind) => t(`plans.kind.${kind}`)), kindOf(one)), this.limits,
      put('gauge', input({ list: lists.gauge }), one.gauge), h('span.tools', Object.values(others)), this.aside, this.more);
    this.element = h('li', this.group);
    this.typedFirst = this.#sizeNow();
    this.#say();
    this.#showLimits();
  }

  #typed(name) {
    return this.one[name] === undefined ? '' : String(this.one[name]);
  }

  #picture() {
    const file = h('input.unseen', { type: 'file', accept: 'image/*', onchange: () => this.#upload(file) });
    this.image = h('img', { alt: '', hidden: true, onerror: () => { this.image.hidden = true; } });
    return h('div.picture', h('label.chooser', file, h('span.choose', t('plans.picture_choose'))), this.image);
  }

  async #upload(input) {
    const [file] = input.files;
    const path = `pictures/${file.name}`;
    try {
      const bytes = await file.arrayBuffer();
      if (!await writeOrAsk(file.name, (conditions) => writeFile(path, bytes, conditions))) return;
      this.fields.picture.value = path;
      this.fields.picture.dispatchEvent(new Event('input'));
    } catch (problem) {
      this.notes.picture.textContent = explain(problem);
    } finally {
      input.value = '';
    }
  }

  #sizeNow() {
    return `${this.fields.size.value} ${this.fields.kind.value}`;
  }

  /** As the plan has it; limits that were not touched stay as they were written. */
  get value() {
    const text = (name) => this.fields[name].value.trim();
    const rest = Object.fromEntries(Object.entries(this.one).filter(([member]) => !OWN.includes(member)));
    const { one } = this;
    const size = this.#sizeNow() === this.typedFirst
      ? Object.fromEntries([...LIMITS, 'feature', 'quantity'].filter((member) => one[member] !== undefined).map((member) => [member, one[member]]))
      : sizeMembers(text('size'), text('kind'));
    const more = Object.entries(MORE).filter(([name]) => text(name)).map(([name, { read }]) => [name, read(text(name))]);
    return { name: text('name'), ...size, ...(text('gauge') && { gauge: text('gauge') }), ...Object.fromEntries(more), ...rest };
  }

  get name() {
    return this.fields.name.value.trim() || t('plans.one', { number: this.number });
  }

  #changed(name, on) {
    this.notes[name].textContent = '';
    this.#say();
    if (name === 'size' || name === 'kind') {
      clearTimeout(this.timer);
      this.timer = setTimeout(() => this.#showLimits(), ASK_MS);
    }
    on.change();
  }

  async #showLimits() {
    const size = this.#sizeNow();
    const text = await limitsSaid(this.value);
    if (this.#sizeNow() === size) this.limits.textContent = text;
  }

  /** What the row says of what is below it. */
  #say() {
    const { name } = this;
    this.group.setAttribute('aria-label', name);
    for (const [text, button] of Object.entries(this.buttons)) {
      button.setAttribute('aria-label', t(`plans.${text}`, { name }));
      button.title = button.getAttribute('aria-label');
    }
    const value = (member) => this.fields[member].value.trim();
    this.aside.textContent = [
      value('count') > 1 && t('plans.times', { count: value('count') }), value('frequency'), value('subgroup_size') > 1 && t('plans.sample_of', { size: value('subgroup_size') }),
      value('rule') && t(`rule.${value('rule')}`), value('reaction'), value('catalogue'),
    ].filter(Boolean).join(' · ');
    this.image.alt = t('plans.picture_of', { name });
    const path = value('picture');
    this.image.hidden = !path || Boolean(keyInUse());
    if (!this.image.hidden) this.image.src = url(['files', ...path.split('/')]);
  }

  /** Its number in the plan. */
  show(number) {
    this.number = number;
    this.#say();
  }

  open(isOpen = true) {
    this.more.hidden = !isOpen;
    this.opener.setAttribute('aria-expanded', String(isOpen));
  }

  focus() {
    this.fields.name.focus();
  }

  clear() {
    for (const [name, note] of Object.entries(this.notes)) {
      refill(note);
      this.fields[name].removeAttribute('aria-invalid');
    }
  }

  /** Says what is wrong with a member, at its field. @returns whether it has one */
  mark(member, text) {
    const name = fieldOf(member);
    if (!this.notes[name]) return false;
    this.notes[name].textContent = text;
    this.fields[name].setAttribute('aria-invalid', 'true');
    if (name in MORE) this.open();
    return true;
  }

  /** The first field that is wrong; null if none is. */
  get wrong() {
    return this.element.querySelector('[aria-invalid]');
  }
}
