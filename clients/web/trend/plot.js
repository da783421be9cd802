/** What a chart by uPlot is made of: marks at points, lines at values, labels, and the colours of the page. */

import { style, uPlot } from '../bundled/uplot.js';
import { h } from '../dom.js';

/** Points closer than this many pixels are a line: of those that are good nothing else is drawn, of others one each so many pixels. */
export const DENSE = 4;
const NEAR = 2;
const COLOURS = ['ink', 'soft', 'line', 'edge', 'sheet', 'focus', 'good', 'rework', 'reject', 'indeterminate'];

const rules = new CSSStyleSheet();
rules.replaceSync(style);
document.adoptedStyleSheets = [...document.adoptedStyleSheets, rules];

/** The colours that style sheets give an element now: light or dark, the system's where it forces them, or of paper. */
export function coloursOf(element) {
  const probe = element.appendChild(h('i.colour-of'));
  const colours = Object.fromEntries(COLOURS.map((name) => {
    probe.style.color = `var(--${name})`;
    return [name, getComputedStyle(probe).color];
  }));
  probe.remove();
  return colours;
}

/** How many pixels of the canvas a pixel of a figure with so many dots a pixel is. */
const scaleOf = (dots) => dots * uPlot.pxRatio;

/** Of indices, in order, those in sight that are so many pixels apart: [index, x on the canvas, how many it stands for]. */
export function inSight(plot, indices, apart) {
  const { min, max } = plot.scales.x;
  const found = [];
  let last = -Infinity;
  for (const i of indices) {
    if (i < min) continue;
    if (i > max) break;
    const x = plot.valToPos(i, 'x', true);
    if (x - last < apart) {
      ++found.at(-1)[2];
      continue;
    }
    last = x;
    found.push([i, x, 1]);
  }
  return found;
}

/**
 * A row of points that uPlot draws with a mark at some of them.
 * @param shape path of the mark about its point; @param indices of the points that get it, in order
 * @param always whether also where points are dense; @param apart so many pixels from each other, those of dense points at the least NEAR
 */
export function marked(row, shape, indices, dots, { always = true, apart = 0, ...look }) {
  const outline = new Path2D(shape);
  const paths = (plot) => {
    const path = new Path2D();
    const size = scaleOf(dots);
    const { min, max } = plot.scales.x;
    const dense = plot.bbox.width < DENSE * (max - min) * size;
    for (const [i, x] of dense && !always ? [] : inSight(plot, indices, Math.max(apart, dense ? NEAR : 0) * size)) {
      path.addPath(outline, { a: size, d: size, e: x, f: plot.valToPos(row.data[i], row.scale, true) });
    }
    return { stroke: path, fill: path };
  };
  return { ...row, ...look, width: (look.width ?? 1) * dots, paths };
}

/** A row that is a line with a step where it changes, to the edge. */
export function stepped(row, dots, { stroke, width }) {
  const data = row.data.map((value, i) => (value === row.data[i - 1] ? null : value));
  return { ...row, data, stroke, width: width * dots, spanGaps: true, paths: uPlot.paths.stepped({ align: 1, extend: true }) };
}

/** Axes for uPlot. Of a size of 0 they are labels or lines at some values, and stand before those that have one. */
export function axes(dots, font, stroke) {
  const axis = ({ size = 0, grid, ...own }) => ({
    font, stroke, gap: 6 * dots, size: size * dots, ticks: { show: false }, splits: [], values: [], grid: { show: Boolean(grid), ...grid }, ...own,
  });
  return {
    axis,
    /** Lines across the chart at some values. */
    line: (scale, splits, colour, width, dash = []) =>
      axis({ scale, side: 1, splits, grid: { stroke: colour, width: width * dots, dash: dash.map((length) => length * scaleOf(dots)) } }),
  };
}
