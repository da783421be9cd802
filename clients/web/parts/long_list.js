/**
 * A list of any length, the newest row first: its scroll bar is that of the whole list, and the rows about those in sight stand in the page.
 * Neighbours are read by record, so none is left out or comes twice; a place far away is found by the time of storing, at a centre only about.
 */

import { h } from '../dom.js';
import { number, t } from '../i18n.js';
import { Latest } from '../latest.js';
import { Ladder } from './ladder.js';

const PAGE = 50;
/** Rows in the page. */
const MOST = 300;
/** Rows of one answer. */
const LARGEST = 1000;
/** No browser draws higher: a longer list has less of the scroll bar for each row. */
const HIGHEST_PX = 12e6;
/** Far down a long list, browsers round where they scroll to. */
const ROUNDING_PX = 4;
/** A scroll bar that is dragged rests this long before the rows at its place are read. */
const REST_MS = 80;

const msOf = (record) => Date.parse(record.received_at);

export class LongList {
  /**
   * @param table with its head; @param name of the list
   * @param read takes {sort, limit, after, received_from, received_to} and a signal: resolves to the rows, each {record}
   * @param rowOf makes the element of a row
   * @param count resolves to how many rows there are, of those received before an ISO time if one is given
   * @param headOf makes the element above the first row of a run, or of one that follows another run
   * @param onPlace takes how many rows are older than the first in sight; undefined at the top
   */
  constructor(table, name, { read, rowOf, count, headOf, onPlace, onProblem, leaving }) {
    Object.assign(this, { table, read, rowOf, count, headOf, onPlace, onProblem });
    this.latest = new Latest(leaving);
    [this.body] = table.tBodies;
    this.scroller = h('div.scroll.records', { tabindex: 0, role: 'region', 'aria-label': name, onscroll: () => this.#look(), onkeydown: (event) => this.#key(event) }, table);
    this.input = h('input', { type: 'number', name: 'row', min: 1, onchange: () => this.#want(this.input.valueAsNumber - 1 || 0) });
    this.total = h('span.hint');
    this.place = h('label.place', { hidden: true }, h('span.label', t('parts.row')), this.input, this.total);
  }

  /**
   * Reads the list anew. @param rank the row to begin at, by how many are older; none: the newest
   * @param isAgain whether it asks what it has asked before: the rows stay in the page until the answer is there
   */
  async open(rank, isAgain = false) {
    if (!isAgain) this.#clear();
    clearTimeout(this.soon);
    this.length = undefined;
    this.wanted = undefined;
    this.ladder = null;
    this.per = 0;
    this.isBusy = false;
    await this.#ask(async (signal) => {
      const rows = await this.read({ sort: 'newest', limit: PAGE }, signal);
      this.length = rows.length < PAGE ? rows.length : await this.count(undefined, signal);
      if (signal.aborted) return;
      if (rows[0]) this.newest = msOf(rows[0].record);
      this.#put(rows, 0, { isTop: true, isBottom: rows.length < PAGE });
      this.scroller.scrollTop = 0;
    });
    const first = this.wanted ?? (rank === undefined ? 0 : this.length - 1 - rank);
    if (first > 0) await this.#goTo(first);
  }

  #clear() {
    this.held = [];
    this.start = 0;
    this.body.replaceChildren();
  }

  /** Goes to a row that was entered, as soon as it is there. */
  #want(at) {
    if (this.length === undefined) this.wanted = at;
    else this.#goTo(at);
  }

  rowOfRecord(id) {
    return this.held.find(({ record }) => record.id === id);
  }

  /** Whether its rows say something else by now; those that came at the top are no matter. */
  async isOld(signal) {
    const said = (rows) => JSON.stringify(rows.map(({ record, isReplaced }) => [record, isReplaced]));
    const after = this.isBottom ? undefined : this.held.at(-1)?.record.id;
    const held = this.held.slice(0, after ? -1 : undefined).reverse();
    return held.length > 0 && said(await this.read({ sort: 'oldest', limit: held.length, after }, signal)) !== said(held);
  }

  /** Rows may have come at the top: they are read where it is in sight, else when it comes into sight. */
  async renew() {
    if (!this.held.length) return this.open();
    const isHere = this.isTop && this.scroller.scrollTop === 0;
    this.isTop = false;
    if (!isHere) return this.#look();
    await this.#extend(false, true);
  }

  /** One question at a time; the newest counts. */
  async #ask(work) {
    this.isBusy = true;
    this.scroller.ariaBusy = 'true';
    try {
      await this.latest.run(async (signal) => {
        await work(signal);
        if (signal.aborted) return;
        this.isBusy = false;
        this.scroller.ariaBusy = null;
      });
    } catch (problem) {
      this.isBusy = false;
      this.scroller.ariaBusy = null;
      if (this.length === undefined) this.#clear();
      return this.onProblem(problem);
    }
    if (!this.isBusy) this.#look();
  }

  /** Shows rows in the place of those shown, the first of them at a position. */
  #put(rows, start, { isTop, isBottom }) {
    Object.assign(this, { held: rows, start, isTop, isBottom });
    if (this.body.contains(document.activeElement)) this.scroller.focus({ preventScroll: true });
    this.body.replaceChildren(...this.#made(rows));
    this.#number();
    if (rows.length && !this.per) this.per = Math.min(this.body.getBoundingClientRect().height / rows.length, HIGHEST_PX / Math.max(this.length, 1));
    this.#space();
  }

  #made(rows) {
    for (const row of rows) row.element = this.rowOf(row);
    return rows.map(({ element }) => element);
  }

  /** Numbers the rows, and stands the head of a run above its first. Where an end was met, the rows know better than the times how many there are. */
  #number() {
    const { held } = this;
    if (this.isTop) this.start = 0;
    else this.start = Math.max(this.start, 1);
    const end = this.start + held.length;
    if (this.isBottom) this.length = end;
    else this.length = Math.max(this.length, end + 1);
    held.forEach((row, i) => {
      row.element.setAttribute('aria-rowindex', this.start + i + 2);
      const { run_id: run, part_id: part } = row.record;
      row.element.toggleAttribute('data-same-part', Boolean(part) && held[i - 1]?.record.part_id === part);
      if (!run || held[i - 1]?.record.run_id === run) {
        row.head?.remove();
        row.head = null;
      } else if (!row.head) {
        row.head = this.headOf(run);
        row.element.before(row.head);
      }
    });
    if (this.ladder?.total !== this.length) this.ladder = null;
    this.table.setAttribute('aria-rowcount', this.length + 1);
    this.input.max = this.length;
    this.total.textContent = t('parts.of', { count: number(this.length) });
    this.place.hidden = this.isTop && this.isBottom;
  }

  #space() {
    this.table.style.setProperty('--above', `${this.start * this.per}px`);
    this.table.style.setProperty('--below', `${(this.length - this.start - this.held.length) * this.per}px`);
  }

  /** Where the rows stand, in px below the head of the table. */
  #edges() {
    const head = this.table.tHead.getBoundingClientRect().height;
    const from = this.scroller.getBoundingClientRect().top + this.scroller.clientTop + head;
    const { top, bottom } = this.body.getBoundingClientRect();
    return { above: top - from, below: bottom - from, height: this.scroller.clientHeight - head, from };
  }

  /** The first row in sight. */
  #first(from) {
    return this.held.findIndex(({ element }) => element.getBoundingClientRect().bottom > from + ROUNDING_PX);
  }

  /** A busy browser may lose its own scroll by a key while rows are added: one that is set stays. */
  #key(event) {
    const { scroller } = this;
    const page = this.#edges().height;
    const to = { Home: 0, End: scroller.scrollHeight, PageUp: scroller.scrollTop - page, PageDown: scroller.scrollTop + page }[event.key];
    if (to === undefined || event.target !== scroller) return;
    event.preventDefault();
    scroller.scrollTop = to;
  }

  /** Reads what comes into sight, and says where it is. */
  #look() {
    const { held, per } = this;
    if (!held.length || this.length === undefined) return;
    clearTimeout(this.soon);
    const { above, below, height, from } = this.#edges();
    const isPast = above > height || below < 0;
    const position = above > 0 ? this.start - above / per : below < 0 ? this.start + held.length - below / per : this.start + this.#first(from);
    const at = Math.min(Math.max(Math.floor(position), 0), this.length - 1);
    if (document.activeElement !== this.input) this.input.value = at + 1;
    this.soon = setTimeout(() => {
      if (!this.scroller.isConnected) return;
      if (isPast) this.#goTo(at);
      else if (!this.isBusy) this.onPlace(at ? this.length - 1 - at : undefined);
    }, REST_MS);
    if (isPast || this.isBusy) return;
    if (above > -height && !this.isTop) this.#extend(false);
    else if (below < 2 * height && !this.isBottom) this.#extend(true);
  }

  /** Reads on at one end; what is farthest from there goes. @param isShown whether what comes at the top is to be in sight, unless somebody scrolls meanwhile */
  #extend(isDown, isShown = false) {
    const edge = this.held.at(isDown ? -1 : 0).record.id;
    return this.#ask(async (signal) => {
      const rows = await this.read({ sort: isDown ? 'newest' : 'oldest', limit: PAGE, after: edge }, signal);
      if (signal.aborted) return;
      const { from } = this.#edges();
      const isAtTop = isShown && this.scroller.scrollTop === 0;
      const seen = this.held[this.#first(from)]?.element;
      const before = seen?.getBoundingClientRect().top;
      const all = isDown ? [...this.held, ...rows] : [...rows.reverse(), ...this.held];
      const spare = Math.max(all.length - MOST, 0);
      const gone = isDown ? all.splice(0, spare) : all.splice(MOST, spare);
      if (gone.some(({ element }) => element.contains(document.activeElement))) this.scroller.focus({ preventScroll: true });
      for (const { element, head } of gone) { element.remove(); head?.remove(); }
      for (const row of gone) row.head = null;
      if (isDown) this.body.append(...this.#made(rows)); else this.body.prepend(...this.#made(rows));
      const isEnd = rows.length < PAGE;
      this.start += isDown ? spare : -rows.length;
      this.isTop = isDown ? this.isTop && !spare : isEnd;
      this.isBottom = isDown ? isEnd : this.isBottom && !spare;
      this.held = all;
      // Rows that came since at the top move all places.
      if (!isDown && isEnd) this.length -= this.start;
      this.#number();
      this.#space();
      if (isAtTop) this.scroller.scrollTop = 0;
      else if (seen?.isConnected) this.scroller.scrollTop += seen.getBoundingClientRect().top - before;
    });
  }

  #goTo(wanted) {
    const at = Math.min(Math.max(wanted, 0), this.length - 1);
    const { scroller } = this;
    const isEnd = scroller.scrollTop + scroller.clientHeight >= scroller.scrollHeight - 2 && at > this.start + this.held.length;
    return this.#ask(async (signal) => {
      const shown = this.held[at - this.start] ? {} : await this.#find(at, signal);
      if (signal.aborted) return;
      if (shown.rows) this.#put(shown.rows, shown.start, shown);
      const row = this.held[Math.min(Math.max(at - this.start, 0), this.held.length - 1)];
      if (isEnd) scroller.scrollTop = scroller.scrollHeight;
      else if (row) scroller.scrollTop += row.element.getBoundingClientRect().top - this.#edges().from;
    });
  }

  /** Rows about a position, from the step nearest to it: {rows, start, isTop, isBottom}. */
  async #find(at, signal) {
    const { length } = this;
    if (!this.ladder) {
      const [oldest] = await this.read({ sort: 'oldest', limit: 1 }, signal);
      this.ladder = new Ladder(length, oldest ? msOf(oldest.record) : 0, this.newest, (ms, ending) => this.count(new Date(ms).toISOString(), ending));
    }
    const rank = length - 1 - at;
    const step = await this.ladder.near(rank, signal);
    const isDown = step.rank > rank;
    const time = new Date(step.ms).toISOString();
    // Its neighbour on the other side of the time; from there on by record, as a centre stores late what a station has kept.
    const [edge] = step.isEnd ? [] : await this.read(isDown ? { sort: 'oldest', received_from: time, limit: 1 } : { sort: 'newest', received_to: time, limit: 1 }, signal);
    let begin = edge ? { after: edge.record.id } : {};
    const begun = isDown ? length - step.rank : length - 1 - step.rank;
    const way = Math.abs(begun - at);
    const skip = Math.max(way - PAGE, 0);
    for (let passed = 0; ;) {
      const limit = Math.min(way - passed + PAGE, LARGEST);
      const rows = await this.read({ sort: isDown ? 'newest' : 'oldest', limit, ...begin }, signal);
      const isLast = rows.length < limit;
      if (passed + rows.length > way || isLast) {
        const left = Math.min(Math.max(skip - passed, 0), Math.max(rows.length - PAGE, 0));
        const kept = rows.slice(left);
        const isWhole = !edge && passed + left === 0;
        passed += left;
        return isDown ? { rows: kept, start: begun + passed, isTop: isWhole, isBottom: isLast }
          : { rows: kept.reverse(), start: begun - passed - kept.length + 1, isTop: isLast, isBottom: isWhole };
      }
      passed += rows.length;
      begin = { after: rows.at(-1).record.id };
    }
  }
}
