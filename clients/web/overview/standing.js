/** How a characteristic stands: its newest values, their verdicts, and what the service computes of them. */

import { getJson, url } from '../api.js';
import { FEWEST } from '../trend/figures.js';
import { isCounted } from '../trend/phases.js';
import { countVerdicts, hasLimits, pointOf } from '../trend/series.js';

/** So many of the newest values of each. */
export const LAST = 100;

/** {records: the newest last, count: of those not set aside, isLimited: whether one has limits, verdicts, ppk: {value, lower, upper} or undefined, stable: undefined where the values tell nothing} */
export async function standingOf(filter, signal) {
  const { measurements } = await getJson(url(['measurements'], { ...filter, last: LAST, notes: 'shown' }), { signal });
  const points = measurements.map(pointOf);
  const counted = points.filter(isCounted);
  const figures = hasSpread(counted.map(({ record }) => record)) ? await figuresOf(filter, counted.length, signal) : null;
  return {
    records: measurements, count: counted.length, isLimited: counted.some(({ record }) => hasLimits(record)), verdicts: countVerdicts(counted),
    ppk: figures?.ppk?.value == null ? undefined : figures.ppk, stable: figures?.stable,
  };
}

/** Only two different deviations from one size with limits make figures. */
const hasSpread = (records) => records.some(hasLimits) && new Set(records.map((record) => record.deviation_um)).size > 1
  && new Set(records.map((record) => [record.nominal_mm, record.upper_limit_mm, record.lower_limit_mm].join())).size === 1;

/** Of so many of the newest values that count. Null where they have no figures all the same. */
async function figuresOf(filter, last, signal) {
  try {
    return await getJson(url(['measurements', 'capability'], { ...filter, last, set_aside: 'false', subgroups: 'ignore' }), { signal });
  } catch (problem) {
    if (problem.status === 422) return null;
    throw problem;
  }
}

export const isDoubtful = ({ count, stable }) => !stable || count < FEWEST;

const rejects = ({ count, verdicts }) => (count ? (verdicts.reject + verdicts.rework) / count : 0);

/** The worst first: by the index; without one, what has rejects stands before all, what has none behind. */
export function bySeverity(one, other) {
  const rank = (standing) => standing.ppk?.value ?? (rejects(standing) ? -Infinity : Infinity);
  const [a, b] = [rank(one), rank(other)];
  return a === b ? rejects(other) - rejects(one) : a - b;
}
