/** The pictures of a gauge study: components of variation, values by part and by operator, means by both, and a run on one master. */

import { h, s } from '../dom.js';
import { EDGE, Frame, HEIGHT, MARKS, round, WIDTH } from '../figures/frame.js';
import { t } from '../i18n.js';

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
