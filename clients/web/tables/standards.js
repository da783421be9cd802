/** The numbers of other standards than ISO 286: general tolerances, threads, keyways, bearings. */

import { getJson, url } from '../api.js';
import { Asked } from '../asked.js';
import { field, h } from '../dom.js';
import { parseMeasured } from '../exact.js';
import { has, number, signed, t } from '../i18n.js';
import { Latest } from '../latest.js';
import { fragment, go } from '../route.js';

const ISO_286 = 'hole';
export const STANDARDS = ['din6885-1', 'iso492', 'iso2768-1', 'iso965-1'];

/** Chooses whose numbers the view shows. */
export function standardChoice(chosen = ISO_286) {
  const select = h('select', { id: 'standard', onchange: () => { location.hash = fragment({ view: 'tables', path: [select.value] }); } },
    [ISO_286, ...STANDARDS].map((name) => h('option', { value: name, selected: name === chosen }, t(`tables.standard.${name}`))));
  return field(t('tables.standard'), select);
}

/** What stands before the limits of a row: [name in the row, text]. */
const BEFORE = [['over_mm', 'tables.over'], ['up_to_mm', 'tables.up_to'], ['diameter_mm', 'tables.column.diameter'], ['pitch_mm', 'tables.column.pitch']];

/** "width_P9" is the width in P9; a class is called as the standard calls it. */
function columnName(name) {
  const [what, ...classes] = has(`tables.column.${name}`) ? [name] : name.split('_');
  return [has(`tables.column.${what}`) ? t(`tables.column.${what}`) : what, ...classes].join(' ');
}

function cell(limits) {
  if (!limits) return null;
  const { designation, nominal_mm: nominal, upper_arcmin: minutes } = limits;
  const single = limits.tolerance_um ?? limits.deviation_um;
  const [upper, lower] = minutes === undefined ? [limits.upper_um, limits.lower_um].map((um) => um !== undefined && signed(um))
    : [minutes, limits.lower_arcmin].map((angle) => `${signed(angle)}′`);
  return [!designation && nominal !== undefined && number(nominal), single !== undefined && number(single), upper && h('span', upper), lower && h('span', lower)];
}

function grid(name, rows) {
  const before = BEFORE.filter(([member]) => rows.some((row) => row[member] !== undefined));
  const columns = [...new Set(rows.flatMap(({ limits }) => Object.keys(limits)))];
  return h('table.grid', h('caption', t(`tables.of.${name}`)),
    h('thead', h('tr', before.map(([, text]) => h('th', { scope: 'col' }, t(text))), columns.map((each) => h('th', { scope: 'col' }, columnName(each))))),
    h('tbody', rows.map((row) => h('tr',
      before.map(([member], i) => h(i ? 'td' : 'th', { scope: i ? null : 'row' }, row[member] !== undefined && number(row[member]))),
      columns.map((each) => h('td', cell(row.limits[each])))))));
}

/** The tables of a standard, or their rows for one size. @returns what ends it */
export function mountStandard(main, name, wanted = '') {
  const leaving = new AbortController();
  const asking = new Latest(leaving.signal);
  const find = h('input', { id: 'find', type: 'search', inputmode: 'decimal', autocomplete: 'off', oninput: () => asked.run() });
  find.value = wanted;
  const note = h('p.note', { role: 'status' });
  const tables = h('div.standard');
  main.replaceChildren(h('div.desk.tables', h('h1.unseen', { tabindex: -1 }, t('view.tables')),
    h('form.line', { onsubmit: (event) => event.preventDefault() }, standardChoice(name), field(t('tables.size'), find)), note, tables));

  const asked = new Asked(async () => {
    const size = parseMeasured(find.value);
    go({ view: 'tables', path: [name], options: { find: find.value.trim() } }, { refine: true });
    const found = await asking.run((signal) => getJson(url(['standards', name], { size_mm: size }), { signal }));
    if (!found) return;
    note.textContent = found.rows.length ? '' : t('error.size.out_of_range');
    const names = [...new Set(found.rows.map(({ table }) => table))];
    tables.replaceChildren(h('p.aside', `${found.edition} · ${t('tables.units')}`), ...names.map((each) =>
      h('div.scroll', { tabindex: 0, role: 'region', 'aria-label': t(`tables.of.${each}`) }, grid(each, found.rows.filter(({ table }) => table === each)))));
  }, { say: (text) => text && nothing(text), leaving: leaving.signal });

  function nothing(reason) {
    note.textContent = reason;
    tables.replaceChildren();
  }

  asked.run();
  return () => leaving.abort();
}
