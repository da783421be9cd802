/** How a characteristic stands: its newest values, their verdicts, and what the service computes of them. */

import { getJson, url } from '../api.js';
import { FEWEST } from '../trend/figures.js';
import { countVerdicts } from '../trend/series.js';

/** So many of the newest values of each. */
export const LAST = 100;

/** {count, verdicts, ppk: {value, lower, upper} or undefined, stable: undefined where the values tell nothing} */
export async function standingOf(filter, signal) {
  const [{ measurements }, figures] = await Promise.all([
    getJson(url(['measurements'], { ...filter, last: LAST }), { signal }), figuresOf(filter, signal)]);
  return {
    count: measurements.length, verdicts: countVerdicts(measurements.map((record) => ({ record }))),
    ppk: figures?.ppk?.value == null ? undefined : figures.ppk, stable: figures?.stable,
  };
}

/** Null where the values have no figures: too few, without spread, or of several sizes. */
async function figuresOf(filter, signal) {
  try {
    return await getJson(url(['measurements', 'capability'], { ...filter, last: LAST, subgroups: 'ignore' }), { signal });
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
