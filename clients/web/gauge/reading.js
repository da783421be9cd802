/** What a line that was typed or scanned means. Whatever is not wholly one thing is nothing. */

import { parseDesignation } from '../designation.js';
import { boundsOf, nmFromMm, parseLength, parseMeasured } from '../exact.js';

/** Keys of one scan follow each other faster than fingers. */
export const BURST_GAP_MS = 30;

/** The fields a prefix can name, and what stands before a scan of each unless the shop sets another. */
export const PREFIXES = { part_id: 'P:', order: 'O:', gauge: 'G:', operator: 'U:', machine: 'M:', tool: 'T:' };

/**
 * A line as a gauge sends it, its value in brackets: Digimatic by a multiplexer (01A+00025.015), Sylvac and Tesa by Opto-RS
 * (+025.015, with < = > of its limits), Mahr (25.015 mm, 1 +25.015 mm =).
 */
export const GAUGE_LINE = '^(?:(?:\\d\\dA\\s*|\\d\\s+)(?=[+-]))?([+-]?\\s*\\d+(?:[.,]\\d+)?)\\s*(?:mm)?\\s*[<=>]{0,2}$';
const OF_A_GAUGE = new RegExp(GAUGE_LINE);
/** Digimatic by a wedge has its point where the gauge has it: an error has none (911). Opto-RS and Mahr say ERR and a figure. */
const GAUGE_ERROR = /^(?:\d\s)?ERR\s?\d$/i;
const INCHES = /^(?:\d\dA|\d\s+)?[+-]?\d+[.,]\d+\s*(?:in|inch|")\s*[<=>]{0,2}$/i;
/** Before the code itself, some scanners send its kind: ]C1 of Code 128, ]Q3 of QR. */
const AIM = /^\][A-Za-z]\d/;
const ADDRESS = /^[a-z]+:\/\/\S*?([^/?#\s]+)\/?(?:[?#]\S*)?$/i;
/** What a scan names without a question: in this shop's layout of keys nothing of it can have come from another key. */
const PLAIN_NAME = /^(?!.*\d[.,]\d)[A-Za-z0-9][A-Za-z0-9 ._/#()-]*$/;
/** 2.5013e1 is 25.013 of an instrument; who means the class e1 leaves a blank before it. */
const EXPONENT = /^[\d.,]+[eE]\d+$/;
const NAME = /^(?=.*[A-Za-z])(?=.*\d).{3,200}$/;

/**
 * @param text the whole line
 * @param burst whether it came as fast as a scanner types
 * @param prefixes {field: prefix}; @param pattern of the numbers of parts, '' where any is one
 * @returns {kind: 'value' | 'job' | 'field' | 'doubt' | 'inches' | 'error' | 'test' | 'nothing', text, name}; a job has the
 *   name of the field it is of where there is no such size; a doubt is a name to be asked about
 */
export function readLine(text, { burst = false, prefixes = PREFIXES, pattern = '' } = {}) {
  if (isTestCode(text)) return { kind: 'test', text: text.trim() };
  const line = text.trim().replace(burst ? AIM : '', '');
  for (const [name, prefix] of Object.entries(prefixes)) {
    const given = prefix && line.toLowerCase().startsWith(prefix.toLowerCase());
    const rest = given && line.slice(prefix.length).trim();
    if (rest) return { kind: name === 'part_id' && !isOfPattern(rest, pattern) ? 'doubt' : 'field', name, text: rest };
  }
  if (GAUGE_ERROR.test(line)) return { kind: 'error', text: line };
  if (INCHES.test(line)) return { kind: 'inches', text: line };
  const value = gaugeValue(line);
  if (value !== null) return { kind: 'value', text: value };
  const designation = parseDesignation(line);
  const isScan = burst && NAME.test(line);
  // M12-3A may be the number of a part too.
  if (designation && !EXPONENT.test(line)) return { kind: 'job', text: line, name: designation.standard && isScan ? 'part_id' : undefined };
  if (isScan && !OF_A_GAUGE.test(line) && !EXPONENT.test(line)) return nameOf(line, pattern);
  return { kind: 'nothing', text: line };
}

/** The name that a line is in the field of one, without what a scanner and a shop write before it; null where it is of something else. */
export function nameIn(line, field, prefixes = PREFIXES) {
  const name = line.trim().replace(AIM, '');
  const read = readLine(name, { prefixes });
  if (read.kind !== 'field') return read.kind === 'test' ? null : name;
  return read.name === field ? read.text : null;
}

/** What a line is in the place of words, a reason say: 'value', 'scan', or '' where it is words. */
export function notWords(line, { burst = false, prefixes = PREFIXES } = {}) {
  const { kind } = readLine(line, { burst, prefixes });
  if (['value', 'error', 'inches'].includes(kind)) return 'value';
  const isOneWord = !/\s/.test(line.trim());
  return isOneWord && (AIM.test(line.trim()) || ['field', 'doubt', 'test'].includes(kind) || (burst && kind === 'job')) ? 'scan' : '';
}

/** Whether a number of a part is as the plan says: `#` is a figure, `?` a character, `*` any text. */
export function isOfPattern(text, pattern) {
  const [signs, wanted] = [text, pattern || '*'].map((one) => [...one.toLowerCase()]);
  const fits = (sign, of) => of === '?' || (of === '#' ? /\d/.test(sign) : sign === of);
  let at = 0;
  let [last, begun] = [-1, 0]; // the last `*`, and where the text behind it begins
  for (let i = 0; i < signs.length;) {
    if (wanted[at] === '*') [last, begun, at] = [at, i, at + 1];
    else if (at < wanted.length && fits(signs[i], wanted[at])) [i, at] = [i + 1, at + 1];
    else if (last >= 0) [at, i] = [last + 1, ++begun]; // that `*` takes one more; those before it never do
    else return false;
  }
  return wanted.slice(at).every((of) => of === '*');
}

/** A scan in the place of the name of a part: taken, or asked about, as an address, ß or ' of another layout of keys, or what the plan does not expect. */
function nameOf(line, pattern) {
  if (PLAIN_NAME.test(line) && isOfPattern(line, pattern)) return { kind: 'field', name: 'part_id', text: line };
  return /^[+\-−]|^\d+[.,]\d/.test(line) ? { kind: 'nothing', text: line } : { kind: 'doubt', name: 'part_id', text: ADDRESS.exec(line)?.[1] ?? line };
}

/** The value of a line that somebody typed or a gauge sent, as "25.0081"; null for anything else. */
export function gaugeValue(line) {
  const typed = parseLength(line);
  const [, sent] = typed === null && OF_A_GAUGE.exec(line) || [];
  return typed ?? (sent ? parseLength(sent.replace(/\s/g, '')) : null);
}

/** Inches as millimetres, exactly; as "25.012904". */
export function mmOfInches(text) {
  const [, sign, whole, fraction = ''] = /^(-?)(\d+)(?:\.(\d+))?$/.exec(text);
  const digits = String(BigInt(whole + fraction) * 254n).padStart(fraction.length + 2, '0');
  return `${sign}${digits.slice(0, -fraction.length - 1)}.${digits.slice(-fraction.length - 1)}`.replace(/0+$/, '').replace(/\.$/, '');
}

/** A code that a shop prints for its stations: letters and signs that lie elsewhere in other layouts of keys. */
export const TEST_CODE = 'FITGAUGE-TEST:Yz_/+09';
/** In a French layout its A is a Q. */
const OF_THE_TEST = /F[I1]TG[AQ]UGE/i;
const isTestCode = (text) => OF_THE_TEST.test(text);

/** How a scanner sends the test code: {before: what stands before it, wrong: [[wanted, came], …]}. */
export function scannerTest(text) {
  const line = text.trim();
  const at = OF_THE_TEST.exec(line).index;
  const came = [...line.slice(at)];
  const wanted = [...TEST_CODE];
  const wrong = Array.from({ length: Math.max(came.length, wanted.length) }, (_, i) => [wanted[i] ?? '', came[i] ?? ''])
    .filter(([one, other]) => one !== other);
  return { before: line.slice(0, at), wrong };
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

/** Whether a text in the place of a name is what a gauge says: 25.013 for 25 H7 or 01A+00025.013, but not 4711. */
export function isReading(text, job) {
  const line = text.trim();
  if (GAUGE_ERROR.test(line) || INCHES.test(line)) return true;
  if (!/[.,]\d/.test(line)) return false;
  const value = parseMeasured(line);
  return value === null ? OF_A_GAUGE.test(line) : !job.reason && !isFar(nmFromMm(value), job);
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
