/** What a trend shows: deviations in nm with their limits, the newest last. */

import { nmFromMm, NM_PER_UM, umText } from '../exact.js';
import { VERDICTS } from '../verdict.js';
import { isNoted } from './aside.js';

/** Values farther out than this many tolerances are drawn at the edge. */
const FARTHEST = 3;
/** A few values, one in so many, that lie beyond half a tolerance outside do not flatten the others: they are at the edge too. */
const FEW = 30;
const OUTSIDE = 0.5;

export const hasLimits = ({ upper_deviation_um: upper, lower_deviation_um: lower }) => upper !== undefined || lower !== undefined;

/** What a record was measured against: a size and class, the limits of a drawing, or a nominal size alone, if any. */
export const sizeOf = (record) => record.designation ?? (hasLimits(record)
  ? `${record.nominal_mm} ${[record.upper_deviation_um, record.lower_deviation_um].map((um = '–') => (um > 0 ? `+${um}` : um)).join('/')} µm` : `${record.nominal_mm ?? '–'} mm`);
export const isDesignation = (size) => !/ [mµ]m$/.test(size);

/** In µm; of a value without a nominal size, from zero. */
export const deviationOf = (record) => record.deviation_um ?? umText(nmFromMm(record.measured_mm));

/** A deviation in µm is a decimal of whole nanometres. */
const nmOf = (um) => Math.round(um * NM_PER_UM);

/** A limit that a drawing does not have is infinite. */
export const pointOf = (record) => ({ record, deviation: nmOf(deviationOf(record)), upper: nmOf(record.upper_deviation_um ?? Infinity), lower: nmOf(record.lower_deviation_um ?? -Infinity) });

/**
 * Points by their subgroup, in order: {groups, left}. Groups of another size than most, such as one that is
 * still being measured or was cut at the beginning, are left out.
 */
export function subgroupsOf(points) {
  const named = new Map();
  for (const point of points) {
    const { subgroup } = point.record;
    if (subgroup) named.set(subgroup, [...(named.get(subgroup) ?? []), point]);
  }
  const sizes = new Map();
  for (const { length } of named.values()) if (length > 1) sizes.set(length, (sizes.get(length) ?? 0) + 1);
  const [size] = [...sizes].sort(([one, few], [other, many]) => many - few || other - one)[0] ?? [];
  const groups = [...named.values()].filter(({ length }) => length === size);
  return { groups, left: points.length - groups.length * (size ?? 0) };
}

/** A subgroup as one point: its mean, with the verdict that is worst in it. */
export function meanPoint(members) {
  const worst = ['reject', 'rework', 'indeterminate', 'good'].find((word) => members.some(({ record }) => record.verdict === word));
  const last = members.at(-1);
  return {
    ...last, members, deviation: members.reduce((sum, { deviation }) => sum + deviation, 0) / members.length,
    record: { ...last.record, part_id: last.record.subgroup, verdict: worst },
  };
}

/** What may have been done at a value, or before it: another tool. A mean has what was done at any of its values. */
export const EVENTS = ['note', 'correction', 'tool'];
const HAS = {
  note: isNoted, correction: (record) => record.correction_of !== undefined,
  tool: (record, before) => record.tool !== undefined && before?.tool !== undefined && record.tool !== before.tool,
};

const knownEvents = new WeakMap();
/** {index: names of events}, in order; found once for the points of a drawing. */
export function eventsOf(points) {
  if (knownEvents.has(points)) return knownEvents.get(points);
  const found = new Map();
  knownEvents.set(points, found);
  let before;
  points.forEach((point, i) => {
    let names = null;
    for (const { record } of point.members ?? [point]) {
      for (const name of EVENTS) if (HAS[name](record, before)) (names ??= new Set()).add(name);
      before = record;
    }
    if (names) found.set(i, EVENTS.filter((name) => names.has(name)));
  });
  return found;
}

/** The range of the vertical axis, with the limits, which may be infinite. @param others values in nm that are to be seen too */
export function rangeOf(points, others = []) {
  let [upper, lower] = [-Infinity, Infinity];
  for (const point of points) {
    upper = Math.max(upper, point.upper);
    lower = Math.min(lower, point.lower);
  }
  const limits = [lower, upper].filter(Number.isFinite);
  const tolerance = Math.max(limits.length === 2 ? upper - lower : Math.abs(limits[0] ?? 0), 1);
  const isOut = ({ deviation }) => deviation > upper + OUTSIDE * tolerance || deviation < lower - OUTSIDE * tolerance;
  const out = points.filter(isOut).length;
  const isFew = out > 0 && out <= points.length / FEW;
  const most = (isFew ? OUTSIDE : FARTHEST) * tolerance;
  let [high, low] = [Math.max(...limits), Math.min(...limits)];
  const widen = (deviation) => {
    const near = Math.min(Math.max(deviation, lower - most), upper + most);
    high = Math.max(high, near);
    low = Math.min(low, near);
  };
  for (const { deviation } of points) widen(deviation);
  others.forEach(widen);
  const margin = Math.max((high - low) / 12, 1);
  return { high: high + margin, low: low - margin, upper, lower };
}

export function countVerdicts(points) {
  const counts = Object.fromEntries([...VERDICTS, 'unjudged'].map((verdict) => [verdict, 0]));
  for (const { record } of points) ++counts[record.verdict ?? 'unjudged'];
  return counts;
}

/** Mean and standard deviation in nm; for the eye, so plain numbers do. */
export function statisticsOf(points) {
  const mean = points.reduce((sum, { deviation }) => sum + deviation, 0) / points.length;
  const squares = points.reduce((sum, { deviation }) => sum + (deviation - mean) ** 2, 0);
  return { mean, deviation: points.length > 1 ? Math.sqrt(squares / (points.length - 1)) : NaN };
}
