/**
 * What became of the values that were typed while the service was away: counted by verdict, each that
 * is not good named, until somebody has touched it. Kept in the browser, so that a reload hides nothing.
 */

import { h, refill } from '../dom.js';
import { number, t } from '../i18n.js';
import { untilLifted } from '../press.js';
import { forget, readJson, store, storedKeys } from '../stored.js';
import { distanceText, measuredText, verdictMark, VERDICTS } from '../verdict.js';

/** Each under a name of its own: no tab writes over what another one has written. */
const PREFIX = 'arrival.';
const GATHER_MS = 100;

const readAll = () => new Map(storedKeys(PREFIX).map((name) => [name, readJson(name, null)])
  .filter(([, one]) => one?.verdict === 'good' || one?.record || one?.shown));
const timeOf = ({ record, shown }) => new Date(record?.measured_at ?? shown.at).getTime();

export class Arrivals {
  /** {verdict, record} of what is stored, with a record unless it is good; {shown, reason} of what is refused */
  #all = readAll();
  /** Those the browser had no room for. */
  #unkept = new Map();
  #timer = 0;

  /** The tabs of a browser are one station: each shows what came through any of them. @param leaving ends it */
  constructor(leaving) {
    this.element = h('section.arrived', { role: 'alert', hidden: true });
    addEventListener('storage', ({ key }) => (key ?? PREFIX).includes(PREFIX) && this.#hear(), { signal: leaving });
    leaving.addEventListener('abort', () => clearTimeout(this.#timer));
    this.#draw();
  }

  /** A value that two tabs have sent is one. */
  stored(record) {
    const { id, verdict } = record;
    this.#keep(id, verdict === 'good' ? { verdict } : { verdict, record });
  }

  /** @param key of its entry in the queue */
  refused(key, shown, reason) {
    this.#keep(key, { shown, reason });
  }

  #seen() {
    for (const name of this.#all.keys()) forget(name);
    this.#all.clear();
    this.#unkept.clear();
    this.#draw();
  }

  #keep(id, one) {
    const name = PREFIX + id;
    this.#all.set(name, one);
    if (!store(name, JSON.stringify(one))) this.#unkept.set(name, one);
    this.#draw();
  }

  /** Another tab has written or seen something. */
  #hear() {
    this.#timer ||= setTimeout(async () => {
      await untilLifted();
      this.#timer = 0;
      this.#all = new Map([...readAll(), ...this.#unkept]);
      this.#draw();
    }, GATHER_MS);
  }

  #draw() {
    const all = [...this.#all.values()];
    const bad = all.filter(({ verdict }) => verdict !== 'good').sort((one, other) => timeOf(one) - timeOf(other));
    const count = (wanted) => all.filter(({ verdict }) => verdict === wanted).length;
    const refused = count(undefined);
    this.element.hidden = all.length === 0;
    this.element.classList.toggle('bad', bad.length > 0);
    const parts = VERDICTS.filter(count).map((verdict) => h('strong', { class: verdict }, t(`arrived.${verdict}`, { count: count(verdict) })));
    if (refused) parts.push(h('strong.reject', t('arrived.refused', { count: refused })));
    refill(this.element,
      h('p', t('arrived.stored', { count: all.length - refused }), ' ', parts.flatMap((part, i) => (i ? [', ', part] : [part]))),
      h('button', { type: 'button', onclick: () => this.#seen() }, t('arrived.seen')),
      bad.length > 0 && h('ol', bad.map((each) => this.#item(each))));
  }

  #item({ record, shown, reason }) {
    return h('li', record ? verdictMark(record.verdict) : h('span', t('panel.refused')),
      h('span.figure', record ? `${measuredText(record)} mm` : `${number(shown.measured)} mm`),
      h('span', [(record ?? shown).part_id, (record ?? shown).characteristic, (record ?? shown).designation].filter(Boolean).join(' · ')),
      h('span.aside', record ? distanceText(record) : reason));
  }
}
