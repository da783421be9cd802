/**
 * What a plan demands after a value that is not good: its reaction, and of a catalogue a cause and a measure.
 * It stands there, and no value is taken, until somebody says that it is done.
 */

import { getJson, url } from '../api.js';
import { h, refill } from '../dom.js';
import { t } from '../i18n.js';
import { PAIR_MS } from '../press.js';
import { readJson, store } from '../stored.js';
import { verdictMark } from '../verdict.js';

const KEPT_CATALOGUE = 'catalogue';
const PARTS = ['cause', 'measure'];

export class Reactions {
  /** @param ledger the values and their state; @param operator who says it; @param named the door for keys, as of a name; @param onDone is told when nothing is left to be done */
  constructor({ ledger, operator, named, onDone }) {
    Object.assign(this, { ledger, operator, named, onDone });
    this.lastTap = -Infinity;
    this.element = h('section.reactions', { role: 'alert', 'aria-label': t('reaction.label') });
    this.element.addEventListener('click', (event) => this.#tapped(event), { capture: true });
    this.draw();
  }

  /** The next choices stand where the last did: the second tap of a pair answers none of them. */
  #tapped(event) {
    if (!event.detail || !event.target.closest('button')) return; // a key
    const isSecond = event.timeStamp - this.lastTap < PAIR_MS;
    this.lastTap = event.timeStamp;
    if (!isSecond) return;
    event.preventDefault();
    event.stopPropagation();
  }

  /** Why no value is taken; '' where one is. */
  get reason() {
    const [first] = this.ledger.open;
    if (!first) return '';
    return first.shown.catalogue ? t('reaction.note_first') : t('reaction.first', { reaction: first.shown.reaction });
  }

  /** Fetches the catalogues of a plan, and keeps them for when the service is away. */
  async prepare(names) {
    await Promise.allSettled(names.map(async (name) => {
      store(`${KEPT_CATALOGUE}.${name}`, JSON.stringify(await getJson(url(['catalogues', name]), { asks: false })));
    }));
    this.draw();
  }

  /** What has still to be said of a value; without its catalogue, or by an empty one, both in words of one's own. */
  #asked(value) {
    if (!value.shown.catalogue) return [];
    const kept = readJson(`${KEPT_CATALOGUE}.${value.shown.catalogue}`, null);
    const catalogue = PARTS.some((part) => kept?.[`${part}s`].length) ? kept : null;
    const said = this.ledger.said(value);
    return PARTS.filter((part) => !said[part] && (!catalogue || catalogue[`${part}s`].length))
      .map((part) => ({ part, choices: catalogue?.[`${part}s`] ?? [] }));
  }

  #say(value, part, text) {
    if (!text) return;
    this.ledger.say(value.key, part, text);
    if (!this.#asked(value).length) this.#done(value);
  }

  #done(value) {
    this.ledger.done(value.key, this.operator());
    if (!this.ledger.open.length) this.onDone();
  }

  draw() {
    const { open } = this.ledger;
    // Its field keeps the typed text while nothing changes.
    const drawn = JSON.stringify(open.map((value) => [value.key, this.ledger.verdictOf(value), this.ledger.said(value), this.#asked(value)]));
    if (drawn === this.drawn) return;
    this.drawn = drawn;
    this.element.hidden = !open.length;
    refill(this.element, open.map((value, i) => {
      const [next] = this.#asked(value);
      const { cause } = this.ledger.said(value);
      const said = cause && h('button.said', { type: 'button', onclick: () => this.ledger.say(value.key, 'cause') }, cause);
      const { part_id, characteristic, reaction } = value.shown;
      return h('div.line', verdictMark(this.ledger.verdictOf(value)),
        h('span', [part_id, characteristic].filter(Boolean).join(' · ')), reaction && h('strong', reaction), said,
        next ? i === 0 && this.#choice(value, next) : h('button.primary', { type: 'button', onclick: () => this.#done(value) }, t('reaction.done')));
    }));
  }

  /** What the catalogue offers as large as a gloved finger, and a field for what it does not. */
  #choice(value, { part, choices }) {
    const take = () => {
      const text = own.value.trim();
      own.value = '';
      if (text) this.#say(value, part, this.named(text));
    };
    const own = h('input', { type: 'text', name: part, maxlength: 200, autocomplete: 'off', 'aria-label': t(`note.${part}`), placeholder: t('reaction.other') });
    return h('form.catalogue', { onsubmit: (event) => { event.preventDefault(); take(); } },
      h('p.label', t(`reaction.${part}`)),
      h('div.choices-of', choices.map((text) => h('button', { type: 'button', onclick: () => this.#say(value, part, text) }, text))),
      h('div.line', own, h('button', { type: 'submit' }, t('reaction.take'))));
  }
}
