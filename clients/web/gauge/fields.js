/** The fields that go into every record, with pick lists of what was recorded before. */

import { getJson, url } from '../api.js';
import { field, h, refill } from '../dom.js';
import { t } from '../i18n.js';
import { gaugeNames } from './in_use.js';

const MOST_OFFERED = 200;
const SIDE_FIELDS = ['characteristic', 'order', 'operation', 'machine', 'tool', 'operator', 'gauge'];
export const FIELDS = ['part_id', ...SIDE_FIELDS];

/** The values a field had in records. */
const recordedNames = async (name) => {
  const { groups } = await getJson(url(['measurements', 'summary'], { group_by: name }), { asks: false });
  return groups.map((group) => group[name]).filter(Boolean).slice(0, MOST_OFFERED);
};
const namesOf = (name) => (name === 'gauge' ? gaugeNames() : recordedNames(name));

/** A field that a scan replaces instead of lengthening it. */
export function textField(name, onchange, attributes = {}) {
  const input = h('input', {
    type: 'text', name, autocomplete: 'off', autocapitalize: 'off', spellcheck: 'false', maxlength: 200, onchange, ...attributes,
    onfocus: () => input.select(),
  });
  return input;
}

export class Fields {
  /**
   * @param given {field: text}
   * @param named the door for keys: takes a text and whether its line was ended by a key; gives the name that it is, or null for none
   */
  constructor(given, { onChange, named }) {
    Object.assign(this, { onChange, named });
    this.inputs = Object.fromEntries(FIELDS.map((name) => [name, textField(name, () => this.#changed(name), {
      onkeydown: ({ key }) => { this.ended = ['Enter', 'Tab'].includes(key); },
    })]));
    for (const name of FIELDS) this.set(name, given[name] ?? '');
    this.inputs.part_id.classList.add('part');
    this.lists = Object.fromEntries(SIDE_FIELDS.map((name) => [name, h('datalist', { id: `offered-${name}` })]));
    for (const name of SIDE_FIELDS) this.inputs[name].setAttribute('list', this.lists[name].id);
    this.part = field(t('field.part_id'), this.inputs.part_id);
    this.side = SIDE_FIELDS.map((name) => field(t(`field.${name}`), this.inputs[name]));
  }

  /** Asks for what can be chosen. */
  offer() {
    for (const name of SIDE_FIELDS) {
      namesOf(name).then((values) => refill(this.lists[name], values.map((value) => h('option', { value }))), () => {});
    }
  }

  /** The text of a field. */
  of(name) {
    return this.inputs[name].value.trim();
  }

  set(name, text) {
    this.inputs[name].value = text;
    this.inputs[name].named = text;
  }

  /** A gauge that typed into the field of a name has named nothing. */
  #changed(name) {
    const input = this.inputs[name];
    const typed = this.of(name);
    // A value that is judged here belongs to the name that was there.
    input.value = input.named;
    const text = this.named(typed, this.ended);
    if (text === null) return;
    this.set(name, text);
    this.onChange();
  }

  /** {field: text} of them all. */
  get texts() {
    return Object.fromEntries(FIELDS.map((name) => [name, this.of(name)]));
  }
}
