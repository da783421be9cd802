/** The values in the order they came, between their limits, with the histogram beside them. */

import { s } from '../dom.js';
import { umText } from '../exact.js';
import { signed, t } from '../i18n.js';
import { rangeOf } from './series.js';

const HEIGHT = 380;
const TOP = 16;
const BOTTOM = 356;
const LEFT = 64;
const HISTOGRAM = 150;
/** Bars of the histogram over one tolerance. */
const BARS = 12;

const MARKS = {
  good: 'M0-4.5a4.5 4.5 0 1 1 0 9a4.5 4.5 0 1 1 0-9z',
  rework: 'M0-7L7 6H-7z',
  reject: 'M-3-7H3L7-3V3L3 7H-3L-7 3V-3z',
  indeterminate: 'M0-7.5L7.5 0 0 7.5-7.5 0z',
};

export function runChart(points, width) {
  const range = rangeOf(points);
  const y = (nm) => Math.round(10 * (TOP + (BOTTOM - TOP) * (range.high - Math.min(Math.max(nm, range.low), range.high)) / (range.high - range.low))) / 10;
  const right = width - HISTOGRAM - 24;
  const x = (i) => Math.round(10 * (LEFT + 12 + (right - LEFT - 24) * (points.length > 1 ? i / (points.length - 1) : 0.5))) / 10;
  const label = (nm, name) => s('text', { class: name, x: LEFT - 10, y: y(nm) + 5, 'text-anchor': 'end' }, signed(umText(nm)));
  return s('svg.run-chart', { viewBox: `0 0 ${width} ${HEIGHT}`, width, height: HEIGHT, role: 'img', 'aria-label': t('trend.chart', { count: points.length }) },
    s('path.limit', { d: steps(points, 'upper', x, y) }), s('path.limit', { d: steps(points, 'lower', x, y) }),
    range.low <= 0 && range.high >= 0 && range.upper && range.lower && s('path.zero', { d: `M${LEFT} ${y(0)}H${right}` }),
    label(range.upper), label(range.lower),
    s('path.run', { d: points.map(({ deviation }, i) => `${i ? 'L' : 'M'}${x(i)} ${y(deviation)}`).join('') }),
    points.map(({ record, deviation }, i) => s('path.point', {
      d: MARKS[record.verdict], transform: `translate(${x(i)} ${y(deviation)})`, 'data-verdict': record.verdict,
    })),
    histogram(points, range, y, right + 24, width));
}

/** A limit as a line with a step where it changes. */
function steps(points, limit, x, y) {
  const lines = points.map((point, i) => (i ? `H${x(i)}V${y(point[limit])}` : `M${LEFT} ${y(point[limit])}`));
  return `${lines.join('')}H${x(points.length - 1) + 12}`;
}

function histogram(points, range, y, from, to) {
  const bar = Math.max((range.upper - range.lower) / BARS, 1);
  const counts = new Map();
  for (const { deviation } of points) {
    const near = Math.min(Math.max(deviation, range.low), range.high);
    const index = Math.floor((near - range.lower) / bar);
    counts.set(index, (counts.get(index) ?? 0) + 1);
  }
  const most = Math.max(...counts.values());
  return s('g.histogram',
    s('path.axis', { d: `M${from} ${TOP}V${BOTTOM}` }),
    s('path.limit', { d: `M${from} ${y(range.upper)}H${to}M${from} ${y(range.lower)}H${to}` }),
    [...counts].map(([index, count]) => {
      const top = y(range.lower + (index + 1) * bar);
      return s('rect', { x: from, y: top + 0.5, width: Math.round((to - from) * count / most), height: Math.max(y(range.lower + index * bar) - top - 1, 1) });
    }));
}
