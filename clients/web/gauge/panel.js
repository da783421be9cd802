/** The verdict across the shop: shape, word, value, of which part it is, and where it lies between the limits. */

import { designationText } from '../designation.js';
import { h } from '../dom.js';
import { number, t } from '../i18n.js';
import { limitStrip } from '../figures/limit_strip.js';
import { distanceText, measuredText, verdictShape } from '../verdict.js';
import { sound } from './sound.js';

/** Long words get a smaller size, so that none is broken. */
const word = (text) => h(`p.word${text.length > 11 ? '.longer' : text.length > 7 ? '.long' : ''}`, text);

/** "SN-1 · bore-A · Ø 25 H7": what a verdict is about. */
const about = ({ part_id: part, characteristic, designation }) =>
  h('p.about', [part, characteristic, designation && designationText(designation)].filter(Boolean).join(' · '));

export class Panel {
  constructor() {
    this.element = h('section.verdict', { role: 'status', 'aria-live': 'polite', 'aria-atomic': 'true', 'aria-label': t('panel.label') });
  }

  /** Nothing was judged yet of what is gauged now: {limits, part}, of a plan its characteristic, or that it is finished. */
  next({ limits, part, characteristic, finished }) {
    const what = [part, characteristic].filter(Boolean).join(' · ');
    const text = !limits ? t('panel.no_job') : finished ? t('panel.next_part') : what ? t('panel.measure_part', { part: what }) : t('panel.measure');
    this.#show('idle', [word(text), limits && limitStrip(limits)]);
  }

  /** A value is kept but has no answer yet. @param verdict by the limits this page holds, or null */
  waiting(shown, away) {
    if (away && shown.verdict) return this.#provisional(shown);
    return this.#show('waiting', [
      verdictShape('waiting'),
      h('div.said', word(t(away ? 'panel.kept' : 'panel.waiting')), about(shown),
        h('p.measured', `${number(shown.measured)} mm`),
        h('p.distance', t(away ? 'panel.kept_how' : 'panel.waiting_how'))),
    ]);
  }

  #provisional(shown) {
    if (this.sounded !== shown) sound(shown.verdict);
    this.sounded = shown;
    this.#show(shown.verdict, [
      verdictShape(shown.verdict),
      h('div.said', word(t(`verdict.${shown.verdict}`)), about(shown),
        h('p.measured', `${number(shown.measured)} mm`), h('p.distance', t('panel.provisional'))),
      limitStrip({ ...shown.limits, measured_mm: shown.measured }),
    ], true);
  }

  judged(record) {
    sound(record.verdict);
    this.#show(record.verdict, [
      verdictShape(record.verdict),
      h('div.said', word(t(`verdict.${record.verdict}`)), about(record),
        h('p.measured', `${measuredText(record)} mm`),
        h('p.distance', distanceText(record))),
      limitStrip(record),
    ]);
  }

  refused(shown, reason) {
    this.#show('refused', [
      verdictShape('open'),
      h('div.said', word(t('panel.refused')), about(shown),
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

  #show(state, children, provisional = false) {
    this.state = state;
    this.element.dataset.verdict = state;
    this.element.toggleAttribute('data-provisional', provisional);
    this.element.replaceChildren(...children.filter(Boolean));
  }
}
