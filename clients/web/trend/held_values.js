/** The values of a chart: the newest of one characteristic and size, and those that come. */

import { getJson, url } from '../api.js';
import { Latest } from '../latest.js';
import { newestValues } from './recent_values.js';
import { isDesignation, sizeOf } from './series.js';

/** More than so many values missed are a list to read anew. */
const MOST_MISSED = 1000;

export class HeldValues {
  #records = [];
  /** Stored while the list was read: they may not be in it. */
  #meanwhile = [];

  /** @param of {bar, characteristic, size, count}: the filter bar, '' for every characteristic, and for the size measured last */
  constructor(of, leaving) {
    Object.assign(this, of);
    this.leaving = leaving;
    this.loading = new Latest(leaving);
    /** Those that the characteristic has. */
    this.sizes = new Set();
  }

  /** Another characteristic has other sizes. */
  choose(characteristic) {
    this.characteristic = characteristic;
    this.size = '';
    this.sizes.clear();
  }

  /** The records of the size, the newest last. */
  get shown() {
    return this.#records.filter((record) => !this.size || sizeOf(record) === this.size);
  }

  /** Reads the newest. @returns whether they are still what is wanted */
  async load() {
    this.#meanwhile = [];
    let newest = await this.#newest();
    if (!newest) return false;
    for (const record of newest) this.sizes.add(sizeOf(record));
    // Chosen once: a chart that follows whatever is measured last hops from size to size.
    if (!this.size && newest.length) {
      this.size = sizeOf(newest.at(-1));
      if (this.sizes.size > 1) newest = await this.#newest() ?? newest;
    }
    this.#records = newest;
    for (const record of this.#meanwhile) this.#add(record);
    return true;
  }

  #newest() {
    return this.loading.run((signal) => newestValues(this.query, this.count, signal));
  }

  /** A drawing's own limits have no designation that the service could look for. */
  get query() {
    return { ...this.bar.query, characteristic: this.characteristic, designation: isDesignation(this.size) ? this.size : '' };
  }

  /** A record that was just stored. @returns whether it belongs to what is shown, and was not there */
  take(record) {
    this.#meanwhile.push(record);
    return this.#add(record);
  }

  #add(record) {
    const isOther = (this.characteristic && record.characteristic !== this.characteristic) || !this.bar.has(record);
    if (isOther || this.#records.some(({ id, correction_of: old }) => id === record.id || old === record.id)) return false;
    this.sizes.add(sizeOf(record));
    this.size ||= sizeOf(record);
    if (sizeOf(record) !== this.size) return false;
    this.#records = [...this.#records.filter(({ id }) => id !== record.correction_of), record].slice(-this.count);
    return true;
  }

  /**
   * Reads what was stored since the newest value held, which the stream of events may not have told of.
   * @returns whether something was; null where the list has to be read anew
   */
  async catchUp() {
    const newest = this.#records.at(-1);
    if (!newest) return null;
    try {
      const { measurements, next } = await getJson(url(['measurements'], { ...this.query, after: newest.id, limit: MOST_MISSED }), { signal: this.leaving });
      return next ? null : measurements.filter((record) => this.take(record)).length > 0;
    } catch {
      return this.leaving.aborted ? false : null; // another log, or none: the list says why
    }
  }
}
