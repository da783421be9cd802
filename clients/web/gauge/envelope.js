/** What the GO gauge said of a size with the envelope requirement Ⓔ, and by which operator of ISO 14405-1 a size is measured. */

import { field, h, refill } from '../dom.js';
import { t } from '../i18n.js';

const SAID = ['passes', 'fails'];
const OPERATORS = ['LP', 'GG', 'GX', 'GN', 'GC', 'LS', 'SX', 'SN', 'SA', 'SM', 'SD', 'SR'];

export class Envelope {
  /** @param onSaid is told that something was chosen: the next keys are of a value */
  constructor(onSaid) {
    this.buttons = SAID.map((said) => h('button', { type: 'button', onclick: () => { this.say(this.said === said ? undefined : said); onSaid(); } }, t(`envelope.${said}`)));
    this.operator = h('select', { name: 'size_operator', onchange: onSaid });
    this.go = h('div.field', h('span.label', { id: 'go-gauge' }, t('envelope.go')), h('span.chips', { role: 'group', 'aria-labelledby': 'go-gauge' }, this.buttons));
    this.element = h('div.envelope', { hidden: true }, this.go, field(t('envelope.operator'), this.operator));
    this.say(undefined);
  }

  /** @param said `passes`, `fails`, or undefined: it was not used */
  say(said) {
    this.said = said;
    this.buttons.forEach((button, i) => button.setAttribute('aria-pressed', SAID[i] === said));
  }

  /** @param required whether the size has Ⓔ; @param operator that the plan asks for */
  show(required, operator) {
    if (this.required === required && this.asked === operator) return;
    Object.assign(this, { required, asked: operator });
    refill(this.operator, [...new Set([operator ?? OPERATORS[0], ...OPERATORS])].map((value) => h('option', { value }, value)));
    this.go.hidden = !required;
    this.element.hidden = !required && !operator;
    this.say(undefined);
  }

  /** What goes into a record. A GO gauge says it of one part: the next begins without. @param unsigned whether no designation has Ⓔ */
  take(unsigned) {
    const { required, said } = this;
    this.say(undefined);
    return this.element.hidden ? {} : { ...(required && unsigned && { envelope: 'required' }), ...(required && said && { go_gauge: said }), size_operator: this.operator.value };
  }
}
