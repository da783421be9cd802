/** A frame for a small figure: a scale at the left, names below, and marks on it. */

import { h, s } from '../dom.js';
import { number } from '../i18n.js';

export const WIDTH = 480;
export const HEIGHT = 280;
export const EDGE = { left: 78, right: 14, top: 14, bottom: 34 };
const MARGIN = 0.08;
/** More names than these along the axis are left out evenly. */
const MOST_NAMES = 10;
/** One after the other: they tell operators apart without a colour. */
export const MARKS = ['M-5 0a5 5 0 1 0 10 0a5 5 0 1 0-10 0', 'M-5-5H5V5H-5z', 'M0-6L6 5H-6z', 'M0-7L7 0 0 7-7 0z', 'M-6-2H-2V-6H2V-2H6V2H2V6H-2V2H-6z', 'M0 6L6-5H-6z'];

export const round = (value) => Math.round(10 * value) / 10;

/** A frame with a scale at the left and names below. `x` of the middle of a place, `y` of a value. */
export class Frame {
  constructor(names, values, { from, decimals = 3, unit = '' }) {
    Object.assign(this, { names, decimals, unit });
    const [low, high] = [Math.min(...values), Math.max(...values)];
    const margin = (high - low || 1e-3) * MARGIN;
    this.low = from ?? low - margin;
    this.high = from === undefined ? high + margin : Math.ceil(high / 50) * 50;
    this.step = (WIDTH - EDGE.left - EDGE.right) / names.length;
  }

  x(place) {
    return round(EDGE.left + (place + 0.5) * this.step);
  }

  y(value) {
    return round(EDGE.top + (HEIGHT - EDGE.top - EDGE.bottom) * (this.high - value) / (this.high - this.low));
  }

  draw(title, ...children) {
    const { names, low, high } = this;
    const every = Math.ceil(names.length / MOST_NAMES);
    const marks = [0, 0.5, 1].map((share) => low + (high - low) * share);
    return h('figure', h('figcaption', title), s('svg.framed', { viewBox: `0 0 ${WIDTH} ${HEIGHT}`, role: 'img', 'aria-label': title },
      marks.map((value) => [s('path.grid-line', { d: `M${EDGE.left} ${this.y(value)}H${WIDTH - EDGE.right}` }),
        s('text', { x: EDGE.left - 8, y: this.y(value) + 5, 'text-anchor': 'end' }, number(value.toFixed(this.decimals)) + this.unit)]),
      names.map((name, i) => name && i % every === 0 && s('text', { x: this.x(i), y: HEIGHT - 10, 'text-anchor': 'middle' }, name.length > 9 ? `${name.slice(0, 8)}…` : name)),
      children));
  }

  line(values, attributes = {}) {
    return s('path.mean-line', { d: values.map((value, i) => `${i ? 'L' : 'M'}${this.x(i)} ${this.y(value)}`).join(''), ...attributes });
  }

  mark(place, value, shape = 0, name = 'mark') {
    return s(`path.${name}`, { d: MARKS[shape % MARKS.length], transform: `translate(${this.x(place)} ${this.y(value)})` });
  }
}
