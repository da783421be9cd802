/**
 * A station without a browser: the ledger of the page in tabs over one storage, a line to a service that answers late,
 * loses answers, refuses and is away, and whoever works there. What is drawn comes from a seed.
 */

import assert from 'node:assert/strict';

import { Ledger } from '../../../../clients/web/gauge/ledger.js';

const PLAN = '4711-A';
const PARTS = ['SN-1', 'SN-2'];
/** One with a catalogue, one with a reaction, one that demands nothing. */
const CHARACTERISTICS = [{ name: 'bore', catalogue: 'turning' }, { name: 'seat', reaction: 'Stop' }, { name: 'slot' }];
/** In a row at parts that have no names. */
const SAMPLED = { name: 'collar', reaction: 'Stop', size: 3 };
const ROUND = 'round';
const VERDICTS = ['good', 'reject', 'rework'];

/** mulberry32 */
export function randomOf(seed) {
  let state = seed;
  return (count) => {
    state = (state + 0x6d2b79f5) | 0;
    let mixed = Math.imul(state ^ (state >>> 15), state | 1);
    mixed ^= mixed + Math.imul(mixed ^ (mixed >>> 7), mixed | 61);
    return Math.floor((((mixed ^ (mixed >>> 14)) >>> 0) / 2 ** 32) * count);
  };
}

/** What localStorage is, with a word to the other tabs. */
class Storage {
  #items = new Map();
  written = [];

  getItem(name) {
    return this.#items.get(name) ?? null;
  }

  setItem(name, text) {
    this.#items.set(name, String(text));
    this.written.push(name);
    Object.defineProperty(this, name, { value: text, enumerable: true, configurable: true });
  }

  removeItem(name) {
    this.#items.delete(name);
    delete this[name];
  }
}

const refusal = (status) => ({ problem: { status, message: 'refused', errors: [], reason: 'refused' } });

/** The service: each key once, records and their notes. */
class Service {
  #answers = new Map();
  records = [];

  get(id) {
    return this.records.find((record) => record.id === id);
  }

  inForce(part, name) {
    return this.records.filter((record) => record.part_id === part && record.characteristic === name && !record.corrected).at(-1);
  }

  store(content, corrected) {
    const record = { id: `r${this.records.length}`, ...content, ...(corrected && { correction_of: corrected.id }), notes: [] };
    if (corrected) corrected.corrected = true;
    this.records.push(record);
    return record;
  }

  /** @returns {record}, or {problem} */
  answer({ key, content, correcting, of, id, note }, ids) {
    if (this.#answers.has(key)) return this.#answers.get(key);
    if (of) {
      const about = this.get(id ?? ids.get(of));
      if (!about) return refusal(404);
      about.notes.push(note);
      this.#answers.set(key, { record: note });
      return { record: note };
    }
    const corrected = correcting && this.get(correcting);
    if (content.refused || corrected?.corrected) return refusal(422);
    const answer = { record: this.store(content, corrected) };
    this.#answers.set(key, answer);
    return answer;
  }
}

/** The queue of one tab: what it has not sent is kept for all of them. */
class Line extends EventTarget {
  constructor(desk) {
    super();
    this.desk = desk;
    this.entries = [...desk.kept];
  }

  add(entry) {
    this.entries.push(entry);
    this.desk.kept.push(entry);
  }

  addNote({ of, id, key, body, shown }) {
    if (!this.desk.kept.some((entry) => entry.key === key)) this.add({ key, of, id, note: JSON.parse(body), shown });
  }

  /** Sends the oldest. @param lost whether its answer is */
  send(lost) {
    const [entry] = this.entries;
    // A note waits for its value, whichever tab has that.
    if (!entry || this.desk.kept.some(({ key }) => key === entry.of)) return;
    const { record, problem } = this.desk.service.answer(entry, this.desk.ids);
    if (record && !entry.of) this.desk.ids.set(entry.key, record.id);
    if (lost) return;
    this.entries.shift();
    this.desk.kept = this.desk.kept.filter((kept) => kept !== entry);
    const detail = problem ? { entry, problem } : { entry, record };
    this.dispatchEvent(new CustomEvent(problem ? 'refused' : entry.of ? 'noted' : 'stored', { detail }));
  }
}

export class Desk {
  kept = [];
  ids = new Map();
  service = new Service();
  up = true;
  serial = 0;
  said = new Map();
  steps = [];
  samples = 0;

  /** @param Kind of ledger: that of the page, or one that is wrong */
  constructor(seed, Kind = Ledger) {
    this.random = randomOf(seed);
    this.Kind = Kind;
    this.storage = globalThis.localStorage = new Storage();
    this.tabs = [this.#tab()];
  }

  #tab() {
    const line = new Line(this);
    return { line, ledger: new this.Kind(line) };
  }

  one(list) {
    return list[this.random(list.length)];
  }

  /** What one tab has written the others read, and what was stored all of them are told. */
  #spread() {
    for (const name of new Set(this.storage.written.splice(0))) {
      for (const { ledger } of this.tabs) ledger.hear(name.replace(/^fitgauge\.value\./, ''));
    }
  }

  #tell() {
    for (const record of this.service.records) {
      for (const { ledger } of this.tabs) {
        ledger.told({ ...record, measured_mm: 25, measured_at: '2026-11-20T08:00:00Z' });
        for (const note of record.notes) ledger.noted({ measurement_id: record.id, ...note });
      }
    }
    this.#spread();
  }

  static STEPS = ['value', 'value', 'value', 'sample', 'sample', 'sample', 'send', 'send', 'send', 'lose', 'outage', 'reload', 'correct', 'correct', 'move', 'elsewhere', 'note', 'note', 'note', 'note', 'note', 'say', 'say', 'say', 'tab', 'close'];
  /** While no page is open. */
  static CLOSED = ['elsewhere', 'note', 'note', 'outage', 'open'];

  step(name = this.one(this.tabs.length ? Desk.STEPS : Desk.CLOSED)) {
    this.steps.push(name);
    this[name](this.one(this.tabs) ?? this.last);
    this.#spread();
    this.#tell();
    this.check();
  }

  #take(tab, content, shown, corrected) {
    const key = `k${++this.serial}`;
    const refused = this.random(8) === 0;
    tab.line.add({ key, content: { ...content, refused }, correcting: corrected?.id, shown });
    tab.ledger.taken(key, shown, corrected);
    return key;
  }

  /** The page judges it as the service will, otherwise, or not at all. */
  #provisional(verdict) {
    return this.one([verdict, verdict, this.one(VERDICTS), null]);
  }

  value(tab) {
    if (tab.ledger.open.length) return; // the station takes none
    const { name, ...demands } = this.one(CHARACTERISTICS);
    const content = { part_id: this.one(PARTS), characteristic: name, verdict: this.one(VERDICTS) };
    const shown = { ...content, ...demands, measured: '25', plan: PLAN, at: 0, verdict: this.#provisional(content.verdict) };
    this.#take(tab, content, shown);
  }

  /** A value of a sample: the next of the one that lacks some, else the first of another. */
  sample(tab) {
    if (tab.ledger.open.length) return;
    const taken = () => this.#all(tab.ledger).filter((value) => value.shown.subgroup === this.samples && !value.root && value.state !== 'refused').length;
    if (!this.samples || taken() >= SAMPLED.size) ++this.samples;
    const { name: characteristic, reaction } = SAMPLED;
    const content = { characteristic, verdict: this.one(VERDICTS), subgroup: this.samples };
    const key = this.#take(tab, content, { ...content, reaction, measured: '25', plan: PLAN, round: ROUND, at: 0, verdict: this.#provisional(content.verdict) });
    if (taken() < SAMPLED.size) tab.ledger.goesOn(key);
  }

  #stored(tab) {
    return this.#all(tab.ledger).filter((value) => value.record && ['judged', 'open', 'done'].includes(tab.ledger.stateOf(value)));
  }

  #correct(tab, fields) {
    const value = this.one(this.#stored(tab).filter(({ record }) => record.part_id || !fields.part_id));
    if (!value) return;
    const { part_id, characteristic, verdict, subgroup } = { ...value.record, ...fields };
    const content = { part_id, characteristic, verdict };
    this.#take(tab, { ...content, subgroup }, { measured: '25', ...content, at: 0, verdict: this.#provisional(verdict) }, value.record);
  }

  correct(tab) {
    this.#correct(tab, { verdict: this.one(VERDICTS) });
  }

  move(tab) {
    this.#correct(tab, { part_id: this.one(PARTS) });
  }

  /** In the view of all parts, at a desk: the service has it, the station is told. */
  elsewhere(tab) {
    const record = this.#known(this.#stored(tab));
    if (!record) return;
    const { part_id, characteristic, subgroup } = record;
    this.service.store({ part_id, characteristic, verdict: this.one(VERDICTS), subgroup }, record);
  }

  note(tab) {
    const record = this.#known(tab.ledger.open);
    if (record?.notes.length === 0) record.notes.push({ cause: 'there', measure: 'there', isElsewhere: true });
  }

  /** The record of one of some values, as the station knows it, unless it was corrected since. */
  #known(values) {
    const record = this.up ? this.service.get(this.one(values)?.record?.id) : undefined;
    return record?.corrected ? undefined : record;
  }

  send(tab) {
    if (this.up) tab.line.send(false);
  }

  /** The service stores it, and its answer never comes. */
  lose(tab) {
    if (this.up) tab.line.send(true);
  }

  outage() {
    this.up = !this.up;
  }

  reload(tab) {
    this.tabs[this.tabs.indexOf(tab)] = this.#tab();
  }

  tab(tab) {
    if (this.tabs.length === 1) this.tabs.push(this.#tab());
    else this.tabs.splice(this.tabs.indexOf(tab), 1);
  }

  /** Nobody listens. */
  close(tab) {
    Object.assign(this, { last: tab, tabs: [] });
  }

  open() {
    this.tabs.push(this.#tab());
  }

  /** A cause, a measure, or that the reaction is done, of what is asked first: the screen asks for it once. */
  say({ ledger }) {
    const [value] = ledger.open;
    if (!value) return;
    const said = ledger.said(value);
    const root = value.root ?? value.key;
    const part = value.shown.catalogue ? ['cause', 'measure'].find((each) => !said[each]) : undefined;
    if (part) ledger.say(value.key, part, `${part} ${++this.serial}`);
    if (part === 'cause') return;
    assert.ok(!this.said.has(root), `${root} was asked about again`);
    this.said.set(root, ledger.said(value));
    ledger.done(value.key, 'Kim');
  }

  /** Sends all there is. */
  settle() {
    this.up = true;
    if (!this.tabs.length) this.open();
    for (const tab of [...this.tabs]) this.reload(tab); // a page that loads sends what a closed one has left
    this.#tell();
    for (let left = 400; this.tabs.some(({ line }) => line.entries.length); --left) {
      assert.ok(left, 'the queue does not end');
      for (const { line } of this.tabs) line.send(false);
      this.#spread();
      this.#tell();
    }
    this.check();
  }

  /** The record and every screen say the same, as far as the record is known. */
  check() {
    const [first, ...others] = this.tabs.map(({ ledger }) => this.#screen(ledger));
    for (const other of others) assert.deepEqual(other, first, 'two tabs differ');
    for (const { notes } of this.service.records) assert.ok(notes.filter((note) => !note.isElsewhere).length <= 1, 'two notes on one record');
    for (const { ledger } of this.tabs) {
      for (const { key, record, state } of this.#all(ledger)) if (state === 'stored' && record) assert.equal(this.service.get(record.id)?.verdict, record.verdict, key);
      for (const value of ledger.open) assert.ok(!this.said.has(value.root ?? value.key) && !this.service.get(value.record?.id)?.notes.length, 'what was done is open');
    }
    if (this.kept.length) return;
    for (const part of PARTS) for (const demands of CHARACTERISTICS) this.#compare(part, demands);
    this.#compareSample();
  }

  #all(ledger) {
    return [...Array(this.serial)].map((_, i) => ledger.get(`k${i + 1}`)).filter(Boolean);
  }

  #screen(ledger) {
    const tiles = PARTS.flatMap((part) => CHARACTERISTICS.map(({ name }) => ledger.inForce(PLAN, part, undefined, name)?.key));
    return { tiles, sample: ledger.sampleInForce(PLAN, '', ROUND, SAMPLED.name).map(({ key }) => key), states: this.#all(ledger).map((value) => [value.key, ledger.stateOf(value)]) };
  }

  /** Nothing is on its way: the tile, what is asked, and the notes are those of the records. */
  #compare(part, { name, ...demands }) {
    const records = this.service.records.filter((record) => record.part_id === part && record.characteristic === name && !record.corrected);
    for (const { ledger } of this.tabs) {
      const value = ledger.inForce(PLAN, part, undefined, name);
      assert.equal(value !== undefined, records.length > 0, `the tile of ${part} ${name}`);
      if (!value) continue;
      assert.ok(records.some(({ id }) => id === value.record?.id), `the tile of ${part} ${name} is of another record`);
      this.#compareOpen(ledger, records, demands);
    }
  }

  /** The sample that is shown is the last, with every value that it has. */
  #compareSample() {
    const records = this.service.records.filter(({ characteristic, corrected }) => characteristic === SAMPLED.name && !corrected);
    const last = Math.max(...records.map(({ subgroup }) => subgroup));
    for (const { ledger } of this.tabs) {
      const shown = ledger.sampleInForce(PLAN, '', ROUND, SAMPLED.name).map(({ record }) => record?.id);
      assert.deepEqual(shown.sort(), records.filter(({ subgroup }) => subgroup === last).map(({ id }) => id).sort(), 'the sample that is shown');
      this.#compareOpen(ledger, records, SAMPLED);
    }
  }

  #compareOpen(ledger, records, demands) {
    const open = new Set(ledger.open.map((each) => each.record?.id));
    for (const { id, verdict, notes } of records) {
      const isBad = verdict !== 'good';
      if (!isBad) assert.ok(!open.has(id), `${id} is good and open`);
      else assert.equal(open.has(id), Boolean(demands.catalogue || demands.reaction) && notes.length === 0, `${id}: open or noted`);
    }
  }
}
