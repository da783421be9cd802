/** The values of this station, the newest first, with what became of each. */

import { designationText } from '../designation.js';
import { h } from '../dom.js';
import { number, t, time } from '../i18n.js';
import { certificateLink } from '../parts/certificate.js';
import { LaterStore, readJson, store } from '../stored.js';
import { distanceText, limitsText, measuredText, noteText, recordMark, verdictShape } from '../verdict.js';

const MOST = 100;
/** So many values stand beside a verdict, with its own. */
const MOST_OF_RUN = 10;
const SAME = ['characteristic', 'designation', 'lower_limit_mm', 'upper_limit_mm'];
const KEPT = 'recent';
const TAKEN = ['waiting', 'judged', 'open', 'done'];
const OLD = ['corrected', 'moved'];

/** What was judged by the limits held is no record yet: it says both. */
const waitingMark = (state, { verdict }) => (verdict && state === 'waiting'
  ? h('span.mark-of', { 'data-verdict': verdict }, verdictShape(verdict), t(`verdict.${verdict}`), h('span.aside', t('recent.waiting')))
  : h('span.mark-of', verdictShape('waiting'), t(`recent.${state}`)));

export class Recent {
  /** @param ledger the values and their state; @param onCorrect takes the record to correct, and what of it: `measured_mm` or `part_id`; @param onProblem takes why a certificate could not be had; @param leaving ends it */
  constructor({ ledger, onCorrect, onProblem, leaving }) {
    Object.assign(this, { ledger, onCorrect, onProblem });
    this.kept = new LaterStore(() => store(KEPT, JSON.stringify(this.keys), 'session'), leaving);
    this.keys = readJson(KEPT, [], 'session').filter((key) => ledger.get(key));
    this.list = h('ol');
    this.element = h('section.recent', { 'aria-labelledby': 'recent-title' },
      h('h2', { id: 'recent-title' }, t('recent.title')), this.list);
    this.list.append(...this.keys.map((key) => this.#item(ledger.get(key))));
    this.element.hidden = this.keys.length === 0;
  }

  /** The last value that was taken: its record, null while it is not stored, undefined where there is none. */
  get last() {
    const value = this.keys.map((key) => this.ledger.get(key)).find((each) => each && TAKEN.includes(this.ledger.stateOf(each)));
    return value && (value.record ?? null);
  }

  /** The record of an id; undefined where it was not measured here, or was corrected. */
  inForce(id) {
    const value = this.ledger.ofRecord(id);
    return value && !OLD.includes(this.ledger.stateOf(value)) ? value.record : undefined;
  }

  /** The records in force of what a record is of, the newest last, without it. */
  like(record) {
    const records = this.keys.map((key) => this.ledger.get(key)).filter((value) => value?.record && !OLD.includes(this.ledger.stateOf(value))).map((value) => value.record);
    return records.filter((one) => one.id !== record.id && SAME.every((name) => String(one[name]) === String(record[name]))).slice(0, MOST_OF_RUN - 1).reverse();
  }

  /** A value of this window: the newest. */
  add(key) {
    if (this.keys.includes(key)) return;
    this.keys.unshift(key);
    this.list.prepend(this.#item(this.ledger.get(key)));
    for (; this.keys.length > MOST; this.keys.pop()) this.list.lastElementChild.remove();
    this.element.hidden = false;
    this.kept.changed();
  }

  /** A value has changed: it, those that it corrects and what was said of them. */
  draw({ key, root }) {
    this.keys.forEach((each, at) => {
      const value = this.ledger.get(each);
      if (value && (each === key || each === root || (root && value.root === root) || value.root === key)) this.list.children[at].replaceWith(this.#item(value));
    });
  }

  #item(value) {
    const { shown, record, state } = value;
    const now = this.ledger.stateOf(value);
    const isOld = OLD.includes(now);
    const said = this.ledger.said(value);
    const { part_id, characteristic, designation, confirmed } = { ...shown, ...record };
    const what = designation ? designationText(designation) : shown.limits && limitsText(shown.limits);
    return h('li', { class: isOld ? 'corrected' : state },
      record ? recordMark(record) : waitingMark(state, shown),
      h('span.figure', record ? measuredText(record) : number(shown.measured)),
      h('span.aside', [part_id, characteristic, what, time(new Date(shown.at)), confirmed && t('confirmed.mark'), isOld && t(`recent.${now}`)].filter(Boolean).join(' · ')),
      h('span.aside', record ? distanceText(record) : value.reason ?? ''), said.done && h('span.aside.noted', said.unnoted ? t('note.refused', { reason: said.unnoted }) : noteText(said)),
      state === 'stored' && !isOld && h('span.fix',
        this.#fix(record, 'measured_mm', 'recent.correct'), part_id && certificateLink(part_id, this.onProblem), this.#fix(record, 'part_id', 'recent.correct_part')));
  }

  #fix(record, what, name) {
    return h('button.quiet', {
      type: 'button', onclick: () => this.onCorrect(record, what),
      'aria-label': t(`${name}_this`, { mm: measuredText(record), part: record.part_id ?? t('part.none') }),
    }, t(name));
  }
}
