/** The inspection certificate of a part or an order, for paper: every characteristic as it stands now. */

import { getJson, url } from '../api.js';
import { connection } from '../connection.js';
import { h } from '../dom.js';
import { gaugeInUse, gaugeText } from '../gauge/in_use.js';
import { dateTime, has, number, signed, t } from '../i18n.js';
import { limitsText, measuredText, verdictMark, VERDICTS } from '../verdict.js';
import { qrCode } from './qr_code.js';

const PAGE = 1000;
const MOST = 5000;
const HEAD = ['field.part_id', 'field.characteristic', 'certificate.size', 'parts.limits', 'trend.value', 'parts.deviation', 'trend.verdict', 'field.gauge', 'certificate.rule'];

/** @param of {part_id, order}: one of them or both. @returns the sheet */
export async function certificate(of, signal) {
  const records = await recordsOf(of, signal);
  if (!records.length) throw new Error(t('parts.none'));
  const counts = VERDICTS.map((word) => [word, records.filter(({ verdict }) => verdict === word).length]).filter(([, count]) => count);
  const revisions = [...new Set(records.map((record) => record.table_revision).filter(Boolean))];
  const names = [...new Set(records.map(({ gauge }) => gauge).filter(Boolean))];
  const gauges = (await Promise.all(names.map((name) => gaugeInUse(name, signal)))).filter(Boolean);
  const proof = await proofOf(records.at(-1), signal);
  return h('article.certificate', { 'aria-labelledby': 'certificate-title' },
    h('header', h('h2', { id: 'certificate-title', tabindex: -1 }, t('certificate.title')),
      h('button.primary', { type: 'button', onclick: () => print() }, t('certificate.print'))),
    h('div.facts', fact('field.part_id', of.part_id), fact('field.order', of.order), typed('certificate.company'), typed('certificate.customer'),
      fact('certificate.issued', dateTime(connection.now())), fact('certificate.count', String(records.length))),
    h('p.result', counts.map(([word, count]) => h('span', verdictMark(word), ` ${count}`))),
    h('div.rows', { tabindex: 0, role: 'region', 'aria-label': t('certificate.title') },
      h('table', h('thead', h('tr', HEAD.map((name) => h('th', { scope: 'col' }, t(name))))), h('tbody', records.map(row)))),
    gauges.length > 0 && h('ul.gauges', gauges.map((gauge) => h('li', { class: gauge.overdue && 'overdue' }, gaugeText(gauge)))),
    h('p.aside', t('certificate.basis', { revisions: revisions.join(', ') || '–' })),
    proof,
    h('div.signatures', ['certificate.inspected', 'certificate.approved'].map((name) => h('p', t(name)))));
}

/** Oldest first, as they were measured; what was corrected stands as it is now. */
async function recordsOf({ part_id, order }, signal) {
  let records = [];
  let after = '';
  do {
    const page = await getJson(url(['measurements'], { part_id, order, limit: PAGE, after }), { signal });
    records = [...records, ...page.measurements];
    after = page.next ?? '';
  } while (after && records.length < MOST);
  if (after) throw new Error(t('certificate.too_many', { most: MOST }));
  return records;
}

/** Where the newest value stands in the signed log, with the way to its proof; null where there is no log. */
async function proofOf({ id }, signal) {
  const place = url(['measurements', id, 'proof']);
  try {
    const { index, checkpoint } = await getJson(place, { signal });
    const [origin, size, root] = checkpoint.split('\n');
    const address = new URL(place, location.href).href;
    return h('section.proof', qrCode(address, t('certificate.proof_code')),
      h('div', h('p', t('certificate.proof', { row: index + 1, size, origin })), h('code', root), h('p.aside', address)));
  } catch (problem) {
    if (problem.status) return null;
    throw problem;
  }
}

const fact = (name, value) => value && h('p', h('span.label', t(name)), h('strong', value));

/** What only this sheet says: written on it before it is printed. */
const typed = (name) => h('label', h('span.label', t(name)), h('input', { type: 'text', autocomplete: 'organization' }));

const ruleText = (rule) => (has(`rule.${rule}`) ? t(`rule.${rule}`) : rule);

function row(record) {
  const uncertainty = record.uncertainty_um !== undefined && `u = ${number(record.uncertainty_um)} µm`;
  return h('tr', h('td', record.part_id ?? '–'), h('td', record.characteristic ?? ''),
    h('td', record.designation ? `Ø ${number(record.designation)}` : number(record.nominal_mm)), h('td', limitsText(record)),
    h('td.number', measuredText(record)), h('td.number', `${signed(record.deviation_um)} µm`), h('td', verdictMark(record.verdict)),
    h('td', [record.gauge, uncertainty].filter(Boolean).join(', ')), h('td', ruleText(record.rule ?? 'simple')));
}
