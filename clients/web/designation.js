/** Designations as people type them: Ø25H7, 25 h7, 132,5/a13, 25H7/g6; of other standards M10-6H and 25 ISO 2768-m. */

import { nmFromMm, parseMeasured } from './exact.js';
import { number } from './i18n.js';

const DESIGNATION = /^[Øø⌀∅\s]*([\d.,]+)\s*(?:mm)?\s*\/?\s*([A-Za-z]\w*)$/;
/** The envelope requirement of ISO 14405-1 behind a class. */
const ENVELOPE = /\s*(?:\(E\)|Ⓔ)$/;
/** A side of a fit that is a bearing: its bore as a hole, its outer ring as a shaft. */
const BEARING = /[Ii][Ss][Oo]\s*492\s*[-−–]\s*(\w+)/;
const FIT = new RegExp(String.raw`^[Øø⌀∅\s]*([\d.,]+)\s*(?:mm)?\s*(${BEARING.source}|[A-Z]\w*(?:\s*(?:\(E\)|Ⓔ))?)\s*[/\s-]\s*(${BEARING.source}|[a-z]\w*(?:\s*(?:\(E\)|Ⓔ))?)$`);
const THREAD = /^M\s*(\d+(?:[.,]\d+)?)(?:\s*[xX×]\s*(\d+(?:[.,]\d+)?))?\s*[-−–]\s*((?:\d[A-Za-z]){1,2})$/i;
const GENERAL = /^(?:([RC])|[Øø⌀∅])?\s*(\d+(?:[.,]\d+)?)\s*(?:mm)?\s*ISO\s*2768\s*[-−–]\s*([fmcv])$/i;
/** A general tolerance of a length does not say whether it is of an outside or an inside dimension. */
const OPEN = /^ISO 2768-/;

/** {text: "25H7", nominal_nm, tolerance_class}; with Ⓔ also `envelope: true`, of another standard `standard: true`; null where it cannot be one. */
export function parseDesignation(typed) {
  const text = typed.trim();
  const other = otherStandard(text);
  if (other) return other;
  const match = DESIGNATION.exec(text.replace(ENVELOPE, ''));
  const nominal = match && parseMeasured(match[1]);
  return nominal && { text: nominal + match[2], nominal_nm: nmFromMm(nominal), tolerance_class: match[2], ...(ENVELOPE.test(text) && { envelope: true }) };
}

function otherStandard(typed) {
  const [thread, general] = [THREAD.exec(typed), GENERAL.exec(typed)];
  if (!thread && !general) return null;
  const nominal = parseMeasured(thread ? thread[1] : general[2]);
  const text = thread ? `M${nominal}${thread[2] ? `x${parseMeasured(thread[2])}` : ''}-${thread[3]}`
    : `${(general[1] ?? '').toUpperCase()}${nominal} ISO 2768-${general[3].toLowerCase()}`;
  return { text, nominal_nm: nmFromMm(nominal), tolerance_class: thread ? text : text.replace(/^([RC]?)[\d.]+/, '$1').trim(), standard: true };
}

/** Whether limits hold inside and outside alike, so that somebody must say which of them is measured. */
export const isOpen = (limits) => OPEN.test(limits?.tolerance_class ?? '');

/** Whether limits are those of the pitch diameter of a thread. */
export const isThread = (limits) => THREAD.test(limits?.tolerance_class ?? '');

/** A designation for people: "Ø 25 H7" with the comma of the language; those of other standards as they are written. */
export const designationText = (designation) => (otherStandard(designation)
  ? number(designation).replaceAll('\u2212', '-') : `Ø ${number(designation)}`);

export const isBearing = (name) => BEARING.test(name);

/** {size: "25", hole: "H7", shaft: "g6", envelope: {hole, shaft}: whether there is Ⓔ}; null where it cannot be one. */
export function parseFit(typed) {
  const match = FIT.exec(typed.trim());
  const size = match && parseMeasured(match[1]);
  if (!size) return null;
  const classes = { hole: match[2], shaft: match[4] };
  const read = (text, of) => (of ? `ISO 492-${/^n/i.test(of) ? of.toLowerCase() : of.toUpperCase()}` : text.replace(ENVELOPE, ''));
  return { size, hole: read(classes.hole, match[3]), shaft: read(classes.shaft, match[5]), envelope: Object.fromEntries(Object.entries(classes).map(([side, text]) => [side, ENVELOPE.test(text)])) };
}
