/** The values by size, lying beside the chart on its scale, with the normal curve of their mean and spread. */

import { s } from '../dom.js';
import { statisticsOf } from './series.js';

/** Bars over one tolerance. */
const BARS = 12;
const STEPS = 48;

export function histogram(points, range, y, { from, to }, { top, bottom }) {
  const limits = [range.upper, range.lower].filter(Number.isFinite);
  const bar = Math.max(limits.length === 2 ? (range.upper - range.lower) / BARS : (range.high - range.low) / (2 * BARS), 1);
  const base = Number.isFinite(range.lower) ? range.lower : range.low;
  const counts = new Map();
  for (const { deviation } of points) {
    const near = Math.min(Math.max(deviation, range.low), range.high);
    const index = Math.floor((near - base) / bar);
    counts.set(index, (counts.get(index) ?? 0) + 1);
  }
  const { mean, deviation } = statisticsOf(points);
  const peak = points.length * bar / (deviation * Math.sqrt(2 * Math.PI));
  const most = Math.max(...counts.values(), Number.isFinite(peak) ? peak : 0);
  const x = (count) => Math.round(10 * (from + (to - from) * count / most)) / 10;
  return s('g.histogram',
    s('path.axis', { d: `M${from} ${top}V${bottom}` }),
    s('path.limit', { d: limits.map((nm) => `M${from} ${y(nm)}H${to}`).join('') }),
    [...counts].map(([index, count]) => {
      const start = y(base + (index + 1) * bar);
      return s('rect', { x: from, y: start + 0.5, width: x(count) - from, height: Math.max(y(base + index * bar) - start - 1, 1) });
    }),
    deviation > 0 && s('path.curve', { d: curve((nm) => x(peak * Math.exp(-0.5 * ((nm - mean) / deviation) ** 2)), y, range) }));
}

const curve = (x, y, { low, high }) => Array.from({ length: STEPS + 1 }, (_, i) => {
  const nm = low + (high - low) * i / STEPS;
  return `${i ? 'L' : 'M'}${x(nm)} ${y(nm)}`;
}).join('');
