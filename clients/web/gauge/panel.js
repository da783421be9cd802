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
  /** The key of the value that is shown; undefined where what is gauged now has none yet. */
  of;

  constructor() {
    this.element = h('section.verdict', { role: 'status', 'aria-live': 'polite', 'aria-atomic': 'true', 'aria-label': t('panel.label') });
  }

  /** Nothing was judged yet of what is gauged now: {limits, part}, of a plan what is next, or that it is finished. */
  next({ limits, part, step, finished }) {
    this.of = undefined;
    const what = [part, step].filter(Boolean).join(' · ');
    const text = !limits ? t('panel.no_job') : finished ? t('panel.next_part') : what ? t('panel.measure_part', { part: what }) : t('panel.measure');
    this.#show('idle', [word(text), limits && limitStrip(limits)]);
  }

  /** A value was taken: what becomes of it is shown from now on. @param key of its entry in the queue */
  begin(key) {
    this.of = key;
  }

  /**
   * A value is kept but has no answer yet. Where the page holds its limits it is judged by them at once, on a hatched
   * ground: what is stored has a plain one.
   * @param shown its `verdict` is by the limits held, or null
   * @param late whether it has waited so long that somebody wonders
   */
  waiting(shown, away, late) {
    if (shown.verdict) return this.#provisional(shown, away, late);
    return this.#show('waiting', [
      verdictShape('waiting'),
      h('div.said', word(t(away ? 'panel.kept' : 'panel.waiting')), about(shown),
        h('p.measured', `${number(shown.measured)} mm`),
        h('p.distance', t(away ? 'panel.kept_how' : 'panel.waiting_how'))),
    ]);
  }

  /** While the service is away this is all there is to hear; else the sound waits for the record. */
  #provisional(shown, away, late) {
    if (away && this.sounded !== shown) sound(shown.verdict);
    if (away) this.sounded = shown;
    const judged = { ...shown.limits, measured_mm: shown.measured };
    const how = away ? t('panel.provisional') : late ? t('panel.waiting_how') : distanceText(judged);
    this.#show(shown.verdict, [
      verdictShape(shown.verdict),
      h('div.said', word(t(`verdict.${shown.verdict}`)), about(shown), h('p.measured', `${measuredText(judged)} mm`), h('p.distance', how)),
      limitStrip(judged),
    ], away ? 'away' : 'storing');
  }

  /** A value is stored. @param overtaken whether something newer stands here already: then it is only heard */
  judged(record, overtaken = false) {
    sound(record.verdict);
    if (overtaken) return;
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
    this.of = undefined;
    this.#show('open', [
      verdictShape('open'),
      h('div.said', word(t('panel.open')), h('p.measured', typed), h('p.distance', t('panel.open_how'))),
    ]);
  }

  /** @param provisional why it is not stored: `away`, or `storing`, which passes before it can be read out */
  #show(state, children, provisional) {
    this.state = state;
    this.element.dataset.verdict = state;
    if (provisional) this.element.dataset.provisional = provisional;
    else delete this.element.dataset.provisional;
    this.element.ariaBusy = provisional === 'storing' ? 'true' : null;
    this.element.replaceChildren(...children.filter(Boolean));
  }
}
