/** Individuals or means of subgroups with their control limits, the spread below, the histogram beside. */

import { s } from '../dom.js';
import { NM_PER_UM, umText } from '../exact.js';
import { number, signed, t, time } from '../i18n.js';
import { brush } from './brush.js';
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
/** Points closer than this many pixels are a line; of those that are good nothing else is drawn. */
const DENSE = 4;

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
 * @param view {from, to}: the first and the last point drawn
 * @param onPick takes the index of a point; @param onStretch the first and the last index of a stretch
 */
export function controlChartFigure(points, singles, chart, { width, view, picked, onPick, onStretch }) {
  const wide = width >= WIDE;
  const right = width - RIGHT - (wide ? HISTOGRAM : 0);
  const { from, to } = view;
  const span = right - LEFT - 24;
  const x = (i) => round(LEFT + 12 + span * (to > from ? (i - from) / (to - from) : 0.5));
  const height = HEIGHT.values + (chart ? HEIGHT.ranges : 0) + AXIS;
  const scene = { points, from, to, x, right, dense: span < DENSE * (to - from) };
  const figure = s('svg.control-chart', { viewBox: `0 0 ${width} ${height}`, role: 'img', 'aria-label': t('trend.chart', { count: to - from + 1 }) },
    values(scene, singles, chart, wide && { from: right + RIGHT, to: width - 8 }),
    chart && ranges(spreadOf(chart), scene),
    axis(scene, height),
    picked >= from && picked <= to && picked !== null && s('path.picked', { d: `M${x(picked)} ${TOP - 8}V${height - AXIS}` }));
  const indexAt = (clientX) => {
    const place = figure.getBoundingClientRect();
    const near = from + Math.round(((clientX - place.left) * width / place.width - LEFT - 12) / Math.max(span, 1) * (to - from));
    return Math.min(Math.max(near, from), to);
  };
  return brush(figure, { indexAt, top: TOP, height: height - AXIS - TOP, onPick, onStretch });
}

/** What does not change while a chart pans: {chart, range, rules, histogram}, by the points drawn. */
const kept = new WeakMap();

function keptOf(points, singles, chart) {
  const known = kept.get(points);
  if (known?.chart === chart && known.singles === singles) return known;
  const own = locationOf(chart);
  const control = own ? [own.upper_limit, own.lower_limit].map((value) => value * NM_PER_UM) : [];
  const made = { chart, singles, range: rangeOf(points, [...control, ...singles.map(({ deviation }) => deviation)]), rules: [...rulesAt(chart)], beside: {} };
  kept.set(points, made);
  return made;
}

/** The indices that are in sight. */
const sight = ({ from, to }) => Array.from({ length: to - from + 1 }, (_, i) => from + i);

/** A line through what is in sight; where it is dense, from the least to the greatest of each column of pixels. */
function runOf({ from, to, x, dense }, y) {
  if (!dense) return sight({ from, to }).map((i, n) => `${n ? 'L' : 'M'}${x(i)} ${y(i)}`).join('');
  const columns = [];
  let column = null;
  for (let i = from; i <= to; ++i) {
    const place = Math.round(x(i));
    const at = y(i);
    if (!column || column.place !== place) columns.push(column = { place, least: at, greatest: at });
    else if (at < column.least) column.least = at;
    else if (at > column.greatest) column.greatest = at;
  }
  return columns.map(({ place, least, greatest }, n) => `${n ? 'L' : 'M'}${place} ${least}V${greatest}`).join('');
}

/** What gets a mark of its own: every point; where they are dense, those that are not good, one a pixel. */
function marked({ points, from, to, x, dense }) {
  if (!dense) return sight({ from, to });
  const taken = new Set();
  const found = [];
  for (let i = from; i <= to; ++i) {
    const { verdict } = points[i].record;
    if (verdict === 'good') continue;
    const place = `${verdict} ${Math.round(x(i))}`;
    if (!taken.has(place)) found.push(i);
    taken.add(place);
  }
  return found;
}

function values(scene, singles, chart, beside) {
  const { points, x, right } = scene;
  const own = locationOf(chart);
  const ofMeans = Boolean(points[0].members);
  const known = keptOf(points, singles, chart);
  const { range } = known;
  const bottom = HEIGHT.values - 18;
  const y = (nm) => round(TOP + (bottom - TOP) * (range.high - Math.min(Math.max(nm, range.low), range.high)) / (range.high - range.low));
  const broken = known.rules.filter(([i]) => i >= scene.from && i <= scene.to);
  const at = (i) => [x(i), y(points[i].deviation)];
  const limits = [range.upper, range.lower].filter(Number.isFinite);
  const target = (range.upper + range.lower) / 2;
  return s('g',
    s('text.unit', { x: LEFT - 10, y: 12, 'text-anchor': 'end' }, 'µm'),
    !ofMeans && ['upper', 'lower'].filter((limit) => limits.includes(range[limit])).map((limit) => s('path.limit', { d: steps(scene, limit, y) })),
    limits.length === 2 && s('path.target', { d: `M${LEFT} ${y(target)}H${right}` }),
    [...limits, ...(limits.length === 2 ? [target] : [])].map((nm) => label(LEFT - 10, y(nm), signed(umText(nm)), 'end')),
    own && controlLines(own, (value) => y(value * NM_PER_UM), right, limits.map(y)),
    s('path.run', { d: runOf(scene, (i) => y(points[i].deviation)) }),
    spaced(broken, x, scene.dense ? 2 : 0).map(([i]) => s('circle.broken', { cx: at(i)[0], cy: at(i)[1], r: 9 })),
    marked(scene).map((i) => s('path.point', { d: MARKS[points[i].record.verdict], transform: `translate(${at(i).join(' ')})`, 'data-verdict': points[i].record.verdict })),
    spaced(broken, x, 18).map(([i, rules]) => s('text.rule', { x: at(i)[0], y: at(i)[1] - 13, 'text-anchor': 'middle' }, [...rules].join(','))),
    beside && histogramOf(known, y, beside, { top: TOP, bottom }));
}

/** Drawn once for a width: it is of all values, whatever is in sight. */
function histogramOf(known, y, beside, frame) {
  if (known.beside.from !== beside.from || known.beside.to !== beside.to) known.beside = { ...beside, figure: histogram(known.singles, known.range, y, beside, frame) };
  return known.beside.figure;
}

function ranges(own, scene) {
  const { points, to, x, right, dense } = scene;
  const top = HEIGHT.values + 14;
  const bottom = HEIGHT.values + HEIGHT.ranges - 8;
  const most = Math.max(own.upper_limit, ...own.points, 1e-6);
  const y = (value) => round(bottom - (bottom - top) * value / most);
  // The first value has no range: the row begins one later.
  const first = points.length - own.points.length;
  const from = Math.max(scene.from, first);
  const at = (i) => y(own.points[i - first]);
  const isOutside = (i) => own.points[i - first] > own.upper_limit;
  const shown = sight({ from, to }).filter((i) => !dense || isOutside(i));
  return s('g.ranges',
    s('text.unit', { x: LEFT - 10, y: top - 4, 'text-anchor': 'end' }, SPREADS[own.name]),
    s('path.axis', { d: `M${LEFT} ${bottom}H${right}` }),
    controlLines({ ...own, lower_limit: null }, y, right, []),
    s('path.run', { d: runOf({ from, to, x, dense }, at) }),
    shown.map((i) => s('circle', { cx: x(i), cy: at(i), r: 2.5, class: isOutside(i) ? 'outside' : 'inside' })));
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

/** Marks that would stand over each other are left out but for the first. */
function spaced(marks, x, distance) {
  let last = -Infinity;
  return marks.sort(([one], [other]) => one - other).filter(([i]) => {
    if (x(i) - last < distance) return false;
    last = x(i);
    return true;
  });
}

/** A limit as a line with a step where it changes. */
function steps({ points, from, to, x, right }, limit, y) {
  let path = `M${LEFT} ${y(points[from][limit])}`;
  for (let i = from + 1; i <= to; ++i) {
    if (points[i][limit] !== points[i - 1][limit]) path += `H${x(i)}V${y(points[i][limit])}`;
  }
  return `${path}H${right}`;
}

/** Time and part of the first, the middle and the last value. */
function axis({ points, from: first, to: last, x, right }, height) {
  const ends = right - LEFT > 420 && last - first > 4 ? [first, Math.round((first + last) / 2), last] : [...new Set([first, last])];
  return s('g.time', s('path.axis', { d: `M${LEFT} ${height - AXIS + 2}H${right}` }), ends.map((i) => {
    const at = new Date(points[i].record.measured_at);
    const day = at.toISOString().slice(5, 10);
    return s('text', { x: i === first ? LEFT : i === last ? right : x(i), y: height - 8, 'text-anchor': i === first ? 'start' : i === last ? 'end' : 'middle' },
      [points[i].record.part_id, `${day} ${time(at).slice(0, 5)}`].filter(Boolean).join(' · ').slice(-28));
  }));
}
