/** The pictures of a gauge study: components of variation, values by part and by operator, means by both, and a run on one master. */

import { h, s } from '../dom.js';
import { number, t } from '../i18n.js';

const WIDTH = 480;
const HEIGHT = 280;
const EDGE = { left: 78, right: 14, top: 14, bottom: 34 };
const MARGIN = 0.08;
/** More names than these along the axis are left out evenly. */
const MOST_NAMES = 10;
/** Of operators, one after the other: mark and dashes tell them apart without a colour. */
const MARKS = ['M-5 0a5 5 0 1 0 10 0a5 5 0 1 0-10 0', 'M-5-5H5V5H-5z', 'M0-6L6 5H-6z', 'M0-7L7 0 0 7-7 0z', 'M-6-2H-2V-6H2V-2H6V2H2V6H-2V2H-6z', 'M0 6L6-5H-6z'];
const DASHES = ['', '7 4', '2 4', '9 3 2 3', '12 5', '4 2'];

export const meanOf = (values) => values.reduce((sum, value) => sum + value, 0) / values.length;
const round = (value) => Math.round(10 * value) / 10;

/** A frame with a scale at the left and names below. `x` of the middle of a place, `y` of a value. */
class Frame {
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
    return h('figure', h('figcaption', title), s('svg.study-figure', { viewBox: `0 0 ${WIDTH} ${HEIGHT}`, role: 'img', 'aria-label': title },
      marks.map((value) => [s('path.grid-line', { d: `M${EDGE.left} ${this.y(value)}H${WIDTH - EDGE.right}` }),
        s('text', { x: EDGE.left - 8, y: this.y(value) + 5, 'text-anchor': 'end' }, number(value.toFixed(this.decimals)) + this.unit)]),
      names.map((name, i) => i % every === 0 && s('text', { x: this.x(i), y: HEIGHT - 10, 'text-anchor': 'middle' }, name.length > 9 ? `${name.slice(0, 8)}…` : name)),
      children));
  }

  line(values, attributes = {}) {
    return s('path.mean-line', { d: values.map((value, i) => `${i ? 'L' : 'M'}${this.x(i)} ${this.y(value)}`).join(''), ...attributes });
  }

  mark(place, value, shape = 0, name = 'mark') {
    return s(`path.${name}`, { d: MARKS[shape % MARKS.length], transform: `translate(${this.x(place)} ${this.y(value)})` });
  }
}

/** @param readings [{part, operator, value}], values in mm; @param by `part` or `operator`; @param names in order */
export function byOne(readings, by, names) {
  const groups = names.map((name) => readings.filter((one) => one[by] === name).map(({ value }) => value));
  const frame = new Frame(names, readings.map(({ value }) => value), {});
  return frame.draw(t(`study.figure.by_${by}`), groups.map((values, i) => values.map((value) => frame.mark(i, value, 0, 'reading'))),
    frame.line(groups.map(meanOf)), groups.map((values, i) => frame.mark(i, meanOf(values), 3)));
}

/** Means of each part, a line for each operator: lines that cross are an interaction. */
export function interaction(readings, parts, operators) {
  const lines = operators.map((operator) => parts.map((part) => meanOf(readings.filter((one) => one.part === part && one.operator === operator).map(({ value }) => value))));
  const frame = new Frame(parts, lines.flat(), {});
  const figure = frame.draw(t('study.figure.interaction'), lines.map((means, at) => s('g', { class: `operator-${at % 3}` },
    frame.line(means, { 'stroke-dasharray': DASHES[at % DASHES.length] || undefined }), means.map((mean, i) => frame.mark(i, mean, at)))));
  figure.append(h('ul.legend', operators.map((operator, at) => h('li', { class: `operator-${at % 3}` }, s('svg', { viewBox: '0 0 32 12', 'aria-hidden': 'true' },
    s('path.mean-line', { d: 'M0 6H32', 'stroke-dasharray': DASHES[at % DASHES.length] || undefined }), s('path.mark', { d: MARKS[at % MARKS.length], transform: 'translate(16 6)' })), operator))));
  return figure;
}

/** @param study of the service; @param components and @param shares the names of those that it has */
export function components(study, names, shares) {
  const values = shares.flatMap((share) => names.map((name) => study[share][name] ?? 0));
  const frame = new Frame(names.map((name) => t(`study.short.${name}`)), [100, ...values], { from: 0, decimals: 0, unit: ' %' });
  const width = frame.step / (shares.length + 1);
  const figure = frame.draw(t('study.figure.components'), names.map((name, i) => shares.map((share, at) => {
    const top = frame.y(study[share][name] ?? 0);
    return s(`rect.share-${at}`, { x: round(frame.x(i) + (at - shares.length / 2) * width), y: top, width: round(width - 2), height: round(HEIGHT - EDGE.bottom - top) });
  })));
  figure.append(h('ul.legend', shares.map((share, at) => h('li', s('svg', { viewBox: '0 0 32 12', 'aria-hidden': 'true' }, s(`rect.share-${at}`, { width: 32, height: 12 })), t(`study.${share}`)))));
  return figure;
}

/** Values on one master about its size, between a tenth of the tolerance above and below. */
export function masterRun(values, reference, tolerance) {
  const bounds = [reference + tolerance / 10, reference - tolerance / 10];
  const frame = new Frame(values.map((_, i) => String(i + 1)), [...values, ...bounds], { decimals: 4 });
  const across = (value, name) => s(`path.${name}`, { d: `M${EDGE.left} ${frame.y(value)}H${WIDTH - EDGE.right}` });
  return frame.draw(t('study.figure.master'), bounds.map((value) => across(value, 'bound')), across(reference, 'master'), frame.line(values), values.map((value, i) => frame.mark(i, value)));
}
