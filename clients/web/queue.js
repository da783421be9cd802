/**
 * Typed values on their way to the service. A value is in the browser's storage before it is sent and
 * until it is answered, under a key of its own that makes repeats safe: it arrives once, also when the
 * service is away or the page is loaded again meanwhile. One is sent at a time, in the order of typing, and each only
 * with the key of the person who typed it.
 */

import { isAway, keyInUse, Problem, request, signOf, url } from './api.js';
import { connection } from './connection.js';
import { forget, readJson, readStored, store, storedKeys } from './stored.js';

const PREFIX = 'queue.';
const SHORTEST_WAIT_MS = 200;
const LONGEST_WAIT_MS = 2000;
const TIMEOUT_MS = 10000;
const KEPT_IDS = 'stored-ids';
const MOST_IDS = 200;

/** Unlikely anywhere else; crypto.randomUUID would need HTTPS. */
export const randomText = () =>
  Array.from(crypto.getRandomValues(new Uint8Array(16)), (byte) => byte.toString(16).padStart(2, '0')).join('');

/**
 * Fires `stored` with {entry, record}, `noted` with {entry}, `refused` with {entry, problem} and `change`. An entry
 * is {key, path, body, shown, sign}: what is posted where, what the page shows of it meanwhile, and of which key it is. A
 * note has `of` instead of a path: the key of the value it is about, which is stored before it.
 */
class Queue extends EventTarget {
  #entries = [];
  #ids = new Map();
  #sending = false;
  #lastTime = 0;
  /** Whether what waits waits for a key. */
  isLocked = false;
  #wake = () => {};

  constructor() {
    super();
    const kept = storedKeys(PREFIX).map((name) => ({ name, ...readJson(name, {}) }));
    // Another window may have sent one meanwhile. What an earlier page left was not seen by anybody.
    this.#entries = kept.filter((entry) => (entry.path || entry.of) && entry.body && entry.shown);
    for (const entry of this.#entries) {
      entry.shown.late = true;
      entry.kept = true;
    }
    connection.addEventListener('change', () => this.#wake());
  }

  get size() {
    return this.#entries.length;
  }

  get entries() {
    return this.#entries;
  }

  /** Whether all of it would be there after a reload. */
  get isKept() {
    return this.#entries.every((entry) => entry.kept);
  }

  /** What waits in any window of this browser. */
  get everywhere() {
    const others = storedKeys(PREFIX).filter((name) => this.#entries.every((entry) => entry.name !== name));
    return [...others.map((name) => readJson(name, {})).filter(({ shown }) => shown), ...this.#entries];
  }

  /** Those on their way: a note follows its value. */
  get own() {
    const { held } = this;
    return this.#entries.filter((entry) => !held.includes(entry) && !held.some(({ key }) => key === entry.of));
  }

  /** Those of another key than that in use. */
  get held() {
    const sign = signOf(keyInUse());
    return this.#entries.filter((entry) => sign && entry.sign && entry.sign !== sign);
  }

  /** The values on their way. */
  get values() {
    return this.own.filter((entry) => !entry.of);
  }

  /** Somebody sends with the key in use what waits for another, unless another window has sent it. */
  adopt() {
    const { held } = this;
    this.#entries = this.#entries.filter((entry) => !held.includes(entry) || !entry.kept || readStored(entry.name) !== null);
    for (const entry of held) {
      delete entry.sign;
      this.#keep(entry);
    }
    this.#changed();
    this.send();
  }

  /**
   * Takes a value over.
   * @param timed whether the body lacks the time of typing: it is added when it is first sent, since
   *   only an answer tells how far this station's clock is off
   * @returns its entry
   */
  add(path, body, shown, timed = false) {
    return this.#add({ path, body, shown, ...(timed && { typedAt: Date.now() }) });
  }

  /** A note to a value. @param of its key; @param id of its record, where it has one; @param key of the note: one of the same key is the same */
  addNote({ of, id, key, body, shown }) {
    return this.#add({ of, id, body, shown }, key);
  }

  #add(content, key = randomText()) {
    // Names sort in the order of typing, also those of one millisecond.
    this.#lastTime = Math.max(this.#lastTime + 1, Date.now());
    const name = `${PREFIX}${String(this.#lastTime).padStart(15, '0')}.${key}`;
    const entry = { name, key, sign: signOf(keyInUse()), ...content };
    this.#keep(entry);
    this.#entries.push(entry);
    this.#changed();
    this.send();
    return entry;
  }

  /** Notes something on what the page shows of an entry. */
  mark(entry, note) {
    Object.assign(entry.shown, note);
    this.#keep(entry);
  }

  #keep(entry) {
    const { name, kept, ...content } = entry;
    entry.kept = store(name, JSON.stringify(content));
  }

  /** From here on every repeat has the same body. */
  async #complete(entry) {
    if (!entry.typedAt) return;
    await connection.knowsTime();
    const measured = JSON.stringify(connection.at(entry.typedAt).toISOString());
    entry.body = `${entry.body.slice(0, -1)},"measured_at":${measured}}`;
    delete entry.typedAt;
    this.#keep(entry);
  }

  /** Sends what there is until nothing is left, or only what waits for a key: the next value asks for it again. */
  async send() {
    if (this.#sending) return;
    this.#sending = true;
    this.isLocked = false;
    let wait = SHORTEST_WAIT_MS;
    for (let [first] = this.own; first; [first] = this.own) {
      const result = await this.#sendOne(first);
      if (result === 'locked') {
        if (keyInUse()) continue; // another key, which has its own values
        break;
      }
      if (result === 'answered') {
        wait = SHORTEST_WAIT_MS;
        continue;
      }
      await this.#pause(wait);
      wait = Math.min(2 * wait, LONGEST_WAIT_MS);
    }
    this.#sending = false;
    this.isLocked = this.size > 0;
    if (this.isLocked) this.#changed();
  }

  /** Where an entry goes: a note to the record that its value has become, through this window or another. */
  #path({ path, of, id: known }) {
    if (path) return path;
    const id = known ?? this.#ids.get(of) ?? readJson(KEPT_IDS, []).find(([key]) => key === of)?.[1];
    // Another window has still to send the value.
    if (!id && storedKeys(PREFIX).some((name) => name.endsWith(`.${of}`))) throw new Problem(409, { code: 'idempotency.in_progress' });
    if (!id) throw new Problem(404, { code: 'measurement.unknown' });
    return url(['measurements', id, 'notes']);
  }

  /** @returns `answered` for good, `later` to try again, or `locked` without a key */
  async #sendOne(entry) {
    try {
      await this.#complete(entry);
      const response = await request('POST', this.#path(entry), {
        body: entry.body,
        headers: { 'Content-Type': 'application/json', 'Idempotency-Key': `"${entry.key}"` },
        timeout: TIMEOUT_MS,
        sign: entry.sign,
      });
      const record = await response.json();
      connection.report(true);
      this.#finish(entry, entry.of ? 'noted' : 'stored', { entry, record });
      return 'answered';
    } catch (problem) {
      connection.report(!isAway(problem));
      if (problem.status === 401) return 'locked';
      if (isAway(problem) || problem.passing) {
        // It may be stored: with another key it would be stored again.
        if (!entry.sign && keyInUse()) {
          entry.sign = signOf(keyInUse());
          this.#keep(entry);
        }
        return 'later';
      }
      this.#finish(entry, 'refused', { entry, problem });
      return 'answered';
    }
  }

  #finish(entry, type, detail) {
    if (type === 'stored') this.#remember(entry.key, detail.record.id);
    forget(entry.name);
    this.#entries = this.#entries.filter((each) => each !== entry);
    this.dispatchEvent(new CustomEvent(type, { detail }));
    this.#changed();
  }

  #remember(key, id) {
    this.#ids.set(key, id);
    store(KEPT_IDS, JSON.stringify([...readJson(KEPT_IDS, []).slice(1 - MOST_IDS), [key, id]]));
  }

  /** Waits, but no longer than until the service is back. */
  #pause(milliseconds) {
    return new Promise((resolve) => {
      const timer = setTimeout(resolve, milliseconds);
      this.#wake = () => {
        clearTimeout(timer);
        resolve();
      };
    });
  }

  #changed() {
    this.dispatchEvent(new Event('change'));
  }
}

export const queue = new Queue();
