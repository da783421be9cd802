/** Phases of a process: each has control limits of its own, of the values that are counted. */

import { asideOf, isNoted } from './aside.js';
import { controlChart } from './figures.js';

/** What a new phase begins with: another tool, another offset, or what was done after a value that has a note. */
export const CAUSES = ['tool', 'offset', 'note'];
/** So many of the newest; what lies before them is one phase. */
const MOST = 24;

const recordsOf = ({ record, members }) => (members ? members.map((one) => one.record) : [record]);
const BEGINS = {
  tool: (before, own) => own.tool !== undefined && before.tool !== undefined && own.tool !== before.tool,
  // An offset is of the part before which it was made.
  offset: (before, own) => own.offset_um !== undefined && Number(own.offset_um) !== 0,
  note: (before) => isNoted(before),
};

/** [{from, to, why, record}] of points in order: why each begins, and the record at its beginning; the first begins for nothing. */
export function phasesOf(points, causes) {
  const found = [{ from: 0, to: points.length - 1, why: [], record: points[0]?.record }];
  for (let i = 1; causes.length && i < points.length; ++i) {
    const rows = [...recordsOf(points[i - 1]), ...recordsOf(points[i])];
    const first = rows.length - recordsOf(points[i]).length;
    const why = CAUSES.filter((cause) => causes.includes(cause) && rows.some((own, k) => k > 0 && (k >= first || cause === 'note') && BEGINS[cause](rows[k - 1], own)));
    if (!why.length) continue;
    found.at(-1).to = i - 1;
    found.push({ from: i, to: points.length - 1, why, record: recordsOf(points[i])[0] });
  }
  const late = found.slice(-MOST);
  if (late.length < found.length) late.unshift({ ...found[0], to: late[0].from - 1 });
  return late;
}

/** Whether a point is counted: a mean is of counted values alone. */
export const isCounted = ({ record, members }) => Boolean(members) || !asideOf(record);

/**
 * The charts of all phases as one: `points` of each chart has a place for each point drawn (null: none), the lines are those of the
 * newest phase, and `phases` has the lines of each. null where no phase has figures.
 * @param drawn points, or means with `members`; @param how {kind, rules, frozen} of controlChart
 */
export async function chartOfPhases(drawn, phases, { kind, rules, frozen }, signal) {
  const parts = await Promise.all(phases.map(async (phase) => {
    const at = [...Array(phase.to - phase.from + 1).keys()].map((i) => i + phase.from).filter((i) => isCounted(drawn[i]));
    const points = at.map((i) => drawn[i]);
    const groups = points[0]?.members ? points.map(({ members }) => members) : null;
    return { ...phase, at, chart: points.length ? await controlChart(points, { kind, groups, rules, frozen }, signal) : null };
  }));
  const newest = parts.filter(({ chart }) => chart).at(-1)?.chart;
  if (!newest) return null;
  const charts = newest.charts.map((own, k) => {
    const points = Array(drawn.length).fill(null);
    for (const { at, chart } of parts) {
      const values = chart?.charts[k].points ?? [];
      // A moving range begins one value later.
      values.forEach((value, i) => { points[at[at.length - values.length + i]] = value; });
    }
    return { ...own, points };
  });
  return {
    ...newest, charts, violations: parts.flatMap(({ at, chart }) => (chart?.violations ?? []).map((one) => ({ ...one, index: at[one.index] }))),
    phases: parts.map(({ from, to, why, record, at, chart }) => ({ from, to, why, record, count: at.length, charts: chart?.charts ?? null })),
  };
}
