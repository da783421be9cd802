/** The pictures of a gauge study: components of variation, values by part and by operator, means by both, and a run on one master. */

import { h, s } from '../dom.js';
import { EDGE, Frame, HEIGHT, MARKS, round, WIDTH } from '../figures/frame.js';
import { number, t } from '../i18n.js';
/** Of operators, one after the other. */
const DASHES = ['', '7 4', '2 4', '9 3 2 3', '12 5', '4 2'];

const meanOf = (values) => values.reduce((sum, value) => sum + value, 0) / values.length;

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

/** How the points of each chart are judged: a mean beyond its limits tells parts apart, a range beyond its limit is no repetition. */
const SAID = { xbar: (out, all) => t(2 * out < all ? 'study.averages_few' : 'study.averages', { count: out, all }), r: (out) => t(out ? 'study.ranges_out' : 'study.ranges', { count: out }) };

/** AIAG's charts of averages and ranges: the parts of one operator after those of the other, with the control limits. @param charts of the service, a point each part of each operator */
export function averageAndRange(charts, { parts, operators }) {
  const count = operators.length * parts.length;
  return charts.map(({ name, centre, lower_limit: lower, upper_limit: upper, points }) => {
    const frame = new Frame(Array(count).fill(''), [...points, lower, upper], { decimals: name === 'r' ? 4 : 3 });
    if (lower === 0) frame.low = 0;
    const across = (value, kind) => s(`path.${kind}`, { d: `M${EDGE.left} ${frame.y(value)}H${WIDTH - EDGE.right}` });
    const isOut = (value) => value > upper || value < lower;
    const figure = frame.draw(t(`study.figure.${name}`), across(upper, 'bound'), across(lower, 'bound'), across(centre, 'master'), operators.map((operator, at) => {
      const [first, last] = [at * parts.length, (at + 1) * parts.length];
      const edge = round(frame.x(first) - frame.step / 2);
      const own = points.slice(first, last);
      return [at > 0 && s('path.grid-line', { d: `M${edge} ${EDGE.top}V${HEIGHT - EDGE.bottom}` }),
        s('text', { x: round(edge + (last - first) * frame.step / 2), y: HEIGHT - 10, 'text-anchor': 'middle' }, operator.length > 14 ? `${operator.slice(0, 13)}…` : operator),
        frame.line(own, { d: own.map((value, i) => `${i ? 'L' : 'M'}${frame.x(first + i)} ${frame.y(value)}`).join('') }),
        own.map((value, i) => {
          const mark = frame.mark(first + i, value, isOut(value) ? 1 : 0);
          mark.append(s('title', `${operator} · ${parts[i]}: ${number(value.toFixed(4))} mm`));
          return mark;
        })];
    }));
    figure.append(h('p.hint', `${SAID[name](points.filter(isOut).length, count)} ${t('study.chart_limits', { lower: number(lower.toFixed(4)), upper: number(upper.toFixed(4)) })}`));
    return figure;
  });
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
