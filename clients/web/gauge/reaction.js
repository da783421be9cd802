/**
 * What a plan demands after a value that is not good: its reaction, and of a catalogue a cause and a measure.
 * It stands there, and no value is taken, until somebody says that it is done. Kept with the window, so that a
 * reload skips nothing.
 */

import { getJson, url } from '../api.js';
import { h, refill } from '../dom.js';
import { t } from '../i18n.js';
import { readJson, store } from '../stored.js';
import { verdictMark } from '../verdict.js';

const KEPT = 'reactions';
const KEPT_CATALOGUE = 'catalogue';
const PARTS = ['cause', 'measure'];

export class Reactions {
  /**
   * @param onDone is told when nothing is left to be done
   * @param onNote takes {key, measured, cause, measure} of a value
   */
  constructor({ onDone, onNote }) {
    Object.assign(this, { onDone, onNote });
    this.open = readJson(KEPT, [], 'session');
    this.element = h('section.reactions', { role: 'alert', 'aria-label': t('reaction.label') });
    this.#draw();
  }

  /** Why no value is taken; '' where one is. */
  get reason() {
    const [first] = this.open;
    if (!first) return '';
    return first.catalogue ? t('reaction.note_first') : t('reaction.first', { reaction: first.reaction });
  }

  /** Fetches the catalogues of a plan, and keeps them for when the service is away. */
  async prepare(names) {
    await Promise.allSettled(names.map(async (name) => {
      store(`${KEPT_CATALOGUE}.${name}`, JSON.stringify(await getJson(url(['catalogues', name]), { asks: false })));
    }));
    this.#draw();
  }

  /** Notes how a value was: as the page judges it when it is typed, then as the service does. */
  judged(key, { part_id, characteristic, measured, reaction, catalogue }, verdict) {
    const known = this.open.find((one) => one.key === key);
    if (verdict === 'good') this.open = this.open.filter((one) => one !== known);
    else if (!known && (reaction || catalogue) && verdict) this.open = [...this.open, { key, part_id, characteristic, measured, reaction, catalogue, verdict }];
    else return;
    this.#keep();
  }

  /** A value that is not stored demands nothing. */
  refused(key) {
    this.judged(key, {}, 'good');
  }

  /** What has still to be said of a value; without its catalogue both, in words of one's own. */
  #asked(one) {
    if (!one.catalogue) return [];
    const catalogue = readJson(`${KEPT_CATALOGUE}.${one.catalogue}`, null);
    return PARTS.filter((part) => !one[part] && (!catalogue || catalogue[`${part}s`].length))
      .map((part) => ({ part, choices: catalogue?.[`${part}s`] ?? [] }));
  }

  #say(one, part, text) {
    if (!text) return;
    one[part] = text;
    if (this.#asked(one).length) this.#keep();
    else this.#done(one);
  }

  #done(one) {
    const { key, measured, cause, measure } = one;
    if (cause || measure) this.onNote({ key, measured, cause, measure });
    this.open = this.open.filter((other) => other.key !== key);
    this.#keep();
    if (!this.open.length) this.onDone();
  }

  #keep() {
    store(KEPT, JSON.stringify(this.open), 'session');
    this.#draw();
  }

  #draw() {
    this.element.hidden = !this.open.length;
    refill(this.element, this.open.map((one, i) => {
      const [next] = this.#asked(one);
      const said = one.cause && h('button.said', { type: 'button', onclick: () => { one.cause = undefined; this.#keep(); } }, one.cause);
      return h('div.line', verdictMark(one.verdict),
        h('span', [one.part_id, one.characteristic].filter(Boolean).join(' · ')), one.reaction && h('strong', one.reaction), said,
        next ? i === 0 && this.#choice(one, next) : h('button.primary', { type: 'button', onclick: () => this.#done(one) }, t('reaction.done')));
    }));
  }

  /** What the catalogue offers as large as a gloved finger, and a field for what it does not. */
  #choice(one, { part, choices }) {
    const own = h('input', { type: 'text', name: part, maxlength: 200, autocomplete: 'off', 'aria-label': t(`note.${part}`), placeholder: t('reaction.other') });
    return h('form.catalogue', { onsubmit: (event) => { event.preventDefault(); this.#say(one, part, own.value.trim()); } },
      h('p.label', t(`reaction.${part}`)),
      h('div.choices-of', choices.map((text) => h('button', { type: 'button', onclick: () => this.#say(one, part, text) }, text))),
      h('div.line', own, h('button', { type: 'submit' }, t('reaction.take'))));
  }
}
