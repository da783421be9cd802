/** The least and the greatest clearance on one line; left of zero it is interference. */

import { s } from '../dom.js';
import { NM_PER_UM, nmFromUm, umText } from '../exact.js';
import { signed, t } from '../i18n.js';

const WIDEST = 720;
const MARGIN = 60;

/** @param actual clearance of the measured pair in nm, or NaN; @param available width in CSS pixels */
export function clearanceBar(fit, actual, available) {
  const width = Math.max(Math.min(available, WIDEST), 300);
  const [from, to] = [MARGIN, width - MARGIN];
  const least = nmFromUm(fit.min_clearance_um);
  const most = nmFromUm(fit.max_clearance_um);
  const ends = [0, least, most, ...(Number.isFinite(actual) ? [actual] : [])];
  const low = Math.min(...ends);
  const reach = Math.max(Math.max(...ends) - low, NM_PER_UM);
  const x = (nm) => Math.round((from + (to - from) * (nm - low) / reach) * 10) / 10;
  const part = (name, start, end) => end > start && s(`rect.${name}`, { x: x(start), y: 34, width: x(end) - x(start), height: 24 });
  const label = (nm, y) => s('text.um', { x: x(nm), y, 'text-anchor': 'middle' }, signed(umText(nm)));
  return s('svg.clearance', { viewBox: `0 0 ${width} 96`, role: 'img', 'aria-label': t('fit.clearance_figure') },
    s('path.zero', { d: `M${from - 30} 46H${to + 30}` }),
    part('interference', least, Math.min(most, 0)), part('play', Math.max(least, 0), most),
    s('path.zero', { d: `M${x(0)} 24V68` }),
    label(least, 24), least !== most && label(most, 24),
    least !== 0 && most !== 0 && s('text.soft', { x: x(0), y: 86, 'text-anchor': 'middle' }, '0'),
    Number.isFinite(actual) && s('g.measured', s('circle', { cx: x(actual), cy: 46, r: 8 }), label(actual, 86)));
}
