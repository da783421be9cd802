/** The tolerance zone as a strip with the measured value on it; beyond its ends the mark is an arrow. */

import { s } from '../dom.js';
import { boundsOf, mmText, nmFromMm } from '../exact.js';
import { number, t } from '../i18n.js';

const WIDTH = 600;
const FROM = 150;
const TO = 450;

/** @param record limits, with what was measured or without; where a limit is missing the zone has no end */
export function limitStrip(record) {
  const [lower, upper] = boundsOf(record);
  const limits = [[FROM, lower], [TO, upper]].filter(([, nm]) => Number.isFinite(nm));
  const places = Math.max(...limits.map(([, nm]) => mmText(nm).split('.')[1].length));
  const from = Number.isFinite(lower) ? FROM : 0;
  const to = Number.isFinite(upper) ? TO : WIDTH;
  return s('svg.strip', { viewBox: `0 0 ${WIDTH} 70`, role: 'img', 'aria-label': t('panel.strip') },
    s('path.axis', { d: `M0 24H${WIDTH}` }),
    s('rect.zone', { x: from, y: 12, width: to - from, height: 24 }),
    s('path.limit', { d: limits.map(([x]) => `M${x} 4V44`).join('') }),
    limits.map(([x, nm]) => s('text', { x, y: 62, 'text-anchor': 'middle' }, number(mmText(nm, places)))),
    record.measured_mm !== undefined && mark(nmFromMm(record.measured_mm), limits, nmFromMm(record.nominal_mm)));
}

const RUN = { width: 240, height: 70, inset: 8, radius: 4 };

/** The last values of a size in their order, between its limits; the newest is the larger dot. @param values exact texts in mm; null without two values or limits */
export function runStrip(values, limits) {
  const bounds = boundsOf(limits).filter(Number.isFinite);
  if (values.length < 2 || bounds.length < 2) return null;
  const [lower, upper] = bounds;
  const { width, height, inset, radius } = RUN;
  const far = (upper - lower) / 2; // what lies farther out is at the edge
  const y = (nm) => (inset + (height - 2 * inset) * (upper + far - Math.min(Math.max(nm, lower - far), upper + far)) / (2 * (upper - lower))).toFixed(1);
  const places = values.map((value, i) => [(inset + (width - 2 * inset) * i / (values.length - 1)).toFixed(1), y(nmFromMm(value))]);
  return s('svg.lately', { viewBox: `0 0 ${width} ${height}`, role: 'img', 'aria-label': t('panel.run', { count: values.length }) },
    s('rect.zone', { x: 0, y: y(upper), width, height: (height - 2 * inset) / 2 }),
    s('path.axis', { d: `M${places.map((place) => place.join(' ')).join('L')}`, fill: 'none' }),
    places.map(([cx, cy], i) => s('circle.dot', { cx, cy, r: i === places.length - 1 ? 2 * radius : radius })));
}

/** The zone between two limits is as wide as the strip has it, and so is the way from one alone to the nominal size. */
function mark(measured, [[start, first], [, last] = []], nominal) {
  const width = last === undefined ? Math.abs(first - nominal) : last - first;
  const x = start + (TO - FROM) * (measured - first) / Math.max(width, 1);
  if (x < 12) return s('path.beyond', { d: 'M2 24l16-12v24z' });
  if (x > WIDTH - 12) return s('path.beyond', { d: `M${WIDTH - 2} 24l-16-12v24z` });
  return s('circle.dot', { cx: x.toFixed(1), cy: 24, r: 10 });
}
