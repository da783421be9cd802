/** A note beside a record: why the value is what it is, and what was done about it. */

import { getJson, url } from '../api.js';
import { field, h } from '../dom.js';
import { ledger } from '../gauge/ledger.js';
import { t } from '../i18n.js';
import { measuredText } from '../verdict.js';
import { orderOf } from './order.js';
import { nameOf, refusedWords, wordField } from './words.js';

const PARTS = { cause: 200, measure: 200, text: 2000, operator: 200 };

/** What the shop's catalogues offer, each once; without the service nothing. */
async function offer(lists) {
  const { catalogues } = await getJson(url(['catalogues']), { asks: false });
  const all = await Promise.all(catalogues.map(({ name }) => getJson(url(['catalogues', name]), { asks: false })));
  for (const [name, list] of Object.entries(lists)) {
    const texts = new Set(all.flatMap((catalogue) => catalogue[`${name}s`]));
    list.replaceChildren(...[...texts].map((value) => h('option', { value })));
  }
}

/** Resolves to whether a note was added. */
export function note(record) {
  const lists = Object.fromEntries(['cause', 'measure'].map((name) => [name, h('datalist', { id: `noted-${name}` })]));
  const inputs = Object.fromEntries(Object.entries(PARTS).map(([name, maxlength]) => [name, wordField({ name, maxlength, list: lists[name]?.id })]));
  const why = h('p.note', { role: 'alert' });

  function send(event) {
    event.preventDefault();
    const { operator: of, ...words } = inputs;
    const { name: operator, why: wrong } = nameOf(of, 'operator', record);
    const said = Object.fromEntries(Object.entries(words).map(([name, input]) => [name, input.value.trim()]).filter(([, text]) => text));
    const refused = Object.values(words).map(refusedWords).find(Boolean) ?? wrong ?? (Object.keys(said).length ? '' : t('note.nothing'));
    if (refused) why.textContent = refused;
    else order({ ...said, ...(operator && { operator }) });
  }

  const dialog = h('dialog', { 'aria-labelledby': 'note-title' },
    h('form', { novalidate: true, onsubmit: send }, Object.values(lists),
      h('h2', { id: 'note-title' }, t('note.title', { mm: measuredText(record), part: record.part_id ?? t('part.none') })),
      h('p', t('note.how')),
      field(t('note.cause'), inputs.cause), field(t('note.measure'), inputs.measure), field(t('note.text'), inputs.text),
      field(t('field.operator'), inputs.operator), why,
      h('p.actions', h('button.primary', { type: 'submit' }, t('note.store')),
        h('button', { type: 'button', onclick: () => dialog.close('') }, t('confirm.cancel')))));
  const order = orderOf(dialog, url(['measurements', record.id, 'notes']), why, 'noted', (stored) => ledger.noted(stored));
  document.body.append(dialog);
  dialog.showModal();
  offer(lists).catch(() => {});
  return new Promise((resolve) => {
    dialog.addEventListener('close', () => {
      dialog.remove();
      resolve(dialog.returnValue === 'noted');
    });
  });
}
