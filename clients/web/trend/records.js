/** The records behind the chart: that of one point, and the last ones. */

import { h } from '../dom.js';
import { umText } from '../exact.js';
import { dateTime, signed, t } from '../i18n.js';
import { fragment } from '../route.js';
import { distanceText, measuredText, noteText, operatorOf, placesOf, recordMark, verdictMark } from '../verdict.js';
import { asideOf } from './aside.js';

const ROWS = 12;
const HEAD = ['trend.verdict', 'trend.value', 'trend.distance', 'field.part_id', 'trend.time'];

/** The record of one point, or those that its mean is of. @param broken the numbers of the rules it breaks, if any; @param onAside takes a record that is to be set aside, or counted again */
export function pointDetail({ record, members, deviation }, broken, onAside) {
  const marks = broken && h('span.stability.doubt', t('trend.broken', { rules: [...broken].join(', ') }));
  if (members) {
    return h('div.line', verdictMark(record.verdict), h('strong', `x̄ = ${signed(umText(Math.round(deviation)))} µm`), h('span', record.subgroup),
      h('span.aside', members.map((each) => `${measuredText(each.record)} mm`).join(' · ')), marks);
  }
  return h('div.line', recordMark(record), h('strong', `${measuredText(record)} mm`), h('span', distanceText(record)),
    record.part_id && h('a', { href: fragment({ view: 'parts', options: { part_id: record.part_id } }) }, record.part_id),
    h('span.aside', [record.characteristic, record.machine, record.tool, operatorOf(record), record.gauge, dateTime(new Date(record.measured_at))].filter(Boolean).join(' · ')),
    record.confirmed && h('span.aside', t('confirmed.mark')),
    record.correction_of !== undefined && h('span.aside', t('trend.corrected')),
    (record.notes ?? []).map((one) => h('span', noteText(one))), marks,
    h('button.quiet', { type: 'button', onclick: () => onAside(record) }, t(asideOf(record) ? 'aside.back' : 'aside.set')));
}

/** The last values, the newest first. */
export function lastRows(points) {
  const rows = points.slice(-ROWS).reverse();
  const places = placesOf(rows.map(({ record }) => record));
  return h('table', h('caption', t('recent.title')),
    h('thead', h('tr', HEAD.map((name) => h('th', { scope: 'col' }, t(name))))),
    h('tbody', rows.map(({ record }) => h('tr',
      h('td', recordMark(record)), h('td', `${measuredText(record, places)} mm`, asideOf(record) && h('span.aside', ` ${t('aside.mark')}`)), h('td', distanceText(record)),
      h('td', record.part_id ?? ''), h('td', dateTime(new Date(record.measured_at)))))));
}
