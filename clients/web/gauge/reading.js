/** What a line that was typed or scanned means. Whatever is not wholly one thing is nothing. */

import { parseDesignation } from '../designation.js';
import { boundsOf, nmFromMm, parseMeasured } from '../exact.js';

/** Keys of one scan follow each other faster than fingers. */
export const BURST_GAP_MS = 30;

/** The fields a prefix can name, and what stands before a scan of each unless the shop sets another. */
export const PREFIXES = { part_id: 'P:', order: 'O:', gauge: 'G:', operator: 'U:', machine: 'M:' };

/** A reading of a gauge gone wrong (-25.013, 25.01in, 2.5e1) is no name of a part. */
const LIKE_A_READING = /^[+\-−]?\d*[.,]\d|^[+\-−]/;
/** 2.5013e1 is 25.013 of an instrument; who means the class e1 leaves a blank before it. */
const EXPONENT = /^[\d.,]+[eE]\d+$/;
const NAME = /^(?=.*[A-Za-z])(?=.*\d).{3,200}$/;

/**
 * @param text the whole line
 * @param burst whether it came as fast as a scanner types
 * @param prefixes {field: prefix}
 * @returns {kind: 'value' | 'job' | 'field' | 'nothing', text, name}; a job has the name of the field it is of where there is no such size
 */
export function readLine(text, { burst = false, prefixes = PREFIXES } = {}) {
  const line = text.trim();
  for (const [name, prefix] of Object.entries(prefixes)) {
    const given = prefix && line.toLowerCase().startsWith(prefix.toLowerCase());
    const rest = given && line.slice(prefix.length).trim();
    if (rest) return { kind: 'field', name, text: rest };
  }
  const value = parseMeasured(line);
  if (value !== null) return { kind: 'value', text: value };
  const designation = parseDesignation(line);
  const isScan = burst && NAME.test(line);
  // M12-3A may be the number of a part too.
  if (designation && !EXPONENT.test(line)) return { kind: 'job', text: line, name: designation.standard && isScan ? 'part_id' : undefined };
  if (isScan && !LIKE_A_READING.test(line) && !EXPONENT.test(line)) return { kind: 'field', name: 'part_id', text: line };
  return { kind: 'nothing', text: line };
}

/** Follows the keys of one field and says whether its text came in one burst. */
export class BurstWatch {
  #last = -Infinity;
  #keys = 0;
  #slow = false;

  /** @param at in ms; of each key that writes a character */
  key(at) {
    if (this.#keys > 0 && at - this.#last > BURST_GAP_MS) this.#slow = true;
    this.#last = at;
    ++this.#keys;
  }

  /** What came whole, by another way. */
  took(text) {
    this.reset();
    this.#keys = text.length;
  }

  isBurst(text) {
    return !this.#slow && this.#keys >= 3 && this.#keys >= text.length;
  }

  reset() {
    this.#keys = 0;
    this.#slow = false;
  }
}

/** A value farther than this many tolerances outside the limits is asked about. */
const FAR = 5;

/** Whether a text in the place of a name is what a gauge says of the job: 25.013 for 25 H7, but not 4711. */
export function isReading(text, job) {
  const value = /[.,]\d/.test(text) ? parseMeasured(text) : null;
  return value !== null && !job.reason && !isFar(nmFromMm(value), job);
}

/** Whether a value is asked about. Without limits (the service is away and never gave them) half to twice the nominal size has to do. */
export function isFar(nm, { limits, nominal_nm: nominal }) {
  if (!limits) return 2 * nm < nominal || nm > 2 * nominal;
  const [lower, upper] = boundsOf(limits);
  const own = nmFromMm(limits.nominal_mm);
  // A limit that stands alone is as far from the nominal size as a tolerance is wide.
  const tolerance = Number.isFinite(upper - lower) ? upper - lower : Math.min(Math.abs(upper - own), Math.abs(own - lower));
  const far = FAR * Math.max(tolerance, 1);
  return nm < lower - far || nm > upper + far;
}
