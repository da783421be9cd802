/** The tables: search by size and class, copy as CSV, custom tolerance classes. */

import { get, url } from '../api.js';
import { Asked } from '../asked.js';
import { copyText, field, h, refill } from '../dom.js';
import { downloadLink } from '../download.js';
import { parseDesignation } from '../designation.js';
import { nmFromMm, parseMeasured } from '../exact.js';
import { followTables } from '../events.js';
import { explain, number, signed, t } from '../i18n.js';
import { go } from '../route.js';
import { classNames, isoClass, tableRows } from '../tables/catalogue.js';
import { OwnColumns } from '../tables/own_columns.js';
import { mountStandard, standardChoice, STANDARDS } from '../tables/standards.js';

const USUAL = {
  hole: ['F8', 'G7', 'H6', 'H7', 'H8', 'H9', 'H11', 'JS7', 'K7', 'N7', 'P7'],
  shaft: ['f7', 'g6', 'h5', 'h6', 'h7', 'h9', 'h11', 'js6', 'k6', 'n6', 'p6', 's6'],
};
const MOST_CLASSES = 24;
const FEATURES = ['hole', 'shaft'];

export function mount(main, route) {
  if (STANDARDS.includes(route.path[0])) return mountStandard(main, route.path[0], route.options.find);
  const leaving = new AbortController();
  let feature = FEATURES.includes(route.path[0]) ? route.path[0] : 'hole';
  let names = null;
  let shown = { classes: [], sizes: [] };
  const find = h('input', { id: 'find', type: 'search', autocomplete: 'off', spellcheck: 'false', oninput: () => { copied = ''; ask(); } });
  find.value = route.options.find ?? '';
  /** That a table was copied: it stays where the tables are only asked for again. */
  let copied = '';
  const note = h('p.note', { role: 'status' });
  const table = h('div.scroll', { tabindex: 0, role: 'region', 'aria-label': t('view.tables') });
  const features = h('div.switch', { role: 'group', 'aria-label': t('tables.feature') });
  const whole = downloadLink({ id: 'whole-table' }, t('tables.whole'), (reason) => { note.textContent = reason; });
  const own = new OwnColumns({ onChange: () => ask(true), onShow: (name) => { find.value = name; copied = ''; ask(); } });

  main.replaceChildren(h('div.desk.tables', h('h1.unseen', { tabindex: -1 }, t('view.tables')),
    h('form.line', { onsubmit: (event) => event.preventDefault() }, standardChoice(), features, field(t('tables.find'), find),
      h('button', { type: 'button', onclick: copy }, t('tables.copy')),
      whole),
    note, table, own.element));

  /** Numbers in the search are sizes, the rest are classes or letters that classes begin with. */
  function understand() {
    const words = find.value.replace(/[Øø⌀∅]/g, ' ').split(/[\s;/]+|,(?!\d)/).flatMap(parted).filter((word) => word && word !== 'mm');
    const sizes = words.map(parseMeasured).filter((text) => text !== null).map(nmFromMm);
    const wanted = words.filter((word) => parseMeasured(word) === null);
    const named = (word, where) => {
      // Upper case is a hole, lower case a shaft: g6 and G7 have nothing in common.
      const exact = names[where].filter((name) => name === word);
      return exact.length ? exact : names[where].filter((name) => isoClass(name)?.letters === word);
    };
    const usual = USUAL[feature].filter((name) => names[feature].includes(name));
    const classes = wanted.length ? [...new Set(wanted.flatMap((word) => named(word, feature)))] : usual;
    return { sizes, classes, refusal: refusal(wanted, classes, (word) => FEATURES.some((each) => named(word, each).length)) };
  }

  /** Why there is no table. A class of the other table waits for its turn where a fit is searched. */
  function refusal(wanted, classes, isKnown) {
    const unknown = wanted.find((word) => !isKnown(word));
    if (unknown) return t('tables.none', { name: unknown });
    if (!classes.length) return t(`tables.elsewhere.${feature}`, { name: wanted[0] });
    return classes.length > MOST_CLASSES && t('tables.too_many', { count: classes.length, most: MOST_CLASSES });
  }

  async function refresh() {
    const wanted = understand();
    shown = wanted;
    if (wanted.refusal) wanted.classes = [];
    go({ view: 'tables', path: [feature], options: { find: find.value.trim() } }, { refine: true });
    if (wanted.refusal) return nothing(wanted.refusal);
    const { rows } = await tableRows(feature, wanted.classes);
    if (shown !== wanted) return null;
    note.textContent = copied;
    const matching = rows.filter((row) => holds(row, wanted.sizes));
    if (!matching.length) note.textContent = t('error.size.out_of_range');
    return table.replaceChildren(grid(matching, wanted.classes, names.own[feature]));
  }

  const holds = (row, sizes) => !sizes.length || sizes.some((size) => nmFromMm(row.over_mm) < size && size <= nmFromMm(row.up_to_mm));

  async function copy() {
    if (!shown.classes.length) return;
    try {
      const csv = await (await get(url(['tables', feature], { classes: shown.classes.join(','), format: 'csv' }))).text();
      const [head, ...rows] = csv.trim().split(/\r?\n/);
      const kept = rows.filter((row) => {
        const [over_mm, up_to_mm] = row.split(',');
        return holds({ over_mm, up_to_mm }, shown.sizes);
      });
      await copyText([head, ...kept, ''].join('\n'));
      copied = note.textContent = t('tables.copied', { count: kept.length });
    } catch (problem) {
      note.textContent = explain(problem);
    }
  }

  function drawFeatures() {
    refill(features, FEATURES.map((each) => h('button', {
      type: 'button', 'aria-pressed': String(each === feature), onclick: () => { feature = each; copied = ''; ask(true); },
    }, t(`tables.${each}`))));
    whole.href = url(['tables', feature], { format: 'csv' });
    whole.download = `${feature}.csv`;
  }

  const asked = new Asked(async (isAnew) => {
    if (isAnew || !names) {
      drawFeatures();
      names = await classNames();
      own.show(feature, names.own[feature]);
    }
    await refresh();
  }, { again: () => ask(true), say: (text) => text && nothing(text), leaving: leaving.signal });
  /** @param isAnew whether the classes may be others than those that are known */
  const ask = (isAnew) => asked.run(isAnew);

  /** No table stands below a note that says why there is none. */
  function nothing(reason) {
    note.textContent = reason;
    table.replaceChildren();
  }

  ask(true);
  followTables(leaving.signal, () => ask(true));
  return () => leaving.abort();
}

function grid(rows, classes, own) {
  const cell = (limits) => limits && [h('span', signed(limits.upper_um)), h('span', signed(limits.lower_um))];
  return h('table.grid',
    h('caption', t('tables.caption')),
    h('thead', h('tr', h('th', { scope: 'col' }, t('tables.over')), h('th', { scope: 'col' }, t('tables.up_to')),
      classes.map((name) => h('th', { scope: 'col', class: own.includes(name) && 'own-column' }, name,
        own.includes(name) && h('span.aside', t('limits.custom')))))),
    h('tbody', rows.map((row) => h('tr', h('th', { scope: 'row' }, number(row.over_mm)), h('td.up-to', number(row.up_to_mm)),
      classes.map((name) => h('td', { class: own.includes(name) && 'own-column' }, cell(row.limits[name])))))));
}

/** 25H7 as a size and a class. */
function parted(word) {
  const parsed = parseDesignation(word);
  return parsed ? [parsed.text.slice(0, -parsed.tolerance_class.length), parsed.tolerance_class] : [word];
}
