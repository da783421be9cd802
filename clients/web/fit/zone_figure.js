/** The tolerance zones of a hole and a shaft about the zero line, deviations in µm (ISO 286-1). */

import { s } from '../dom.js';
import { NM_PER_UM, nmFromMm, nmFromUm, umText } from '../exact.js';
import { number, signed, t } from '../i18n.js';

const WIDEST_FIGURE = 720;
const HEIGHT = 400;
const TOP = 40;
const BOTTOM = 360;
/** Room for the name of a class beside its zone. */
const NAMES = 88;
/** A measured value may widen the figure to this many times the zones; farther off it is an arrow. */
const WIDEST = 2;

/**
 * @param measured {hole, shaft}: measured sizes in nm, where there are any
 * @param width in CSS pixels: the figure is drawn for the width it gets, so that its lettering keeps its size
 */
export function zoneFigure(fit, measured, width) {
  const places = placesOf(width);
  const nominal = nmFromMm(fit.hole.nominal_mm);
  const edges = [fit.hole, fit.shaft].flatMap((limits) => [limits.upper_deviation_um, limits.lower_deviation_um]).map(nmFromUm);
  const scale = scaleOf([0, ...edges], Object.values(measured).filter(Number.isFinite).map((nm) => nm - nominal));
  return s('svg.zones', { viewBox: `0 0 ${places.width} ${HEIGHT}`, role: 'img', 'aria-label': t('fit.figure', { fit: number(fit.designation) }) },
    ['hole', 'shaft'].map((feature) => zone(feature, fit[feature], scale, places)),
    s('path.zero', { d: `M22 ${scale(0)}H${places.width - places.label}` }),
    s('text.soft', { x: 14, y: scale(0) + 5, 'text-anchor': 'end' }, '0'),
    s('text.soft', { x: places.width - places.label + 8, y: scale(0) + 5 }, `Ø ${number(fit.hole.nominal_mm)}`),
    ['hole', 'shaft'].map((feature) => Number.isFinite(measured[feature]) && mark(feature, measured[feature] - nominal, scale, places)));
}

/** Where the two zones stand in a figure of a width: in its middle, as wide as there is room. */
function placesOf(available) {
  const width = Math.max(Math.min(available, WIDEST_FIGURE), 300);
  const label = 60;
  const each = Math.min((width - 2 * NAMES - label) / 2, 180);
  const gap = Math.min(60, (width - 2 * NAMES - label - 2 * each) / 2 + 12);
  const centre = width / 2 - (width < 500 ? label / 3 : 0);
  return { width, label, hole: { x: centre - gap / 2 - each, width: each }, shaft: { x: centre + gap / 2, width: each } };
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

function zone(feature, limits, scale, places) {
  const { x, width } = places[feature];
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

function mark(feature, deviation, scale, places) {
  const { x, width } = places[feature];
  const y = scale(deviation);
  const side = feature === 'hole' ? x + width - 26 : x + 26;
  return s('g.measured', s('circle', { cx: side, cy: y, r: 8 }), s('path', { d: `M${x} ${y}H${x + width}` }));
}
