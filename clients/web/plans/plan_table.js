/** A table of characteristics, as CSV or from a workbook: the first row names the columns, in words of the page or of the service. */

import { Decimal, parseSigned } from '../exact.js';
import { t } from '../i18n.js';
import { KINDS, limitsTyped, umOfMm } from './sizes.js';

/** What the service calls a member of a characteristic, in the order in which a table is written. */
const MEMBERS = ['name', 'designation', 'nominal_mm', 'tolerance_class', 'upper_um', 'lower_um', 'feature', 'quantity', 'count', 'gauge', 'size_operator', 'rule',
  'uncertainty_um', 'coverage_factor', 'subgroup_size', 'frequency', 'reaction', 'catalogue', 'picture', 'envelope', 'inside_corner', 'entity'];
const NUMBERS = new Set(['nominal_mm', 'upper_um', 'lower_um', 'count', 'uncertainty_um', 'coverage_factor', 'subgroup_size']);
const WORDS = { true: true, false: false };
/** Columns that are no members, with the members that people have them in place of. */
const OTHERS = { part: [], size: ['designation', 'nominal_mm'], kind: ['feature', 'quantity'], upper_mm: ['upper_um'], lower_mm: ['lower_um'] };

const plain = (text) => text.toLowerCase().replace(/[^\p{L}\p{N}]/gu, '');

/** The column that a heading names: that of the service, or the word of the page for it. */
function columnOf(heading) {
  const named = plain(heading);
  return [...MEMBERS, ...Object.keys(OTHERS)].find((each) => plain(each) === named)
    ?? ['name', 'size', 'kind', 'gauge', ...MEMBERS.slice(8)].find((each) => plain(t(`plans.member.${each}`)) === named);
}

/** The row of headings, whose columns it names; null without one. A title may stand above it. */
function headingOf(rows) {
  const at = rows.findIndex((row) => row.some((cell) => columnOf(cell) === 'name'));
  return at < 0 ? null : { at, names: rows[at].map(columnOf) };
}

/** The rows of a text: separated by `;`, tabs or commas, whichever gives most columns a known heading; quotes as RFC 4180. */
export function rowsOfText(text) {
  const known = (rows) => headingOf(rows)?.names.filter(Boolean).length ?? 0;
  return [';', '\t', ','].map((separator) => rowsBy(separator, text.replace(/\r\n?/g, '\n'))).reduce((best, rows) => (known(rows) > known(best) ? rows : best));
}

function rowsBy(separator, text) {
  const rows = [['']];
  let quoted = false;
  for (let i = text.charCodeAt(0) === 0xfeff ? 1 : 0; i < text.length; ++i) {
    const row = rows.at(-1);
    const sign = text[i];
    if (quoted && sign === '"' && text[i + 1] === '"') row[row.length - 1] += text[++i];
    else if (sign === '"' && (quoted || !row.at(-1))) quoted = !quoted;
    else if (quoted || ![separator, '\n'].includes(sign)) row[row.length - 1] += sign;
    else if (sign === separator) row.push('');
    else rows.push(['']);
  }
  return rows.map((row) => row.map((cell) => cell.trim())).filter((row) => row.some(Boolean));
}

const decimal = (text) => {
  const number = parseSigned(text);
  return number === null ? text : new Decimal(number);
};
const deviation = (mm) => {
  const number = parseSigned(mm);
  return number === null ? mm : new Decimal(umOfMm(number));
};

/** A row as a plan has it: limits as one text, or in columns of their own, with deviations in µm or mm. */
function characteristicOf(cells) {
  const given = (name) => cells[name] || undefined;
  const word = plain(given('kind') ?? '');
  const kind = Object.keys(KINDS).find((each) => [each, t(`plans.kind.${each}`)].some((one) => plain(one) === word));
  const deviations = { upper_um: given('upper_mm') && deviation(cells.upper_mm), lower_um: given('lower_mm') && deviation(cells.lower_mm) };
  // Beside deviations of their own a size is the nominal one.
  const isNominal = Object.values(deviations).some(Boolean) || given('upper_um') || given('lower_um') || given('tolerance_class');
  const size = given('size') && (isNominal ? { nominal_mm: decimal(cells.size.replace(/^[Øø⌀∅\s]+/, '')) } : limitsTyped(cells.size, kind));
  const own = MEMBERS.filter(given).map((name) => [name, NUMBERS.has(name) ? decimal(cells[name]) : name === 'inside_corner' ? WORDS[plain(cells[name])] ?? cells[name] : cells[name]]);
  // The service says what is wrong with another word.
  const { feature, ...quantity } = KINDS[kind] ?? { quantity: cells.kind };
  const isClass = size?.designation ?? given('designation') ?? given('tolerance_class');
  return JSON.parse(JSON.stringify({ ...size, ...(isNominal && deviations), ...(!isClass && feature && { feature }), ...quantity, ...Object.fromEntries(own) }));
}

/** @returns {part, characteristics, unused}; `problem` says why there are none, with what to say of it */
export function planOfRows(rows) {
  const heading = headingOf(rows);
  if (!heading) return { problem: 'file.no_names', values: { names: MEMBERS.slice(0, 7).join(', ') } };
  const { at, names } = heading;
  const isSame = (one, other) => one === other || OTHERS[one]?.includes(other) || OTHERS[other]?.includes(one);
  const twice = rows[at].filter((_, i) => names[i] && names.some((other, j) => i !== j && isSame(names[i], other)));
  if (twice.length) return { problem: 'file.twice', values: { names: [...new Set(twice)].join(', ') } };
  // A decimal comma between commas moves what follows it into other columns.
  const wide = rows.slice(at + 1).find((row) => row.some((cell, i) => cell && !rows[at][i]));
  if (wide) return { problem: 'file.unnamed', values: { row: wide.join(' · ') } };
  const found = rows.slice(at + 1).map((row) => Object.fromEntries(row.map((cell, i) => [names[i], cell]).filter(([name, cell]) => name && cell)))
    .filter(({ part: _, ...members }) => Object.keys(members).length);
  if (!found.length) return { problem: 'file.empty', values: {} };
  const parts = [...new Set(found.map(({ part }) => part).filter(Boolean))];
  if (parts.length > 1) return { problem: 'file.several', values: { parts: parts.join(', ') } };
  return { part: parts[0] ?? '', characteristics: found.map(characteristicOf), unused: rows[at].filter((heading, i) => heading && !names[i]) };
}

const cell = (value = '') => (/[",;\n]/.test(String(value)) ? `"${String(value).replaceAll('"', '""')}"` : String(value));

/** A plan as CSV, which planOfRows reads again: numbers with a point, deviations in µm. */
export function csvOf(plan) {
  const { characteristics } = JSON.parse(JSON.stringify(plan));
  const used = MEMBERS.filter((name) => characteristics.some((one) => one[name] !== undefined));
  return [used, ...characteristics.map((one) => used.map((name) => one[name]))].map((row) => `${row.map(cell).join(',')}\r\n`).join('');
}
