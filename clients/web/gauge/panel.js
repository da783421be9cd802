/** The verdict across the shop: shape, word, value, and where it lies between the limits. */

import { h } from '../dom.js';
import { number, t } from '../i18n.js';
import { limitStrip } from '../figures/limit_strip.js';
import { distanceText, measuredText, verdictShape } from '../verdict.js';

/** Long words get a smaller size, so that none is broken. */
const word = (text) => h(`p.word${text.length > 11 ? '.longer' : text.length > 7 ? '.long' : ''}`, text);

export class Panel {
  constructor() {
    this.element = h('section.verdict', { role: 'status', 'aria-live': 'polite', 'aria-atomic': 'true', 'aria-label': t('panel.label') });
    this.idle(null);
  }

  /** Nothing was judged yet. */
  idle(limits) {
    if (this.state && this.state !== 'idle') return;
    this.#show('idle', [
      word(t('panel.idle')),
      limits && limitStrip(limits),
    ]);
  }

  /** A value is kept but has no answer yet. */
  waiting(shown, away) {
    this.#show('waiting', [
      verdictShape('waiting'),
      h('div.said', word(t(away ? 'panel.kept' : 'panel.waiting')),
        h('p.measured', `${number(shown.measured)} mm`),
        h('p.distance', t(away ? 'panel.kept_how' : 'panel.waiting_how'))),
    ]);
  }

  judged(record) {
    this.#show(record.verdict, [
      verdictShape(record.verdict),
      h('div.said', word(t(`verdict.${record.verdict}`)),
        h('p.measured', `${measuredText(record)} mm`),
        h('p.distance', distanceText(record))),
      limitStrip(record),
    ]);
  }

  refused(shown, reason) {
    this.#show('refused', [
      verdictShape('open'),
      h('div.said', word(t('panel.refused')),
        h('p.measured', `${number(shown.measured)} mm`), h('p.distance', reason)),
    ]);
  }

  /** A value was typed that is asked about or not taken: no verdict may stand for it. */
  open(typed) {
    this.#show('open', [
      verdictShape('open'),
      h('div.said', word(t('panel.open')), h('p.measured', typed), h('p.distance', t('panel.open_how'))),
    ]);
  }

  #show(state, children) {
    this.state = state;
    this.element.dataset.verdict = state;
    this.element.replaceChildren(...children.filter(Boolean));
  }
}
