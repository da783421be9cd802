/** The verdict of a part: the worst of its plan, what is missing and which reactions are open. Only parts in sight are asked for, each once. */

import { getJson, isFolded, url } from '../api.js';
import { h, refill } from '../dom.js';
import { t } from '../i18n.js';
import { fragment } from '../route.js';
import { countOf, isUnverified, verdictShape } from '../verdict.js';

/** So many questions at once. */
const MOST_ASKED = 3;

/** A value without a plan says it all itself. */
const saysMore = ({ plan, characteristics }) => plan !== undefined || characteristics.length > 1;
/** Without a plan nobody knows what is missing: good values make no good part. */
const isOpenEnded = ({ verdict, plan }) => verdict === 'good' && plan === undefined;
const unverifiedOf = ({ characteristics }) => characteristics.filter(isUnverified);
const namesOf = (values) => values.map(({ characteristic }) => characteristic ?? t('part.unnamed')).join(', ');
const wordOf = ({ verdict, missing }) => t(verdict ? `verdict.${verdict}` : missing.length ? 'part.incomplete' : 'verdict.unjudged');
const shapeOf = (found) => (isOpenEnded(found) ? null : found.verdict ?? (found.missing.length ? 'open' : null));

export class PartVerdicts {
  #answers = new Map();
  #asked = new Map();
  #places = new Map();

  /** @param scroller what of it is in sight counts; @param leaving ends all questions */
  constructor(scroller, leaving) {
    this.watch = new IntersectionObserver((seen) => this.#look(seen), { root: scroller });
    leaving.addEventListener('abort', () => { this.watch.disconnect(); this.forget(); });
  }

  /** Parts may have changed: each is asked for anew. */
  forget() {
    for (const asking of this.#asked.values()) asking.abort();
    for (const map of [this.#answers, this.#asked, this.#places]) map.clear();
  }

  /** A part may have changed: it is asked for anew where it is in sight. */
  renew(part) {
    this.#asked.get(part)?.abort();
    for (const map of [this.#answers, this.#asked]) map.delete(part);
    for (const place of document.querySelectorAll('.of-part')) {
      if (place.dataset.part !== part) continue;
      this.#places.delete(place);
      this.watch.unobserve(place);
      this.watch.observe(place);
    }
  }

  /** The place of a part's verdict. */
  placeOf(part) {
    const place = h('span.aside.of-part', { 'data-part': part });
    if (this.#answers.has(part)) this.#draw(place);
    else this.watch.observe(place);
    return place;
  }

  #look(seen) {
    for (const { target, isIntersecting } of seen) {
      if (isIntersecting && this.#answers.has(target.dataset.part)) this.#draw(target);
      else if (isIntersecting) this.#places.set(target, target.dataset.part);
      else this.#places.delete(target);
    }
    const wanted = new Set(this.#places.values());
    for (const [part, asking] of this.#asked) if (!wanted.has(part)) asking.abort();
    this.#ask();
  }

  #ask() {
    for (const part of this.#places.values()) {
      if (this.#asked.size >= MOST_ASKED) return;
      if (!this.#answers.has(part) && !this.#asked.has(part)) this.#askFor(part);
    }
  }

  async #askFor(part) {
    const asking = new AbortController();
    this.#asked.set(part, asking);
    const found = await verdictOf(part, asking.signal).catch(() => null);
    if (this.#asked.get(part) !== asking) return;
    this.#asked.delete(part);
    if (found) this.#answers.set(part, found);
    if (found || !asking.signal.aborted) for (const [place, of] of this.#places) if (of === part) this.#draw(place);
    this.#ask();
  }

  #draw(place) {
    const found = this.#answers.get(place.dataset.part);
    this.#places.delete(place);
    if (!found) return; // It is asked for again when it comes into sight again.
    this.watch.unobserve(place);
    if (!saysMore(found)) return;
    const { missing, open_reactions: open } = found;
    refill(place, shapeOf(found) && verdictShape(shapeOf(found)), [!isOpenEnded(found) && wordOf(found), found.verdict === 'good' && unverifiedOf(found).length > 0 && t('envelope.not_verified'), missing.length > 0 && t('part.missing_count', { count: missing.length }),
      open.length > 0 && t('part.open_count', { count: open.length })].filter(Boolean).join(' · '));
    place.title = [...missing, ...open.map(({ characteristic }) => characteristic)].join(', ');
  }
}

async function verdictOf(part, signal) {
  if (isFolded(part)) throw new Error(t('part.folded', { part }));
  return getJson(url(['parts', part]), { signal, asks: false });
}

/** What a part comes to, above its values: verdict, plan, what is missing, which reactions are open. Nothing where no value is of it. */
export async function partSheet(part, signal) {
  const found = await verdictOf(part, signal).catch((problem) => { if (problem.status === 404) return null; throw problem; });
  if (!found) return null;
  const { plan, missing, open_reactions: open, characteristics } = found;
  const failed = characteristics.filter(({ envelope_result: result }) => result === 'failed');
  const unverified = unverifiedOf(found).filter(({ characteristic: name }) => !name || !failed.some(({ characteristic }) => characteristic === name));
  const counted = t('part.measured_count', { count: countOf(characteristics.map(({ characteristic }) => characteristic)) });
  const station = plan && h('a', { href: fragment({ view: 'gauge', options: { plan, part_id: part } }) }, t('part.measure'));
  return h('section.sheet.part-verdict', { 'data-verdict': found.verdict, 'aria-label': t('panel.part', { part }) }, shapeOf(found) ? verdictShape(shapeOf(found)) : null,
    h('div', h('p.headline', [part, !isOpenEnded(found) && wordOf(found)].filter(Boolean).join(' · ')),
      h('p', [counted, plan === undefined ? t('part.by_no_plan') : t('part.by_plan', { plan })].filter(Boolean).join(' · ')),
      failed.length > 0 && h('p.missing', t('part.go_fails', { names: namesOf(failed) })),
      unverified.length > 0 && h('p.missing', t('part.unverified', { names: namesOf(unverified) })),
      missing.length > 0 && h('p.missing', t('part.missing', { names: missing.join(', ') }), ' ', station),
      open.length > 0 && h('ul', { 'aria-label': t('part.open') }, open.map(({ characteristic, reaction }) => h('li', h('strong', characteristic), ` ${reaction ?? t('part.cause')}`))),
      h('p.aside', t('part.rule'))));
}
