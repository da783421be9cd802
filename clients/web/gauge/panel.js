/** The verdict across the shop: shape, word, value, of which part it is, and where it lies between the limits. */

import { isFolded } from '../api.js';
import { designationText } from '../designation.js';
import { h } from '../dom.js';
import { number, t } from '../i18n.js';
import { limitStrip, runStrip } from '../figures/limit_strip.js';
import { distanceText, isUnverified, limitsText, measuredText, verdictShape } from '../verdict.js';
import { sound } from './sound.js';

/** Long words get a smaller size, so that none is broken. */
const word = (text) => h(`p.word${text.length > 11 ? '.longer' : text.length > 7 ? '.long' : ''}`, text);

/** "SN-1 · bore-A · Ø 25 H7": what a verdict is about. */
const about = ({ part_id: part, characteristic, designation }) =>
  h('p.about', [part, characteristic, designation && designationText(designation)].filter(Boolean).join(' · '));

export class Panel {
  /** The key of the value that is shown; undefined where what is gauged now has none yet. */
  of;

  /** @param lastOf gives the values that were measured last of what a record is of, the newest last, without it */
  constructor(lastOf = () => []) {
    this.lastOf = lastOf;
    this.element = h('section.verdict', { role: 'status', 'aria-live': 'polite', 'aria-atomic': 'true', 'aria-label': t('panel.label') });
  }

  /** Nothing was judged yet of what is gauged now: {limits, part}, of a plan what is next with its picture, or that it is finished. */
  next({ limits, part, step, finished, picture }) {
    this.of = undefined;
    const what = [part, step].filter(Boolean).join(' · ');
    const text = !limits ? t('panel.no_job') : finished ? t('panel.next_part') : what ? t('panel.measure_part', { part: what }) : t('panel.measure');
    this.#show('idle', [word(text), limits && limitStrip(limits), picture]);
  }

  /** A value was taken: what becomes of it is shown from now on. @param key of its entry in the queue */
  begin(key) {
    this.of = key;
  }

  /**
   * A value is kept but has no answer yet. Where the page holds its limits it is judged by them at once, on a hatched
   * ground: what is stored has a plain one.
   * @param shown its `verdict` is by the limits held, or null
   * @param how it waits, once it has waited so long that somebody wonders
   */
  waiting(shown, away, how) {
    if (shown.verdict) return this.#provisional(shown, away, how);
    return this.#show('waiting', [
      verdictShape('waiting'),
      h('div.said', word(t(away ? 'panel.kept' : 'panel.waiting')), about(shown),
        h('p.measured', `${number(shown.measured)} mm`),
        h('p.distance', away ? t('panel.kept_how') : how)),
    ]);
  }

  #run(record) {
    return runStrip([...this.lastOf(record), record].map(({ measured_mm: mm }) => String(mm)), record);
  }

  /** While the service is away this is all there is to hear; else the sound waits for the record. */
  #provisional(shown, away, waits) {
    if (away && this.sounded !== shown) sound(shown.verdict);
    if (away) this.sounded = shown;
    const judged = { ...shown.limits, measured_mm: shown.measured };
    const how = away ? t('panel.provisional') : waits ?? distanceText(judged);
    this.#show(shown.verdict, [
      verdictShape(shown.verdict),
      h('div.said', word(t(`verdict.${shown.verdict}`)), about(shown), h('p.measured.figure', `${measuredText(judged)} mm`), h('p.distance', how)),
      limitStrip(judged), this.#run({ ...shown, ...judged }),
    ], away ? 'away' : 'storing');
  }

  /** A value is stored. @param overtaken whether something newer stands here already: then it is only heard */
  judged(record, overtaken = false) {
    sound(record.verdict);
    if (overtaken) return;
    this.#show(record.verdict, [
      verdictShape(record.verdict),
      h('div.said', word(t(`verdict.${record.verdict}`)), about(record),
        h('p.measured.figure', `${measuredText(record)} mm`),
        h('p.distance', [distanceText(record), isUnverified(record) && t('envelope.not_verified')].filter(Boolean).join(' · '))),
      limitStrip(record), this.#run(record),
    ]);
  }

  /** All of a part is measured: the worst of it, with what is not good by its name, as large as the verdict of a value. */
  part({ part, verdict, bad, count, newest, unverified, provisional }) {
    const { record, shown } = newest.value;
    const measured = measuredText(record ?? { measured_mm: shown.measured });
    const names = bad.map(({ name, verdict: of, value }) => [name || `${measuredText({ measured_mm: value.shown.measured })} mm`, t(`verdict.${of}`)].join(' '));
    this.#show(verdict, [
      verdictShape(verdict),
      h('div.said', word(t(`verdict.${verdict}`)), h('p.measured', [part && t('panel.part', { part }), ...names].filter(Boolean).join(' · ')),
        !names.length && h('p.distance', [t('plan.finished', { count }), unverified && t('envelope.not_verified')].filter(Boolean).join(' · ')),
        isFolded(part) && h('p.distance', t('part.folded', { part })),
        h('p.distance', [`${newest.name} ${measured} mm`.trim(), names.length && t(`verdict.${newest.verdict}`), record && distanceText(record)].filter(Boolean).join(' · '))),
    ].filter(Boolean), provisional);
    this.isOfPart = true;
  }

  /** The next line corrects a record: the verdict on it gives way, until it is corrected or left. @param what `measured_mm` or `part_id` */
  correcting(record, what) {
    const { last } = this;
    this.#show('correcting', [
      verdictShape('open'),
      h('div.said', word(what === 'measured_mm' ? t('panel.correcting', { mm: measuredText(record) }) : t('panel.correcting_part', { part: record.part_id ?? t('part.none') })),
        about(record), h('p.measured', what === 'measured_mm' ? limitsText(record) : `${measuredText(record)} mm`), h('p.distance', t(`entry.correct_how.${what}`))),
    ]);
    this.asking = true;
    this.missed = last && (() => this.#show(...last));
  }

  refused(shown, reason) {
    this.#show('refused', [
      verdictShape('open'),
      h('div.said', word(t('panel.refused')), about(shown),
        h('p.measured', `${number(shown.measured)} mm`), h('p.distance', reason)),
    ]);
  }

  /** A line was typed that is not taken: no verdict may stand for it. @param why */
  open(typed, why) {
    this.of = undefined;
    this.#show('open', [
      verdictShape('open'),
      h('div.said', word(t('panel.open')), h('p.measured', typed), h('p.distance', why)),
    ]);
  }

  /** A question about a line: it stays until it is answered, and what became of other values meanwhile is shown then. */
  ask({ text, question, choices }) {
    this.of = undefined;
    this.missed = undefined;
    this.asking = false;
    this.#show('open', [
      h('div.said', h('p.question', question), !question.includes(text) && h('p.measured', text)),
      h('p.answers', choices.map(({ label, act }, i) => h(i ? 'button' : 'button.primary', { type: 'button', onclick: act }, label))),
    ]);
    this.asking = true;
  }

  /** @returns whether something was missed that is shown now */
  answered() {
    const { missed } = this;
    this.asking = false;
    this.missed = undefined;
    missed?.();
    return missed !== undefined;
  }

  /** Another size is gauged by a scan, which nobody may have meant. */
  size(limits) {
    this.#show('idle', [word(t('panel.size', { size: designationText(limits.designation) })), limitStrip(limits)]);
  }

  /** How a scanner sends the test code: {before, wrong}. @param field that is named by what stands before it */
  scanner({ before, wrong }, field) {
    const said = wrong.map(([wanted, came]) => t('scanner.wrong_key', { wanted: wanted || '–', came: came || '–' }));
    this.of = undefined;
    this.#show('open', [
      verdictShape(wrong.length ? 'rework' : 'good'),
      h('div.said', word(t(wrong.length ? 'scanner.wrong' : 'scanner.right')), before && h('p.measured', t('scanner.before', { before, field: field ?? t('scanner.no_field') })),
        h('p.distance', wrong.length ? [...said.slice(0, 3), t('scanner.layout')].join(' · ') : t('scanner.right_how'))),
    ]);
  }

  /** @param provisional why it is not stored: `away`, or `storing`, which passes before it can be read out */
  #show(state, children, provisional) {
    if (this.asking) {
      this.missed = () => this.#show(state, children, provisional);
      return;
    }
    this.last = [state, children, provisional];
    this.isOfPart = false;
    this.state = state;
    this.element.dataset.verdict = state;
    if (provisional) this.element.dataset.provisional = provisional;
    else delete this.element.dataset.provisional;
    this.element.ariaBusy = provisional === 'storing' ? 'true' : null;
    this.element.replaceChildren(...children.filter(Boolean));
  }
}
