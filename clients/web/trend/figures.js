/** What the service computes of a row of values: control chart, rules, capability. */

import { request, url } from '../api.js';
import { Decimal } from '../exact.js';
import { deviationOf, hasLimits } from './series.js';

const RULES = [1, 2, 3, 4];
/** Below this many values an index says little (Q-DAS and AIAG ask for 25 subgroups and more). */
export const FEWEST = 25;

const post = async (what, body, signal) => (await request('POST', url(['statistics', what]), { body, signal })).json();

/** A limit that a drawing does not have is not sent. */
const decimal = (um) => (um === undefined ? undefined : new Decimal(String(um)));

/** Deviations in µm as the service printed them: nothing is rounded on the way. One text, as there may be 100,000. */
const valuesOf = (points) => new Decimal(`[${points.map(({ record }) => deviationOf(record)).join()}]`);

/** Values one by one, or subgroup by subgroup where `groups` are given. */
const dataOf = (points, groups) => (groups ? { subgroups: groups.map(valuesOf) } : { values: valuesOf(points) });

/**
 * The charts of a kind (i_mr, xbar_r, xbar_s), with the violations of the rules chosen.
 * @param groups of points, all of one size; null for individuals
 * @param frozen {centre, standard_deviation} in µm of an earlier stretch, or null
 * @returns null for fewer than two values, or where they do not differ
 */
export async function controlChart(points, { kind, groups = null, rules = RULES, frozen = null }, signal) {
  if ((groups ?? points).length < 2) return null;
  const known = frozen && { centre: frozen.centre, standard_deviation: frozen.standard_deviation };
  return orNull(post('chart', { kind, ...dataOf(points, groups), rules, ...known }, signal));
}

/** Cp, Cpk, Pp, Ppk with their intervals; null where they have no meaning: no limits, or others among the values, too few of them, or no spread. */
export async function capability(points, groups, signal) {
  const [{ record }] = points;
  const same = points.every(({ upper, lower }) => upper === points[0].upper && lower === points[0].lower);
  const isEqual = points.every(({ deviation }) => deviation === points[0].deviation);
  if (!hasLimits(record) || !same || isEqual || (groups ?? points).length < 2) return null;
  return orNull(post('capability', {
    ...dataOf(points, groups), lower: decimal(record.lower_deviation_um), upper: decimal(record.upper_deviation_um),
  }, signal));
}

/** Values without spread have no figures; that is no error of the page. */
async function orNull(answer) {
  try {
    return await answer;
  } catch (problem) {
    if (problem.status === 422) return null;
    throw problem;
  }
}
