/** Individuals or means of subgroups with their control limits, the spread below, by uPlot; the histogram beside. */

import { uPlot } from '../bundled/uplot.js';
import { h } from '../dom.js';
import { NM_PER_UM, umText } from '../exact.js';
import { dayAndMonth, number, signed, t, timeOfDay } from '../i18n.js';
import { brush } from './brush.js';
import { histogram } from './histogram.js';
import { axes, coloursOf, DENSE, inSight, marked, stepped } from './plot.js';
import { isCounted } from './phases.js';
import { eventsOf, rangeOf } from './series.js';

const TOP = 22;
const VALUES = 300;
const SPREAD = 98;
const GAP = 36;
const AXIS = 46;
const LEFT = 74;
const RIGHT = 92;
/** Values from zero and limits that an outlier has moved, of this many nm and more, have long labels. */
const LONG = { from: 1e6, right: 122 };
/** Of the outermost points from the edge. */
const INSET = 12;
const HISTOGRAM = 150;
/** Narrower figures have no histogram beside them. */
const WIDE = 620;
const LETTERING = 13;
/** Of labels from each other: of times, of control limits, of the numbers of rules with their rings. */
const APART = { time: 150, control: 14, rules: 20, beyond: 70, events: 14 };
/** Of more points in sight, a ring that stands for several says how many. */
export const CLUSTERED = 500;
const LONGEST_PART = 18;
/** Of the range, so many parts from its edge are a mark beyond it. */
const EDGE = 30;
/** A few spreads, one in so many, that are more than twice their limit do not flatten the others. An outlier makes two. */
const FEW_SPREADS = 15;
const OUTLYING = 2;

/** The inside of a sheet of A4 in CSS pixels (Letter is wider), and how many dots each of them has in print. */
export const PAPER = { width: 650, dots: 4 };

export const SPREADS = { mr: 'MR', r: 'R', s: 's' };
const DISC = 'M0-4.5a4.5 4.5 0 1 1 0 9a4.5 4.5 0 1 1 0-9z';
/** From below to above. */
const MARKS = {
  good: DISC,
  unjudged: DISC,
  rework: 'M0-7L7 6H-7z',
  indeterminate: 'M0-7.5L7.5 0 0 7.5-7.5 0z',
  reject: 'M-3-7H3L7-3V3L3 7H-3L-7 3V-3z',
};
const RING = 'M-9 0a9 9 0 1 0 18 0a9 9 0 1 0-18 0';
/** A value that is set aside. */
const CROSS = 'M-6-6L6 6M-6 6L6-6';
const DOT = 'M-2.5 0a2.5 2.5 0 1 0 5 0a2.5 2.5 0 1 0-5 0';

export const umOf = (value) => number(umText(Math.round(value * 100) * 10));
/** Within the range; what lies beyond it is seen whole at its edge. */
function clamped(value, { low, high }) {
  const inset = (high - low) / EDGE;
  return Math.min(Math.max(value, low + inset), high - inset);
}

/** A chart that is drawn once and then moves: `show` draws another stretch of it. */
export class ControlChart {
  /**
   * @param figure where it stands, with its colours
   * @param points what is drawn, one by one; means have `members`, and no limits of size, which are for single values
   * @param singles the values one by one, for the histogram
   * @param chart of the service (deviations in µm), or null
   * @param width in CSS pixels; @param dots that each of these has
   * @param onPick takes the index of a point; @param onStretch the first and the last index of a stretch
   */
  constructor(figure, points, singles, chart, { width, dots = 1, onPick, onStretch }) {
    Object.assign(this, { points, dots, colours: coloursOf(figure), rules: rulesAt(chart), font: `${LETTERING * dots}px ${getComputedStyle(figure).fontFamily}` });
    this.events = eventsOf(points);
    const [own, spread] = chart?.charts ?? [];
    const beside = width >= WIDE && HISTOGRAM;
    this.phases = chart?.phases ?? [];
    const control = (own ? [own, ...this.phases.flatMap(({ charts }) => charts?.[0] ?? [])] : []).flatMap((one) => [one.upper_limit, one.lower_limit]).map((value) => value * NM_PER_UM);
    const counted = points.filter(isCounted);
    this.range = rangeOf(counted.length ? counted : points, [...control, ...singles.map(({ deviation }) => deviation)]);
    this.right = Math.max(this.range.high, -this.range.low, ...control.map(Math.abs)) < LONG.from ? RIGHT : LONG.right;
    this.inside = width - beside - LEFT - this.right - 2 * INSET;
    const inner = VALUES + (spread ? GAP + SPREAD : 0);
    const height = TOP + inner + AXIS;
    const { high, low } = this.range;
    const values = this.#values(own);
    const spreads = spread ? this.#spreads(spread) : { most: 1, beyond: new Map(), series: [], axes: [] };
    this.spreads = spreads;
    const series = [...values.series, ...spreads.series];
    this.plot = new uPlot({
      width: (width - beside) * dots,
      height: height * dots,
      padding: [TOP * dots, 0, 0, 0],
      legend: { show: false },
      cursor: { show: false },
      // Values above, their spread below: each scale goes over the whole height.
      scales: { x: { time: false }, nm: { range: [high - (high - low) * inner / VALUES, high] }, spread: { range: [0, spreads.most * inner / SPREAD] } },
      axes: [this.#timeAxis(), ...spreads.axes, ...values.axes],
      series: [{}, ...series.map(({ data: _, ...look }) => ({ points: { show: false }, ...look }))],
      hooks: { drawAxes: [() => this.#drawPhases()], draw: [() => this.#drawOver()] },
    }, [points.map((_, i) => i), ...series.map(({ data }) => data)]);
    brush(this.plot, { onPick, onStretch });
    this.element = h('div.control-chart', { role: 'img' }, this.plot.root,
      beside && singles.length > 0 && histogram(singles, this.range, { width: beside, height, top: TOP, bottom: TOP + VALUES }));
    figure.replaceChildren(this.element);
  }

  /** Whether somebody is drawing across it. */
  get isTouched() {
    return this.plot.select.width > 0;
  }

  /** @param view {from, to}: the first and the last point drawn; @param picked the index of one, or null */
  show({ from, to }, picked) {
    this.picked = picked;
    const inset = to > from ? INSET * (to - from) / this.inside : 0.5;
    this.plot.setScale('x', { min: from - inset, max: to + inset });
    this.element.setAttribute('aria-label', t('trend.chart', { count: to - from + 1 }));
  }

  #values(own) {
    const { points, range, colours, dots, rules } = this;
    const row = { scale: 'nm', data: points.map(({ deviation }) => clamped(deviation, range)) };
    this.row = row;
    this.firsts = firstsOf(rules);
    this.beyond = [];
    const aside = [];
    const of = Object.fromEntries(Object.keys(MARKS).map((verdict) => [verdict, []]));
    points.forEach((point, i) => {
      if (point.deviation > range.high || point.deviation < range.low) this.beyond.push(i);
      (isCounted(point) ? of[point.record.verdict ?? 'unjudged'] : aside).push(i);
    });
    const sides = points[0].members ? [] : ['upper', 'lower'].filter((side) => Number.isFinite(range[side]));
    const limits = [range.upper, range.lower].filter(Number.isFinite);
    const target = limits.length === 2 ? [(range.upper + range.lower) / 2] : [];
    const { axis, line } = axes(dots, this.font, colours.soft);
    return {
      series: [
        ...sides.map((side) => stepped({ scale: 'nm', data: points.map((point) => point[side]) }, dots, { stroke: colours.ink, width: 1.5 })),
        { ...row, stroke: colours.edge, width: dots },
        marked(row, RING, this.firsts, dots, { apart: APART.rules, stroke: colours.ink, width: 1.75 }),
        ...Object.entries(MARKS).map(([verdict, shape]) => marked(row, shape, of[verdict], dots, {
          always: MARKS[verdict] !== DISC, fill: colours[verdict] ?? colours.edge, stroke: verdict === 'rework' ? colours.ink : colours.sheet })),
        marked(row, CROSS, aside, dots, { stroke: colours.soft, width: 2 }),
      ],
      axes: [
        ...(own ? this.#controlLines('nm', own, NM_PER_UM, (range.high - range.low) / VALUES, range) : []),
        line('nm', target, colours.good, 1, [10, 3, 2, 3]),
        axis({ scale: 'nm', side: 3, size: LEFT, splits: [range.high, ...limits, ...target], values: ['µm', ...limits.map((value) => `${value === range.upper ? 'U' : 'L'} ${signed(umText(value))}`), ...target.map((value) => `T ${signed(umText(value))}`)] }),
        axis({ scale: 'nm', side: 1, size: this.right }),
      ],
    };
  }

  #spreads(own) {
    const { points, colours, dots } = this;
    const uppers = this.phases.flatMap(({ charts }) => charts?.[1]?.upper_limit ?? []);
    const highest = (values, least) => values.reduce((greatest, value) => Math.max(greatest, value), least);
    const limit = highest(uppers, Math.max(own.upper_limit, 1e-6));
    const out = own.points.flatMap((value, i) => (value > OUTLYING * limit ? [[i, value]] : []));
    const beyond = out.length <= own.points.length / FEW_SPREADS ? out : [];
    const most = beyond.length ? OUTLYING * limit : highest(own.points, limit);
    const row = { scale: 'spread', data: own.points.map((value) => value && Math.min(value, most)) };
    const limitAt = (i) => this.phases.find(({ from, to }) => i >= from && i <= to)?.charts?.[1].upper_limit ?? own.upper_limit;
    const outside = own.points.flatMap((value, i) => (value !== null && value > limitAt(i) ? [i] : []));
    return {
      most,
      beyond: new Map(beyond),
      series: [
        { ...row, stroke: colours.edge, width: dots, points: { size: 5 * dots, width: 0, fill: colours.edge, space: DENSE * dots } },
        marked(row, DOT, outside, dots, { fill: colours.ink, stroke: colours.ink, width: 3 }),
      ],
      axes: [
        axes(dots, this.font, colours.soft).axis({ scale: 'spread', side: 3, splits: [most], values: [SPREADS[own.name]] }),
        ...this.#controlLines('spread', { ...own, lower_limit: null }, 1, most / SPREAD, { low: 0, high: most }),
      ],
    };
  }

  /** Centre and control limits with their values at the right; none over another, those beyond the range at its edge. @param unit of the scale in a µm */
  #controlLines(scale, { centre, upper_limit: upper, lower_limit: lower }, unit, perPixel, { low, high }) {
    const { axis, line } = axes(this.dots, this.font, this.colours.soft);
    const named = [['CL', centre], ['UCL', upper], ['LCL', lower]].filter(([, value]) => value !== null).map(([name, value]) => ({ name, value: value * unit }));
    const values = named.map(({ value }) => value);
    const inside = named.filter(({ value }) => value >= low && value <= high);
    const step = APART.control * perPixel;
    const free = inside.filter(({ value }, i) => inside.slice(0, i).every((other) => Math.abs(other.value - value) > step)).map(({ name, value }) => [value, `${name} ${umOf(value / unit)}`]);
    const at = (edge, way, sign) => ({ name, value }, i) => [edge - way * i * step, `${sign} ${name} ${number(String(Math.round(value / unit)))}`];
    const beyond = [...named.filter(({ value }) => value > high).sort((one, other) => other.value - one.value).map(at(high, 1, '▲')), ...named.filter(({ value }) => value < low).sort((one, other) => one.value - other.value).map(at(low, -1, '▼'))];
    const labels = [...free.filter(([place]) => beyond.every(([other]) => Math.abs(other - place) > step)), ...beyond];
    const { focus } = this.colours;
    const [centres, bounds] = this.phases.length > 1 ? [[], []] : [values.slice(0, 1), values.slice(1)];
    return [line(scale, centres, focus, 1.25), line(scale, bounds, focus, 1.25, [6, 4]),
      axis({ scale, side: 1, splits: labels.map(([place]) => place), values: labels.map(([, text]) => text) })];
  }

  /** Time and part. */
  #timeAxis() {
    const { points, dots, colours } = this;
    const label = (i) => {
      if (!points[i]) return null;
      const { part_id: part, measured_at: at } = points[i].record;
      const moment = new Date(at);
      return `${dayAndMonth(moment)} ${timeOfDay(moment)}${part ? `\n${part.slice(-LONGEST_PART)}` : ''}`;
    };
    return axes(dots, this.font, colours.soft).axis({
      scale: 'x', size: AXIS, space: APART.time * dots, splits: undefined, values: (plot, splits) => splits.map(label),
      border: { show: true, stroke: colours.line, width: dots },
    });
  }

  /** The lines of each phase over its own values, and where it begins. */
  #drawPhases() {
    const { plot, plot: { ctx, bbox }, dots, colours, phases } = this;
    if (phases.length < 2) return;
    const size = dots * uPlot.pxRatio;
    const { min, max } = plot.scales.x;
    ctx.save();
    Object.assign(ctx, { strokeStyle: colours.focus, fillStyle: colours.soft, lineWidth: 1.25 * size, font: plot.axes[0].font[0], textAlign: 'left', textBaseline: 'alphabetic' });
    const stroke = (dash, ...paths) => {
      ctx.setLineDash(dash.map((length) => length * size));
      for (const path of paths) ctx.stroke(new Path2D(path));
    };
    phases.forEach(({ from, to, charts }, number) => {
      if (to < min || from > max) return;
      const [left, right] = [Math.max(from - 0.5, min), Math.min(to + 0.5, max)].map((at) => plot.valToPos(at, 'x', true));
      const across = (value, scale) => { const y = plot.valToPos(value, scale, true); return `M${left} ${y}H${right}`; };
      const of = (own, scale, unit) => {
        stroke([], across(own.centre * unit, scale));
        stroke([6, 4], ...[own.upper_limit, scale === 'nm' ? own.lower_limit : null].filter((value) => value !== null).map((value) => across(value * unit, scale)));
      };
      if (charts) of(charts[0], 'nm', NM_PER_UM);
      if (charts?.[1]) of(charts[1], 'spread', 1);
      if (from > 0 && from > min) {
        stroke([2, 4], `M${left} ${bbox.top}V${bbox.top + bbox.height}`);
        ctx.fillText(String(number + 1), left + 4 * size, bbox.top - 4 * size);
      }
    });
    ctx.restore();
  }

  /** The numbers of the rules broken, the letters of what was done, and where the point stands that was picked. */
  #drawOver() {
    const { plot, plot: { ctx, bbox }, dots, colours, rules, row, picked } = this;
    const size = dots * uPlot.pxRatio;
    ctx.save();
    Object.assign(ctx, { font: plot.axes[0].font[0], textAlign: 'center', textBaseline: 'alphabetic', lineJoin: 'round', strokeStyle: colours.sheet, fillStyle: colours.ink, lineWidth: 3 * size });
    ctx.setLineDash([]);
    const write = (...text) => {
      ctx.strokeText(...text);
      ctx.fillText(...text);
    };
    const isCluster = plot.scales.x.max - plot.scales.x.min > CLUSTERED;
    for (const [i, x, count] of inSight(plot, this.firsts, APART.rules * size)) {
      write(isCluster && count > 1 ? `${count}×` : [...rules.get(i)].join(','), x, plot.valToPos(row.data[i], 'nm', true) - 13 * size);
    }
    // Marks of notes and corrections stand below their value, at the foot of the chart.
    const foot = plot.valToPos(this.range.low, 'nm', true) - 4 * size;
    for (const [i, x] of inSight(plot, this.events.keys(), APART.events * size)) write(this.events.get(i).map((name) => t(`trend.event.${name}`)).join(''), x, foot);
    // A point beyond the edge: an arrow with its distance.
    for (const [i, x] of inSight(plot, this.beyond, APART.beyond * size)) {
      const isHigh = this.points[i].deviation > this.range.high;
      write(`${isHigh ? '▲' : '▼'} ${signed(umText(Math.round(this.points[i].deviation)))}`, x, plot.valToPos(row.data[i], 'nm', true) + (isHigh ? 22 : -14) * size);
    }
    const { most, beyond } = this.spreads;
    for (const [i, x] of inSight(plot, beyond.keys(), APART.beyond * size)) write(`▲ ${umOf(beyond.get(i))}`, x, plot.valToPos(most, 'spread', true) + 16 * size);
    const x = picked === null ? NaN : plot.valToPos(picked, 'x', true);
    if (x >= bbox.left && x <= bbox.left + bbox.width) {
      Object.assign(ctx, { strokeStyle: colours.ink, lineWidth: size });
      ctx.setLineDash([2 * size, 3 * size]);
      ctx.stroke(new Path2D(`M${x} ${bbox.top - 8 * size}V${bbox.top + bbox.height}`));
    }
    ctx.restore();
  }
}

/** Where a rule begins to be broken; behind a value beyond a control limit (rule 1) the others say nothing new. */
const firstsOf = (rules) => [...rules].filter(([i, broken]) => !rules.get(i - 1)?.has(1) && [...broken].some((rule) => !rules.get(i - 1)?.has(rule))).map(([i]) => i);

/** {index: rules broken there}, in order, of the chart of the location. */
export function rulesAt(chart) {
  const broken = new Map();
  const own = (chart?.violations ?? []).filter(({ chart: where }) => where === chart.charts[0].name);
  for (const { rule, index } of own.sort((one, other) => one.index - other.index)) {
    broken.set(index, new Set([...(broken.get(index) ?? []), rule]));
  }
  return broken;
}
