/**
 * Every value of this device and what it demands, by the key under which it is sent. A value and its corrections are a
 * chain: its last link is in force, and what was said of the first holds for all. The plan, the reactions and the list
 * read their state here. Kept in the browser's storage, each value by itself, so that all tabs agree and a reload
 * forgets nothing.
 */

import { connection } from '../connection.js';
import { toJson } from '../exact.js';
import { explain } from '../i18n.js';
import { queue } from '../queue.js';
import { forget, readJson, store, storedKeys } from '../stored.js';

const PREFIX = 'value.';
const MOST = 400;
const PARTS = ['cause', 'measure'];

const isGone = (value) => ['refused', 'dropped'].includes(value.state);

/**
 * Fires `change` with {value, elsewhere}. A value is {key, seq, state: waiting | stored | refused | dropped, shown, record, reason, root, by, past, partial}; the
 * first of a chain also has {cause, measure, text, operator, done, noted, unnoted}.
 */
export class Ledger extends EventTarget {
  #values = new Map();
  /** Those the browser had no room for. */
  #unkept = new Set();
  #seq = 0;

  /** @param line sends the values and their notes */
  constructor(line) {
    super();
    this.line = line;
    const all = storedKeys(PREFIX).map((name) => readJson(name, null)).filter((value) => value?.key && value.shown);
    for (const value of all) this.#values.set(value.key, value);
    this.#sort();
    line.addEventListener('stored', ({ detail: { entry: { key, shown }, record } }) => this.stored(key, shown, record));
    line.addEventListener('refused', ({ detail: { entry: { key, of, shown }, problem } }) => (of ? this.noteRefused(of, explain(problem)) : this.refused(key, shown, explain(problem))));
    globalThis.addEventListener?.('storage', ({ key }) => {
      const at = key?.indexOf(PREFIX) ?? -1;
      if (at >= 0) this.hear(key.slice(at + PREFIX.length));
    });
  }

  get(key) {
    return this.#values.get(key);
  }

  /** The value of a record; undefined where it was not measured here. */
  ofRecord(id) {
    return [...this.#values.values()].find(({ record }) => record?.id === id);
  }

  /**
   * A value is on its way. @param shown {measured, part_id, characteristic, verdict, plan, round, reaction, catalogue, …}
   * @param of the record that it corrects: what it does not name it has of that
   */
  taken(key, shown, of) {
    this.#link({ key, state: 'waiting', shown }, of && this.ofRecord(of.id));
  }

  stored(key, shown, record) {
    if (this.get(key)) this.#change(key, (value) => Object.assign(value, { state: 'stored', record, shown: { ...value.shown, late: shown.late } }));
    else this.#put({ key, state: 'stored', shown, record });
  }

  /** A value that is not stored demands nothing, and what it was to correct is in force again. */
  refused(key, shown, reason) {
    if (!this.get(key)) this.#put({ key, state: 'refused', shown, reason });
    this.#change(key, (value) => Object.assign(value, { state: 'refused', reason }));
  }

  /** The last note of a chain is not stored. A value that is not stored either leaves its note to the one in its place. */
  noteRefused(key, reason) {
    const value = this.get(key);
    if (value && !isGone(value)) this.#change(this.#rootOf(value).key, (root) => { root.unnoted = reason; });
  }

  /** A value that was asked about and not kept. */
  dropped(key, shown, reason) {
    this.#put({ key, state: 'dropped', shown, reason });
  }

  /** The service tells of a record: a correction that was made at another place. */
  told(record) {
    const old = record.correction_of && this.ofRecord(record.correction_of);
    const isOwn = !old || (old.by ?? []).some((key) => this.get(key)?.state === 'waiting') || this.ofRecord(record.id);
    if (isOwn) return;
    const { measured_mm, part_id, characteristic, designation, measured_at } = record;
    const shown = { measured: String(measured_mm), part_id, characteristic, designation, at: measured_at };
    this.#link({ key: record.id, state: 'stored', record, shown }, old);
  }

  /** The service tells of a note: a cause or an action that was given elsewhere is given. */
  noted({ measurement_id: id, cause, measure, text }) {
    const value = this.ofRecord(id);
    const isSaid = cause || measure || (text && !value?.shown.catalogue);
    if (!value || !isSaid || this.#rootOf(value).done) return;
    this.#change(this.#rootOf(value).key, (root) => Object.assign(root, { cause, measure, text, done: true, noted: [...root.noted ?? [], value.key] }));
  }

  /** What is said of a value; undefined takes it back. @param part cause | measure */
  say(key, part, text) {
    this.#change(this.#rootOf(this.get(key)).key, (root) => { if (!root.done) root[part] = text; });
  }

  /** A reaction is done: without a cause and an action, the note says which. @param operator who says it */
  done(key, operator) {
    this.#change(this.#rootOf(this.get(key)).key, (root) => {
      if (root.done) return;
      const text = PARTS.some((part) => root[part]) ? undefined : root.shown.reaction;
      Object.assign(root, { done: true, operator, text });
    });
  }

  /** A sample goes on: its characteristic is still to be measured. */
  goesOn(key) {
    this.#change(key, (value) => { value.partial = true; });
  }

  /** A part is measured anew: its values so far are of the past. */
  again(plan, part) {
    for (const value of this.of(plan, part)) this.#change(value.key, (each) => { each.past = true; });
  }

  /** Cause, measure, text, whether the reaction is done, and why the note is not stored. */
  said(value) {
    const { cause, measure, text, done, unnoted } = this.#rootOf(value);
    return { cause, measure, text, done: Boolean(done), unnoted };
  }

  verdictOf({ record, shown }) {
    return record?.verdict ?? shown.verdict;
  }

  /** waiting, judged, open (its reaction is to be done), done, corrected, moved (to another part), refused or dropped. */
  stateOf(value) {
    if (isGone(value)) return value.state;
    const next = this.#nextOf(value);
    if (next) return (next.shown.part_id ?? '') === (value.shown.part_id ?? '') ? 'corrected' : 'moved';
    const verdict = this.verdictOf(value);
    if (!verdict) return 'waiting';
    const { reaction, catalogue } = value.shown;
    if (verdict === 'good' || !(reaction || catalogue)) return 'judged';
    return this.#rootOf(value).done ? 'done' : 'open';
  }

  /** Values whose reaction is to be done, the oldest first. */
  get open() {
    return [...this.#values.values()].filter((value) => this.stateOf(value) === 'open');
  }

  /** The value in force of a characteristic at a part, or at a round where parts have no names. */
  inForce(plan, part, round, name) {
    return this.of(plan, part, round).filter(({ shown }) => shown.characteristic === name).at(-1);
  }

  /** The values in force of the newest sample, of what is no sample the newest; with them a GO gauge that failed and was not used since. */
  sampleInForce(plan, part, round, name) {
    const all = this.of(plan, part, round).filter(({ shown }) => shown.characteristic === name);
    all.sort((one, other) => this.#rootOf(one).seq - this.#rootOf(other).seq);
    const newest = all.at(-1);
    // The values of a sample are of different parts: of one part the newest counts.
    const sample = part ? undefined : newest?.shown.subgroup;
    const saidOf = ({ record, shown }) => (record ?? shown).go_gauge;
    const tried = all.findLast(saidOf);
    return all.filter((value) => value === newest || (sample !== undefined && value.shown.subgroup === sample) || (value === tried && saidOf(value) === 'fails'));
  }

  /** When a part was measured last, by its values in force: a date, or undefined. */
  lastAt(plan, part) {
    return this.of(plan, part).at(-1)?.shown.at;
  }

  /** The values in force of a part, or of a round where parts have no names. */
  of(plan, part, round) {
    return [...this.#values.values()].filter((value) => {
      const { shown } = value;
      const isHere = shown.plan === plan && (part ? shown.part_id === part : !shown.part_id && shown.round === round);
      return isHere && !value.past && !isGone(value) && !this.#nextOf(value);
    });
  }

  /** A value, or the next one of a chain: at no time is none of it in force. */
  #link(value, old) {
    const { plan, round, characteristic, reaction, catalogue, subgroup } = old?.shown ?? {};
    const inherited = old && { plan, round, characteristic, reaction, catalogue, subgroup };
    if (old) this.#change(old.key, (one) => { one.by = [...one.by ?? [], value.key]; });
    this.#put({ ...value, shown: { ...inherited, ...value.shown }, root: old?.root ?? old?.key, partial: old?.partial, past: old?.past });
  }

  #rootOf(value) {
    return this.get(value.root) ?? this.get(value.key) ?? value;
  }

  #nextOf(value) {
    return (value.by ?? []).map((key) => this.get(key)).find((next) => next && !isGone(next));
  }

  #put(value) {
    this.#seq = Math.max(this.#seq + 1, Date.now());
    this.#values.set(value.key, { seq: this.#seq, ...value });
    this.#forgetOldest();
    this.#change(value.key, () => {});
  }

  /** Changes a value as it is kept: another tab may have written it. */
  #change(key, change) {
    const value = (!this.#unkept.has(key) && readJson(PREFIX + key, null)) || this.get(key);
    change(value);
    this.#values.set(key, value);
    if (store(PREFIX + key, JSON.stringify(value))) this.#unkept.delete(key);
    else this.#unkept.add(key);
    this.dispatchEvent(new CustomEvent('change', { detail: { value } }));
    this.#settle(this.#rootOf(value));
  }

  /** All tabs have the values in one order. */
  #sort() {
    const order = (one, other) => one.seq - other.seq || (one.key < other.key ? -1 : 1);
    this.#values = new Map([...this.#values.values()].sort(order).map((value) => [value.key, value]));
    this.#seq = [...this.#values.values()].at(-1)?.seq ?? 0;
  }

  /** Another tab has written a value. */
  hear(key) {
    const value = readJson(PREFIX + key, null);
    if (!value) return;
    const isNew = !this.#values.has(key);
    this.#values.set(key, value);
    if (isNew) this.#sort();
    this.dispatchEvent(new CustomEvent('change', { detail: { value, elsewhere: true } }));
  }

  /** A record that is not good has what was said of its chain as its note: once, whichever of the two comes first. */
  #settle(root) {
    if (!root.done || ![...PARTS, 'text'].some((part) => root[part])) return;
    let value = root;
    for (let next = this.#nextOf(value); next; next = this.#nextOf(value)) value = next;
    const verdict = this.verdictOf(value);
    if (isGone(value) || !verdict || verdict === 'good' || root.noted?.includes(value.key)) return;
    const { cause, measure, text, operator } = root;
    this.#change(root.key, (each) => Object.assign(each, { noted: [...each.noted ?? [], value.key], unnoted: undefined }));
    // Two tabs that send it at once send it under one key.
    this.line.addNote({
      of: value.key, id: value.record?.id, key: `note-${value.key}`, body: toJson({ cause, measure, text, operator: operator || undefined }),
      shown: { measured: value.shown.measured, at: connection.now() },
    });
  }

  /** A chain is forgotten whole, and not before its reaction is done. */
  #forgetOldest() {
    if (this.#values.size <= MOST) return;
    const isNeeded = (value) => value.state === 'waiting' || this.stateOf(value) === 'open';
    const chainOf = (root) => [...this.#values.values()].filter((value) => value === root || value.root === root.key);
    const oldest = [...this.#values.values()].find((value) => !this.get(value.root) && !chainOf(value).some(isNeeded));
    for (const { key } of oldest ? chainOf(oldest) : []) {
      this.#values.delete(key);
      forget(PREFIX + key);
    }
  }
}

export const ledger = new Ledger(queue);
