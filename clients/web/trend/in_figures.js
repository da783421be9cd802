/** The chart in figures, for those who do not see it and those who want to know exactly: its lines, and the points that break a rule. */

import { h } from '../dom.js';
import { umText } from '../exact.js';
import { dateTime, signed, t } from '../i18n.js';
import { rulesAt, SPREADS, umOf } from './control_chart.js';

/** So many of the newest points that break a rule are named. */
const MOST = 100;

const row = (name, ...cells) => h('tr', h('th', { scope: 'row' }, name), cells.map((cell) => h('td', cell)));
const deviation = (nm) => `${signed(umText(Math.round(nm)))} µm`;

/** @param chart of the service, or null; @param onPick takes the index of a point */
export function inFigures(points, chart, onPick) {
  const [own, spread] = chart?.charts ?? [];
  const { upper, lower, members } = points.at(-1);
  const phases = chart?.phases ?? [];
  const limits = { 'trend.upper_limit': upper, 'trend.lower_limit': lower };
  const broken = rulesAt(chart);
  const shown = [...broken].slice(-MOST).reverse();
  const pointName = (i) => points[i].record.part_id ?? t('trend.value_number', { number: i + 1 });
  return [
    h('summary', t('trend.in_figures', { count: broken.size })),
    h('table', h('tbody',
      Object.entries(limits).filter(([, nm]) => !members && Number.isFinite(nm)).map(([name, nm]) => row(t(name), deviation(nm))),
      own && [row(t('trend.upper_control'), `${umOf(own.upper_limit)} µm`), row(t('trend.centre'), `${umOf(own.centre)} µm`), row(t('trend.lower_control'), `${umOf(own.lower_limit)} µm`)],
      spread && [row(`${SPREADS[spread.name]}: ${t('trend.upper_control')}`, `${umOf(spread.upper_limit)} µm`), row(`${SPREADS[spread.name]}: ${t('trend.centre')}`, `${umOf(spread.centre)} µm`)])),
    phases.length > 1 && h('div.wide', { tabindex: 0, role: 'region', 'aria-label': t('phases.title') }, h('table', h('caption', t('phases.title')),
      h('thead', h('tr', ['phases.phase', 'phases.begins', 'trend.count', 'trend.lower_control', 'trend.centre', 'trend.upper_control'].map((name) => h('th', { scope: 'col' }, t(name))))),
      h('tbody', phases.map(({ from, why, record, count, charts }, i) => row(h('button.quiet', { type: 'button', onclick: () => onPick(from) }, `${i + 1} · ${pointName(from)}`),
        why.map((cause) => t(`phases.why.${cause}`, { tool: record.tool ?? '', um: signed(String(record.offset_um ?? '')) })).join(', '), String(count),
        ...['lower_limit', 'centre', 'upper_limit'].map((line) => (charts ? `${umOf(charts[0][line])} µm` : '–'))))))),
    broken.size > 0 && h('div.scroll', { tabindex: 0, role: 'region', 'aria-label': t('trend.points_broken') }, h('table',
      h('caption', broken.size > MOST ? t('trend.newest_of', { shown: MOST, count: broken.size }) : t('trend.points_broken')),
      h('thead', h('tr', ['trend.point', 'trend.deviation_of', 'trend.rules_broken', 'trend.time'].map((name) => h('th', { scope: 'col' }, t(name))))),
      h('tbody', shown.map(([i, rules]) => row(h('button.quiet', { type: 'button', onclick: () => onPick(i) }, pointName(i)),
        deviation(points[i].deviation), [...rules].join(', '), dateTime(new Date(points[i].record.measured_at))))))),
  ];
}
