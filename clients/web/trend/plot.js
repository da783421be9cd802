/** How rows of points come onto a figure: by columns of pixels, and with elements that are used again. */

import { s } from '../dom.js';
import { time } from '../i18n.js';

/** Points closer than this many pixels are a line; of those that are good nothing else is drawn. */
const DENSE = 4;

const round = (value) => Math.round(10 * value) / 10;

/** The points in sight, and where each stands. */
export class Sight {
  /** @param from, to the first and the last index; @param left, right where these two stand, in CSS pixels */
  constructor({ from, to, left, right }) {
    Object.assign(this, { from, to, left, right });
    this.step = to > from ? (right - left) / (to - from) : 0;
    this.dense = right - left < DENSE * (to - from);
    this.start = this.step ? left : (left + right) / 2;
    this.base = from;
  }

  x(i) {
    return round(this.start + this.step * (i - this.base));
  }

  /** The index of the point that is nearest to an x. */
  indexAt(x) {
    const near = this.step ? this.from + Math.round((x - this.start) / this.step) : this.from;
    return Math.min(Math.max(near, this.from), this.to);
  }

  /** The same places, from a later point on. */
  since(first) {
    return Object.assign(Object.create(Sight.prototype), this, { from: Math.max(this.from, first) });
  }

  indices(isMeant = () => true) {
    const found = [];
    for (let i = this.from; i <= this.to; ++i) if (isMeant(i)) found.push(i);
    return found;
  }
}

/** A line through what is in sight; where it is dense, from the least to the greatest of each column of pixels. */
export function lineOf(sight, values, y) {
  const { from, to } = sight;
  let path = '';
  if (!sight.dense) {
    for (let i = from; i <= to; ++i) path += `${path ? 'L' : 'M'}${sight.x(i)} ${y(values[i])}`;
    return path;
  }
  for (let i = from; i <= to;) {
    const column = Math.round(sight.x(i));
    let least = values[i];
    let greatest = least;
    for (++i; i <= to && Math.round(sight.x(i)) === column; ++i) {
      const value = values[i];
      if (value < least) least = value;
      else if (value > greatest) greatest = value;
    }
    path += `${path ? 'L' : 'M'}${column} ${y(greatest)}V${y(least)}`;
  }
  return path;
}

/** A limit of size as a line with a step where it changes. */
export function stepsOf(points, sight, limit, y, left, right) {
  let now = points[sight.from][limit];
  let path = `M${left} ${y(now)}`;
  for (let i = sight.from + 1; i <= sight.to; ++i) {
    const next = points[i][limit];
    if (next !== now) path += `H${sight.x(i)}V${y(next)}`;
    now = next;
  }
  return `${path}H${right}`;
}

/** Marks, in order, that would stand over each other are left out but for the first. */
export function spaced(marks, sight, distance) {
  let last = -Infinity;
  return marks.filter(([i]) => {
    const x = sight.x(i);
    if (x - last < distance) return false;
    last = x;
    return true;
  });
}

/** Time and part of the first, the middle and the last value: [[x, anchor, text]]. */
export function axisLabels(points, sight, left, right) {
  const { from, to } = sight;
  const ends = right - left > 420 && to - from > 4 ? [from, Math.round((from + to) / 2), to] : [...new Set([from, to])];
  return ends.map((i) => {
    const { part_id: part, measured_at: at } = points[i].record;
    const said = [part, `${at.slice(5, 10)} ${time(new Date(at)).slice(0, 5)}`].filter(Boolean).join(' · ').slice(-28);
    return [i === from ? left : i === to ? right : sight.x(i), i === from ? 'start' : i === to ? 'end' : 'middle', said];
  });
}

/** Elements of one kind. A figure that moves changes them, and makes or takes away only what is more or less. */
export class Pool {
  #elements = [];
  #known = [];

  constructor(selector, attributes = {}) {
    Object.assign(this, { selector, attributes });
    this.element = s('g');
  }

  /** @param draw takes an item, and what sets the attributes and the text of its element */
  show(items, draw) {
    items.forEach((item, n) => draw(item, (attributes, text) => this.#set(n, attributes, text)));
    for (const left of this.#elements.splice(items.length)) left.remove();
    this.#known.length = this.#elements.length;
  }

  #set(n, attributes, text) {
    if (n === this.#elements.length) {
      this.#elements.push(s(this.selector, this.attributes));
      this.#known.push({});
      this.element.append(this.#elements[n]);
    }
    const [element, known] = [this.#elements[n], this.#known[n]];
    for (const name in attributes) {
      if (known[name] === attributes[name]) continue;
      known[name] = attributes[name];
      element.setAttribute(name, attributes[name]);
    }
    if (text !== undefined && element.textContent !== text) element.textContent = text;
  }
}
