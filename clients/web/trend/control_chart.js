/** Individuals or means of subgroups with their control limits, the spread below, the histogram beside. */

import { s } from '../dom.js';
import { NM_PER_UM, umText } from '../exact.js';
import { number, signed, t } from '../i18n.js';
import { brush } from './brush.js';
import { histogram } from './histogram.js';
import { axisLabels, lineOf, Pool, Sight, spaced, stepsOf } from './plot.js';
import { rangeOf } from './series.js';

const HEIGHT = { values: 340, ranges: 120 };
const TOP = 22;
const BOTTOM = HEIGHT.values - 18;
const RANGES_TOP = HEIGHT.values + 14;
const RANGES_BOTTOM = HEIGHT.values + HEIGHT.ranges - 8;
const AXIS = 30;
const LEFT = 58;
const INSET = 12;
const RIGHT = 56;
const HISTOGRAM = 150;
/** Narrower figures have no histogram beside them. */
const WIDE = 620;
/** Rings closer than this many pixels are one where points are dense; numbers of rules always. */
const NEAR = { rings: 2, rules: 18 };

const SPREADS = { mr: 'MR', r: 'R', s: 's' };
const MARKS = {
  good: 'M0-4.5a4.5 4.5 0 1 1 0 9a4.5 4.5 0 1 1 0-9z',
  rework: 'M0-7L7 6H-7z',
  reject: 'M-3-7H3L7-3V3L3 7H-3L-7 3V-3z',
  indeterminate: 'M0-7.5L7.5 0 0 7.5-7.5 0z',
};
const RING = 'm-9 0a9 9 0 1 0 18 0a9 9 0 1 0-18 0';

const round = (value) => Math.round(10 * value) / 10;
const um = (value) => number(umText(Math.round(value * 100) * 10));
/** The chart of the location comes first, that of the spread second. */
const locationOf = (chart) => chart?.charts[0];
const spreadOf = (chart) => chart?.charts[1];

/**
 * A chart that is drawn once and then moves: `show` changes nothing but what another stretch changes.
 * Where points are dense they are a line, one stroke a column of pixels, and only those that are not good are marked.
 */
export class ControlChart {
  /**
   * @param points what is drawn, one by one; means have `members`, and no limits of size, which are for single values
   * @param singles the values one by one, for the histogram
   * @param chart of the service (deviations in µm), or null
   * @param width in CSS pixels
   * @param onPick takes the index of a point; @param onStretch the first and the last index of a stretch
   */
  constructor(points, singles, chart, { width, onPick, onStretch }) {
    Object.assign(this, { points, chart, width });
    const wide = width >= WIDE;
    const own = locationOf(chart);
    const control = own ? [own.upper_limit, own.lower_limit].map((value) => value * NM_PER_UM) : [];
    this.right = width - RIGHT - (wide ? HISTOGRAM : 0);
    this.height = HEIGHT.values + (chart ? HEIGHT.ranges : 0) + AXIS;
    this.range = rangeOf(points, [...control, ...singles.map(({ deviation }) => deviation)]);
    this.deviations = Float64Array.from(points, ({ deviation }) => deviation);
    this.rules = [...rulesAt(chart)].sort(([one], [other]) => one - other);
    this.limits = points[0].members ? [] : ['upper', 'lower'].filter((limit) => Number.isFinite(this.range[limit]))
      .map((limit) => ({ limit, path: s('path.limit') }));
    this.run = s('path.run');
    this.rings = new Pool('path.broken');
    this.marks = new Pool('path.point');
    this.numbers = new Pool('text.rule', { 'text-anchor': 'middle' });
    this.times = new Pool('text');
    this.picked = s('path.picked');
    this.element = s('svg.control-chart', { viewBox: `0 0 ${width} ${this.height}`, role: 'img' },
      this.#values(own, wide && histogram(singles, this.range, (nm) => this.#y(nm), { from: this.right + RIGHT, to: width - 8 }, { top: TOP, bottom: BOTTOM })),
      chart && this.#ranges(spreadOf(chart)),
      s('g.time', s('path.axis', { d: `M${LEFT} ${this.height - AXIS + 2}H${this.right}` }), this.times.element), this.picked);
    brush(this.element, { indexAt: (clientX) => this.#indexAt(clientX), top: TOP, height: this.height - AXIS - TOP, onPick, onStretch });
  }

  /** Whether this is what would be drawn of these. */
  isOf(points, chart, width) {
    return this.points === points && this.chart === chart && this.width === width;
  }

  /** @param view {from, to}: the first and the last point drawn; @param picked the index of one, or null */
  show({ from, to }, picked) {
    const sight = new Sight({ from, to, left: LEFT + INSET, right: this.right - INSET });
    this.sight = sight;
    const y = (nm) => this.#y(nm);
    const placed = (i) => [sight.x(i), y(this.deviations[i])];
    const broken = this.rules.filter(([i]) => i >= from && i <= to);
    this.element.setAttribute('aria-label', t('trend.chart', { count: to - from + 1 }));
    for (const { limit, path } of this.limits) path.setAttribute('d', stepsOf(this.points, sight, limit, y, LEFT, this.right));
    this.run.setAttribute('d', lineOf(sight, this.deviations, y));
    this.rings.show(broken.length ? [spaced(broken, sight, sight.dense ? NEAR.rings : 0)] : [], (all, path) =>
      path({ d: all.map(([i]) => `M${placed(i).join(' ')}${RING}`).join('') }));
    this.marks.show(this.#marked(sight), (i, mark) => {
      const { verdict } = this.points[i].record;
      mark({ transform: `translate(${placed(i).join(' ')})`, 'data-verdict': verdict, d: MARKS[verdict] });
    });
    this.numbers.show(spaced(broken, sight, NEAR.rules), ([i, rules], text) => {
      const [x, at] = placed(i);
      text({ x, y: at - 13 }, [...rules].join(','));
    });
    this.#showRanges(sight);
    this.times.show(axisLabels(this.points, sight, LEFT, this.right), ([x, anchor, said], text) =>
      text({ x, y: this.height - 8, 'text-anchor': anchor }, said));
    const isSeen = picked !== null && picked >= from && picked <= to;
    this.picked.setAttribute('d', isSeen ? `M${sight.x(picked)} ${TOP - 8}V${this.height - AXIS}` : '');
  }

  #y(nm) {
    const { high, low } = this.range;
    return round(TOP + (BOTTOM - TOP) * (high - Math.min(Math.max(nm, low), high)) / (high - low));
  }

  #indexAt(clientX) {
    const place = this.element.getBoundingClientRect();
    return this.sight.indexAt((clientX - place.left) * this.width / place.width);
  }

  /** What gets a mark of its own: every point; where they are dense, those that are not good, one a pixel. */
  #marked(sight) {
    if (!sight.dense) return sight.indices();
    const taken = {};
    const found = [];
    for (let i = sight.from; i <= sight.to; ++i) {
      const { verdict } = this.points[i].record;
      if (verdict === 'good') continue;
      const column = Math.round(sight.x(i));
      if (taken[verdict] !== column) found.push(i);
      taken[verdict] = column;
    }
    return found;
  }

  #values(own, beside) {
    const { range, right } = this;
    const limits = [range.upper, range.lower].filter(Number.isFinite);
    const target = (range.upper + range.lower) / 2;
    const both = limits.length === 2;
    return s('g', s('text.unit', { x: LEFT - 10, y: 12, 'text-anchor': 'end' }, 'µm'),
      this.limits.map(({ path }) => path),
      both && s('path.target', { d: `M${LEFT} ${this.#y(target)}H${right}` }),
      [...limits, ...(both ? [target] : [])].map((nm) => label(LEFT - 10, this.#y(nm), signed(umText(nm)), 'end')),
      own && controlLines(own, (value) => this.#y(value * NM_PER_UM), right),
      this.run, this.rings.element, this.marks.element, this.numbers.element, beside);
  }

  #ranges(own) {
    const most = own.points.reduce((greatest, value) => Math.max(greatest, value), Math.max(own.upper_limit, 1e-6));
    const y = (value) => round(RANGES_BOTTOM - (RANGES_BOTTOM - RANGES_TOP) * value / most);
    // The first value has no range: the row begins one later.
    this.spread = { own, y, first: this.points.length - own.points.length, run: s('path.run'), dots: new Pool('circle', { r: 2.5 }) };
    this.spread.values = Float64Array.from({ length: this.points.length }, (_, i) => own.points[i - this.spread.first] ?? NaN);
    return s('g.ranges', s('text.unit', { x: LEFT - 10, y: RANGES_TOP - 4, 'text-anchor': 'end' }, SPREADS[own.name]),
      s('path.axis', { d: `M${LEFT} ${RANGES_BOTTOM}H${this.right}` }),
      controlLines({ ...own, lower_limit: null }, y, this.right), this.spread.run, this.spread.dots.element);
  }

  #showRanges(sight) {
    if (!this.spread) return;
    const { own, y, first, run, dots, values } = this.spread;
    const seen = sight.since(first);
    run.setAttribute('d', lineOf(seen, values, y));
    const isOutside = (i) => values[i] > own.upper_limit;
    dots.show(seen.indices(sight.dense ? isOutside : () => true), (i, dot) => dot({ cx: seen.x(i), cy: y(values[i]), class: isOutside(i) ? 'outside' : 'inside' }));
  }
}

/** Centre and control limits with their values at the right; none over another. */
function controlLines(own, y, right) {
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
