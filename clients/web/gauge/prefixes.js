/** What stands before a scan of each field in this shop: kept by the browser. */

import { field, h } from '../dom.js';
import { t } from '../i18n.js';
import { readJson, store } from '../stored.js';
import { textField } from './fields.js';
import { PREFIXES, TEST_CODE } from './reading.js';

const KEPT = 'prefixes';
/** {field: prefix} as this shop has them. */
export const keptPrefixes = () => ({ ...PREFIXES, ...readJson(KEPT, {}) });

export class Prefixes {
  constructor() {
    this.inputs = Object.fromEntries(Object.keys(PREFIXES).map((name) => [name, textField(`prefix_${name}`, () => this.#keep(), { maxlength: 10 })]));
    for (const [name, prefix] of Object.entries(keptPrefixes())) {
      if (this.inputs[name]) this.inputs[name].value = prefix;
    }
    this.element = h('fieldset.fields', h('legend.label', t('job.prefixes')),
      h('p.hint', t('scanner.test'), ' ', h('code', TEST_CODE)), Object.entries(this.inputs).map(([name, input]) => field(t(`field.${name}`), input)));
  }

  /** {field: prefix} */
  get texts() {
    return Object.fromEntries(Object.entries(this.inputs).map(([name, input]) => [name, input.value.trim()]));
  }

  /** The field that a text before a scan names, for people. */
  fieldOf(before) {
    const [name] = Object.entries(this.texts).find(([, prefix]) => prefix && prefix.toLowerCase() === before.trim().toLowerCase()) ?? [];
    return name && t(`field.${name}`);
  }

  #keep() {
    store(KEPT, JSON.stringify(this.texts));
  }
}
