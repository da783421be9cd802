/** Values set aside: the service says which are, by their notes. Figures leave them out (`set_aside=false`), charts and lists show them. */

import { getJson, url } from '../api.js';
import { field, h } from '../dom.js';
import { dateTime, t } from '../i18n.js';
import { orderOf } from '../parts/order.js';
import { nameOf, refusedWords, wordField } from '../parts/words.js';
import { measuredText, operatorOf, placesOf, recordMark } from '../verdict.js';

const [ASIDE, COUNTED] = ['set aside', 'counted again'];
const decides = ({ measure }) => measure === ASIDE || measure === COUNTED;

/** The note that sets a record aside, or undefined. */
export const asideOf = ({ set_aside: isAside, notes }) => (isAside ? notes.findLast(({ measure }) => measure === ASIDE) : undefined);

/** What the service says of the notes of a record now. */
export const readNotes = async (record, signal) => Object.assign(record, await getJson(url(['measurements', record.id, 'notes']), { signal }));

/** Whether a record has another note than these. */
export const isNoted = ({ notes = [] }) => notes.some((note) => !decides(note));

/** Asks for the reason and stores it; resolves to the note, or to null. */
export function askAside(record) {
  const isBack = asideOf(record) !== undefined;
  const [reason, operator] = ['reason', 'operator'].map((name) => wordField({ name }));
  const why = h('p.note', { role: 'alert' });
  let stored = null;
  function send(event) {
    event.preventDefault();
    const cause = reason.value.trim();
    const { name, why: wrong } = nameOf(operator, 'operator', record);
    const refused = cause ? refusedWords(reason) || wrong : t('aside.why');
    if (refused) why.textContent = refused;
    else order({ cause, measure: isBack ? COUNTED : ASIDE, ...(name && { operator: name }) });
  }
  const dialog = h('dialog', { 'aria-labelledby': 'aside-title' }, h('form', { novalidate: true, onsubmit: send },
    h('h2', { id: 'aside-title' }, t(isBack ? 'aside.back_title' : 'aside.title', { mm: measuredText(record), part: record.part_id ?? t('part.none') })),
    h('p', t('aside.rule')), field(t('correct.reason'), reason), field(t('field.operator'), operator), why,
    h('p.actions', h('button.primary', { type: 'submit' }, t(isBack ? 'aside.back' : 'aside.set')), h('button', { type: 'button', onclick: () => dialog.close('') }, t('confirm.cancel')))));
  const order = orderOf(dialog, url(['measurements', record.id, 'notes']), why, 'noted', (note) => { stored = note; });
  document.body.append(dialog);
  dialog.showModal();
  return new Promise((resolve) => {
    dialog.addEventListener('close', () => {
      dialog.remove();
      resolve(stored);
    });
  });
}

/** What is set aside among the points, the newest first. @param onGo takes the index of one; @param onBack a record */
export function asideList(points, onGo, onBack) {
  const found = points.map(({ record }, index) => ({ record, index, note: asideOf(record) })).filter(({ note }) => note).reverse();
  if (!found.length) return [];
  const places = placesOf(found.map(({ record }) => record));
  const head = ['trend.verdict', 'trend.value', 'field.part_id', 'correct.reason', 'field.operator', 'trend.time'].map((name) => h('th', { scope: 'col' }, t(name)));
  return [h('h2', t('aside.list', { count: found.length })), h('p.aside', t('aside.rule')),
    h('div.wide', { tabindex: 0, role: 'region', 'aria-label': t('aside.list', { count: found.length }) }, h('table', h('thead', h('tr', head, h('td'))),
      h('tbody', found.map(({ record, index, note }) => h('tr', h('td', recordMark(record)), h('th', { scope: 'row' }, h('button.quiet', { type: 'button', onclick: () => onGo(index) }, `${measuredText(record, places)} mm`)),
        h('td', record.part_id ?? ''), h('td', note.cause), h('td', operatorOf(note) ?? ''), h('td', dateTime(new Date(note.received_at))),
        h('td', h('button.quiet', { type: 'button', 'aria-label': t('aside.back_this', { mm: measuredText(record), part: record.part_id ?? t('part.none') }), onclick: () => onBack(record) }, t('aside.back')))))))),
  ];
}
