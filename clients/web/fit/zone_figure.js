/** The tolerance zones of a hole and a shaft about the zero line, deviations in µm (ISO 286-1). */

import { s } from '../dom.js';
import { NM_PER_UM, nmFromMm, nmFromUm, umText } from '../exact.js';
import { number, signed, t } from '../i18n.js';

const WIDTH = 720;
const HEIGHT = 400;
const TOP = 40;
const BOTTOM = 360;
const ZONES = { hole: { x: 150, width: 180 }, shaft: { x: 390, width: 180 } };
/** A measured value may widen the figure to this many times the zones; farther off it is an arrow. */
const WIDEST = 2;

/** @param measured {hole, shaft}: measured sizes in nm, where there are any */
export function zoneFigure(fit, measured) {
  const nominal = nmFromMm(fit.hole.nominal_mm);
  const edges = [fit.hole, fit.shaft].flatMap((limits) => [limits.upper_deviation_um, limits.lower_deviation_um]).map(nmFromUm);
  const scale = scaleOf([0, ...edges], Object.values(measured).filter(Number.isFinite).map((nm) => nm - nominal));
  return s('svg.zones', { viewBox: `0 0 ${WIDTH} ${HEIGHT}`, role: 'img', 'aria-label': t('fit.figure', { fit: number(fit.designation) }) },
    ['hole', 'shaft'].map((feature) => zone(feature, fit[feature], scale)),
    s('path.zero', { d: `M60 ${scale(0)}H${WIDTH - 60}` }),
    s('text.soft', { x: 52, y: scale(0) + 5, 'text-anchor': 'end' }, '0'),
    s('text.soft', { x: WIDTH - 52, y: scale(0) + 5 }, `Ø ${number(fit.hole.nominal_mm)}`),
    ['hole', 'shaft'].map((feature) => Number.isFinite(measured[feature]) && mark(feature, measured[feature] - nominal, scale)));
}

/** From nm to the figure's y. */
function scaleOf(edges, marks) {
  const reach = Math.max(...edges) - Math.min(...edges);
  const near = marks.filter((nm) => nm < Math.max(...edges) + WIDEST * reach && nm > Math.min(...edges) - WIDEST * reach);
  const high = Math.max(...edges, ...near);
  const low = Math.min(...edges, ...near);
  return (nm) => {
    const y = TOP + (BOTTOM - TOP) * (high - nm) / Math.max(high - low, NM_PER_UM);
    return Math.round(Math.min(Math.max(y, TOP - 20), BOTTOM + 20) * 10) / 10;
  };
}

function zone(feature, limits, scale) {
  const { x, width } = ZONES[feature];
  const upper = nmFromUm(limits.upper_deviation_um);
  const lower = nmFromUm(limits.lower_deviation_um);
  const [top, bottom] = [scale(upper), scale(lower)];
  const centre = x + width / 2;
  const outside = feature === 'hole' ? { x: x - 16, 'text-anchor': 'end' } : { x: x + width + 16 };
  return s('g', { class: feature },
    s('rect', { x, y: top, width, height: Math.max(bottom - top, 1.5) }),
    s('text.um', { x: centre, y: top - 9, 'text-anchor': 'middle' }, signed(umText(upper))),
    s('text.um', { x: centre, y: bottom + 20, 'text-anchor': 'middle' }, signed(umText(lower))),
    s('text.name', { ...outside, y: (top + bottom) / 2 + (clear(scale(0), (top + bottom) / 2)) }, limits.tolerance_class));
}

/** A name never stands on the zero line. */
const clear = (zero, middle) => (Math.abs(zero - middle) > 16 ? 8 : middle <= zero ? -12 : 30);

function mark(feature, deviation, scale) {
  const { x, width } = ZONES[feature];
  const y = scale(deviation);
  const side = feature === 'hole' ? x + width - 26 : x + 26;
  return s('g.measured', s('circle', { cx: side, cy: y, r: 8 }), s('path', { d: `M${x} ${y}H${x + width}` }));
}
