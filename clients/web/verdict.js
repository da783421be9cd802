/** The four verdicts: each has a word, a shape and a colour of its own. */

import { h, s } from './dom.js';
import { boundsOf, nmFromMm, nmFromUm, mmText, umText } from './exact.js';
import { has, number, t } from './i18n.js';

export const VERDICTS = ['good', 'rework', 'reject', 'indeterminate'];

// Outline and inner sign on a field of 48 by 48: the outlines differ where colours do not.
const SHAPES = {
  good: ['M24 2a22 22 0 1 1 0 44a22 22 0 1 1 0-44z', 'M13 25l8 8 14-17'],
  rework: ['M24 3L47 45H1z', 'M24 18v13M24 37v2'],
  reject: ['M15 2h18l13 13v18l-13 13H15L2 33V15z', 'M15.5 15.5l17 17M32.5 15.5l-17 17'],
  indeterminate: ['M24 1l23 23-23 23L1 24z', 'M18.5 19a5.5 5.5 0 1 1 8 5c-2 1.2-2.5 2-2.5 4M24 33v1.5'],
  open: ['M3 3h42v42H3z', 'M14 24h20'],
  waiting: ['M24 3a21 21 0 1 1 0 42a21 21 0 1 1 0-42z', 'M24 13v11l7 5'],
};

export function verdictShape(verdict) {
  const [outline, sign] = SHAPES[verdict];
  return s('svg.shape', { viewBox: '0 0 48 48', 'aria-hidden': 'true', 'data-verdict': verdict },
    s('path.outline', { d: outline }), s('path.sign', { d: sign }));
}

/** A small verdict for lists: shape and word. */
export function verdictMark(verdict) {
  if (!verdict) return h('span.mark-of', t('verdict.unjudged'));
  return h('span.mark-of', { 'data-verdict': verdict }, verdictShape(verdict), t(`verdict.${verdict}`));
}

export const isUnverified = ({ verdict, envelope_result: found }) => verdict === 'good' && found === 'not_verified';

/** How many characteristics have a value; each without a name is one by itself. */
export const countOf = (names) => new Set(names.map((name) => name || {})).size;

/** The verdict of a record; one that is good says where no GO gauge has verified the envelope that is required. */
export const recordMark = (record) => [verdictMark(record.verdict), isUnverified(record) && h('span.aside', t('envelope.not_verified'))];

/** "8 µm below the upper limit": where the value lies from the limit that is nearest to it. */
export function distanceText(record) {
  const measured = nmFromMm(record.corrected_mm ?? record.measured_mm);
  const [lower, upper] = boundsOf(record);
  if (lower === -Infinity && upper === Infinity) return '';
  const toUpper = upper - measured;
  const toLower = measured - lower;
  const limit = Math.abs(toUpper) <= Math.abs(toLower) ? 'upper' : 'lower';
  const distance = limit === 'upper' ? toUpper : -toLower;
  if (distance === 0) return t(`distance.on.${limit}`);
  return t(`distance.${distance > 0 ? 'below' : 'above'}.${limit}`, { um: number(umText(Math.abs(distance))) });
}

const measureText = (measure) => (has(`measure.${measure}`) ? t(`measure.${measure}`) : measure);
/** "Insert worn → Insert changed · after the break" */
export const noteText = ({ cause, measure, text }) => [[cause, measure && measureText(measure)].filter(Boolean).join(' → '), text].filter(Boolean).join(' · ');

/** "25.000 to 25.021 mm" with equally many decimals. */
export function limitsText(limits) {
  const [lower, upper] = boundsOf(limits);
  if (lower === -Infinity && upper === Infinity) return '–';
  if (upper === Infinity) return `≥ ${number(mmText(lower))} mm`;
  if (lower === -Infinity) return `≤ ${number(mmText(upper))} mm`;
  const places = Math.max(...[lower, upper].map((nm) => mmText(nm).split('.')[1].length));
  return t('limits.range', { lower: number(mmText(lower, places)), upper: number(mmText(upper, places)) });
}

export const toleranceText = (limits) => number(umText(nmFromUm(limits.tolerance_um)));
/** @param places so many decimals at the least, as placesOf gives them for a column */
export const measuredText = (record, places) => number(mmText(nmFromMm(record.measured_mm), places));

/** Who it was, of a record or a note: the name that was given, else that of the key, as of a badge. */
export const operatorOf = ({ operator, caller }) => operator ?? caller;

/** The decimals that most values of a column have. */
export function placesOf(records) {
  const counts = new Map();
  for (const { measured_mm: mm } of records) {
    const { length } = mmText(nmFromMm(mm)).split('.')[1];
    counts.set(length, (counts.get(length) ?? 0) + 1);
  }
  return [...counts].sort(([one, few], [other, many]) => many - few || other - one)[0]?.[0];
}
