/** The tolerance zone as a strip with the measured value on it; beyond its ends the mark is an arrow. */

import { s } from '../dom.js';
import { mmText, nmFromMm } from '../exact.js';
import { number, t } from '../i18n.js';

const WIDTH = 600;
const FROM = 150;
const TO = 450;

export function limitStrip(record) {
  const lower = nmFromMm(record.lower_limit_mm);
  const upper = nmFromMm(record.upper_limit_mm);
  const places = Math.max(...[lower, upper].map((nm) => mmText(nm).split('.')[1].length));
  const label = (x, nm) => s('text', { x, y: 62, 'text-anchor': 'middle' }, number(mmText(nm, places)));
  return s('svg.strip', { viewBox: `0 0 ${WIDTH} 70`, role: 'img', 'aria-label': t('panel.strip') },
    s('path.axis', { d: `M0 24H${WIDTH}` }),
    s('rect.zone', { x: FROM, y: 12, width: TO - FROM, height: 24 }),
    s('path.limit', { d: `M${FROM} 4V44M${TO} 4V44` }),
    label(FROM, lower), label(TO, upper),
    record.measured_mm !== undefined && mark(nmFromMm(record.measured_mm), lower, upper));
}

function mark(measured, lower, upper) {
  const x = FROM + (TO - FROM) * (measured - lower) / Math.max(upper - lower, 1);
  if (x < 12) return s('path.beyond', { d: 'M2 24l16-12v24z' });
  if (x > WIDTH - 12) return s('path.beyond', { d: `M${WIDTH - 2} 24l-16-12v24z` });
  return s('circle.dot', { cx: x.toFixed(1), cy: 24, r: 10 });
}
