/** Individuals or means of subgroups with their control limits, the spread below, the histogram beside. */

import { s } from '../dom.js';
import { NM_PER_UM, umText } from '../exact.js';
import { number, signed, t, time } from '../i18n.js';
import { histogram } from './histogram.js';
import { rangeOf } from './series.js';

const HEIGHT = { values: 340, ranges: 120 };
const TOP = 22;
const AXIS = 30;
const LEFT = 58;
const RIGHT = 56;
const HISTOGRAM = 150;
/** Narrower figures have no histogram beside them. */
const WIDE = 620;

const SPREADS = { mr: 'MR', r: 'R', s: 's' };
const MARKS = {
  good: 'M0-4.5a4.5 4.5 0 1 1 0 9a4.5 4.5 0 1 1 0-9z',
  rework: 'M0-7L7 6H-7z',
  reject: 'M-3-7H3L7-3V3L3 7H-3L-7 3V-3z',
  indeterminate: 'M0-7.5L7.5 0 0 7.5-7.5 0z',
};

const round = (value) => Math.round(10 * value) / 10;
const um = (value) => number(umText(Math.round(value * 100) * 10));
/** The chart of the location comes first, that of the spread second. */
const locationOf = (chart) => chart?.charts[0];
const spreadOf = (chart) => chart?.charts[1];

/**
 * @param points what is drawn, one by one; means have `members`, and no limits of size, which are for single values
 * @param singles the values one by one, for the histogram
 * @param chart of the service (deviations in µm), or null
 * @param width in CSS pixels
 * @param onPick takes the index of a point
 */
export function controlChartFigure(points, singles, chart, { width, picked, onPick }) {
  const wide = width >= WIDE;
  const right = width - RIGHT - (wide ? HISTOGRAM : 0);
  const x = (i) => round(LEFT + 12 + (right - LEFT - 24) * (points.length > 1 ? i / (points.length - 1) : 0.5));
  const height = HEIGHT.values + (chart ? HEIGHT.ranges : 0) + AXIS;
  const pick = (event) => {
    const place = event.currentTarget.getBoundingClientRect();
    const at = (event.clientX - place.left) * width / place.width;
    const near = Math.round((at - LEFT - 12) / Math.max(right - LEFT - 24, 1) * (points.length - 1));
    onPick(Math.min(Math.max(near, 0), points.length - 1));
  };
  return s('svg.control-chart', { viewBox: `0 0 ${width} ${height}`, role: 'img', 'aria-label': t('trend.chart', { count: points.length }), onclick: pick },
    values(points, singles, chart, x, right, wide && { from: right + RIGHT, to: width - 8 }),
    chart && ranges(spreadOf(chart), points.length, x, right),
    axis(points, x, right, height),
    picked !== null && points[picked] && s('path.picked', { d: `M${x(picked)} ${TOP - 8}V${height - AXIS}` }));
}

function values(points, singles, chart, x, right, beside) {
  const own = locationOf(chart);
  const ofMeans = Boolean(points[0].members);
  const control = own ? [own.upper_limit, own.lower_limit].map((value) => value * NM_PER_UM) : [];
  const range = rangeOf(points, [...control, ...singles.map(({ deviation }) => deviation)]);
  const bottom = HEIGHT.values - 18;
  const y = (nm) => round(TOP + (bottom - TOP) * (range.high - Math.min(Math.max(nm, range.low), range.high)) / (range.high - range.low));
  const broken = rulesAt(chart);
  const at = (i) => [x(i), y(points[i].deviation)];
  return s('g',
    s('text.unit', { x: LEFT - 10, y: 12, 'text-anchor': 'end' }, 'µm'),
    !ofMeans && [s('path.limit', { d: steps(points, 'upper', x, y, right) }), s('path.limit', { d: steps(points, 'lower', x, y, right) })],
    label(LEFT - 10, y(range.upper), signed(umText(range.upper)), 'end'), label(LEFT - 10, y(range.lower), signed(umText(range.lower)), 'end'),
    own && controlLines(own, (value) => y(value * NM_PER_UM), right, [y(range.upper), y(range.lower)]),
    s('path.run', { d: points.map((_, i) => `${i ? 'L' : 'M'}${at(i).join(' ')}`).join('') }),
    [...broken].map(([i]) => s('circle.broken', { cx: at(i)[0], cy: at(i)[1], r: 9 })),
    points.map(({ record }, i) => s('path.point', { d: MARKS[record.verdict], transform: `translate(${at(i).join(' ')})`, 'data-verdict': record.verdict })),
    spaced([...broken], x).map(([i, rules]) => s('text.rule', { x: at(i)[0], y: at(i)[1] - 13, 'text-anchor': 'middle' }, [...rules].join(','))),
    beside && histogram(singles, range, y, beside, { top: TOP, bottom }));
}

function ranges(own, count, x, right) {
  const top = HEIGHT.values + 14;
  const bottom = HEIGHT.values + HEIGHT.ranges - 8;
  const most = Math.max(own.upper_limit, ...own.points, 1e-6);
  const y = (value) => round(bottom - (bottom - top) * value / most);
  // The first value has no range: the row begins one later.
  const first = count - own.points.length;
  return s('g.ranges',
    s('text.unit', { x: LEFT - 10, y: top - 4, 'text-anchor': 'end' }, SPREADS[own.name]),
    s('path.axis', { d: `M${LEFT} ${bottom}H${right}` }),
    controlLines({ ...own, lower_limit: null }, y, right, []),
    s('path.run', { d: own.points.map((value, i) => `${i ? 'L' : 'M'}${x(i + first)} ${y(value)}`).join('') }),
    own.points.map((value, i) => s('circle', { cx: x(i + first), cy: y(value), r: 2.5, class: value > own.upper_limit ? 'outside' : 'inside' })));
}

/** Centre and control limits with their values at the right; none over another. */
function controlLines(own, y, right, taken) {
  const lines = [['centre', own.centre], ['control', own.upper_limit], ['control', own.lower_limit]].filter(([, value]) => value !== null);
  const places = [];
  return lines.map(([name, value]) => {
    const at = y(value);
    const free = places.every((other) => Math.abs(other - at) > 12);
    if (free) places.push(at);
    return [s(`path.${name}`, { d: `M${LEFT} ${at}H${right}` }), free && label(right + 4, at, um(value), 'start')];
  });
}

const label = (x, y, text, anchor) => s('text', { x, y: y + 4.5, 'text-anchor': anchor }, text);

/** {index: rules broken there} of the chart of the location. */
export function rulesAt(chart) {
  const name = locationOf(chart)?.name;
  const broken = new Map();
  for (const { chart: where, rule, index } of chart?.violations ?? []) {
    if (where === name) broken.set(index, new Set([...(broken.get(index) ?? []), rule]));
  }
  return broken;
}

/** Numbers that would stand over each other are left out but for the first. */
function spaced(marks, x) {
  let last = -Infinity;
  return marks.sort(([one], [other]) => one - other).filter(([i]) => {
    if (x(i) - last < 18) return false;
    last = x(i);
    return true;
  });
}

/** A limit as a line with a step where it changes. */
function steps(points, limit, x, y, right) {
  const lines = points.map((point, i) => (i ? `H${x(i)}V${y(point[limit])}` : `M${LEFT} ${y(point[limit])}`));
  return `${lines.join('')}H${right}`;
}

/** Time and part of the first, the middle and the last value. */
function axis(points, x, right, height) {
  const last = points.length - 1;
  const ends = right - LEFT > 420 && last > 4 ? [0, Math.round(last / 2), last] : [...new Set([0, last])];
  return s('g.time', s('path.axis', { d: `M${LEFT} ${height - AXIS + 2}H${right}` }), ends.map((i) => {
    const at = new Date(points[i].record.measured_at);
    const day = at.toISOString().slice(5, 10);
    return s('text', { x: i === 0 ? LEFT : i === last ? right : x(i), y: height - 8, 'text-anchor': i === 0 ? 'start' : i === last ? 'end' : 'middle' },
      [points[i].record.part_id, `${day} ${time(at).slice(0, 5)}`].filter(Boolean).join(' · ').slice(-28));
  }));
}
