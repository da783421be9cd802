/** What stands before a scan of each field in this shop: kept by the browser. */

import { field, h } from '../dom.js';
import { t } from '../i18n.js';
import { readJson, store } from '../stored.js';
import { textField } from './fields.js';
import { PREFIXES } from './reading.js';

const KEPT = 'prefixes';

export class Prefixes {
  constructor() {
    this.inputs = Object.fromEntries(Object.keys(PREFIXES).map((name) => [name, textField(`prefix_${name}`, () => this.#keep(), { maxlength: 10 })]));
    for (const [name, prefix] of Object.entries({ ...PREFIXES, ...readJson(KEPT, {}) })) {
      if (this.inputs[name]) this.inputs[name].value = prefix;
    }
    this.element = h('fieldset.fields', h('legend.label', t('job.prefixes')),
      Object.entries(this.inputs).map(([name, input]) => field(t(`field.${name}`), input)));
  }

  /** {field: prefix} */
  get texts() {
    return Object.fromEntries(Object.entries(this.inputs).map(([name, input]) => [name, input.value.trim()]));
  }

  #keep() {
    store(KEPT, JSON.stringify(this.texts));
  }
}
