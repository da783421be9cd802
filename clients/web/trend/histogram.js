/** The values by size, lying beside the chart on its scale, with the normal curve of their mean and spread. */

import { s } from '../dom.js';
import { statisticsOf } from './series.js';

/** Bars over one tolerance. */
const BARS = 12;
const STEPS = 48;

export function histogram(points, range, y, { from, to }, { top, bottom }) {
  const bar = Math.max((range.upper - range.lower) / BARS, 1);
  const counts = new Map();
  for (const { deviation } of points) {
    const near = Math.min(Math.max(deviation, range.low), range.high);
    const index = Math.floor((near - range.lower) / bar);
    counts.set(index, (counts.get(index) ?? 0) + 1);
  }
  const { mean, deviation } = statisticsOf(points);
  const peak = points.length * bar / (deviation * Math.sqrt(2 * Math.PI));
  const most = Math.max(...counts.values(), Number.isFinite(peak) ? peak : 0);
  const x = (count) => Math.round(10 * (from + (to - from) * count / most)) / 10;
  return s('g.histogram',
    s('path.axis', { d: `M${from} ${top}V${bottom}` }),
    s('path.limit', { d: `M${from} ${y(range.upper)}H${to}M${from} ${y(range.lower)}H${to}` }),
    [...counts].map(([index, count]) => {
      const start = y(range.lower + (index + 1) * bar);
      return s('rect', { x: from, y: start + 0.5, width: x(count) - from, height: Math.max(y(range.lower + index * bar) - start - 1, 1) });
    }),
    deviation > 0 && s('path.curve', { d: curve((nm) => x(peak * Math.exp(-0.5 * ((nm - mean) / deviation) ** 2)), y, range) }));
}

const curve = (x, y, { low, high }) => Array.from({ length: STEPS + 1 }, (_, i) => {
  const nm = low + (high - low) * i / STEPS;
  return `${i ? 'L' : 'M'}${x(nm)} ${y(nm)}`;
}).join('');
