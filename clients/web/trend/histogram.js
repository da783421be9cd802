/** The values by size, lying beside the chart on its scale, with the normal curve of their mean and spread. */

import { s } from '../dom.js';
import { statisticsOf } from './series.js';

/** Bars over one tolerance. */
const BARS = 12;
const STEPS = 48;
const MARGIN = 8;

const round = (value) => Math.round(10 * value) / 10;

/** @param top, bottom where the high and the low end of the range stand in the figure, in CSS pixels */
export function histogram(points, range, { width, height, top, bottom }) {
  const { high, low } = range;
  const limits = [range.upper, range.lower].filter(Number.isFinite);
  const bar = Math.max(limits.length === 2 ? (range.upper - range.lower) / BARS : (high - low) / (2 * BARS), 1);
  const base = Number.isFinite(range.lower) ? range.lower : low;
  const counts = new Map();
  for (const { deviation } of points) {
    const near = Math.min(Math.max(deviation, low), high);
    const index = Math.floor((near - base) / bar);
    counts.set(index, (counts.get(index) ?? 0) + 1);
  }
  const { mean, deviation } = statisticsOf(points);
  const peak = points.length * bar / (deviation * Math.sqrt(2 * Math.PI));
  const most = Math.max(...counts.values(), Number.isFinite(peak) ? peak : 0);
  const x = (count) => round((width - MARGIN) * count / most);
  const y = (nm) => round(top + (bottom - top) * (high - Math.min(Math.max(nm, low), high)) / (high - low));
  const curve = Array.from({ length: STEPS + 1 }, (_, i) => {
    const nm = low + (high - low) * i / STEPS;
    return `${x(peak * Math.exp(-0.5 * ((nm - mean) / deviation) ** 2))} ${y(nm)}`;
  });
  return s('svg.histogram', { width, height },
    s('path.axis', { d: `M0 ${top}V${bottom}` }),
    s('path.limit', { d: limits.map((nm) => `M0 ${y(nm)}H${width - MARGIN}`).join('') }),
    [...counts].map(([index, count]) => {
      const start = y(base + (index + 1) * bar);
      return s('rect', { y: start + 0.5, width: x(count), height: Math.max(y(base + index * bar) - start - 1, 1) });
    }),
    deviation > 0 && s('path.curve', { d: `M${curve.join('L')}` }));
}
