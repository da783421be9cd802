/** Corrects a record, its value or its part: a new record that names the old one, with the reason. */

import { url } from '../api.js';
import { field, h } from '../dom.js';
import { Decimal, LARGEST_NM, leastOf, nmFromMm, parseLength } from '../exact.js';
import { ledger } from '../gauge/ledger.js';
import { isFar } from '../gauge/reading.js';
import { number, t } from '../i18n.js';
import { measuredText } from '../verdict.js';
import { orderOf } from './order.js';
import { nameOf, refusedWords, wordField } from './words.js';

/** Resolves to whether the record was corrected. */
export function correct(record) {
  const text = (value) => {
    const input = h('input', { type: 'text', autocomplete: 'off', spellcheck: 'false', maxlength: 200 });
    input.value = value;
    return input;
  };
  const value = text(measuredText(record));
  const part = text(record.part_id ?? '');
  const reason = wordField();
  const note = h('p.note', { role: 'alert' });
  let asked = '';

  /** What is sent, or null with a note why not. */
  function correction() {
    const refuse = (why) => { note.textContent = why; return null; };
    const measured = parseLength(value.value.trim());
    const nm = measured === null ? NaN : nmFromMm(measured);
    if (!(nm >= leastOf(record) && nm <= LARGEST_NM)) return refuse(t('correct.malformed', { typed: value.value.trim() }));
    const own = record.part_id ?? '';
    const { name: named, why } = part.value.trim() === own ? { name: own } : nameOf(part, 'part_id', record);
    if (why) return refuse(why);
    const same = nm === nmFromMm(String(record.measured_mm));
    if (same && named === own) return refuse(t('correct.nothing'));
    if (!reason.value.trim()) return refuse(t('correct.why'));
    const wrong = refusedWords(reason);
    if (wrong) return refuse(wrong);
    if (!same && isFar(nm, { limits: record }) && asked !== measured) {
      asked = measured;
      return refuse(t('correct.far', { mm: number(measured) }));
    }
    const confirmed = same ? record.confirmed : isFar(nm, { limits: record });
    return { measured_mm: new Decimal(measured), ...(confirmed && { confirmed: true }), ...(named && { part_id: named }), reason: reason.value.trim() };
  }

  function send(event) {
    event.preventDefault();
    const body = correction();
    if (body) order(body);
  }

  const dialog = h('dialog', { 'aria-labelledby': 'correct-title' },
    h('form', { novalidate: true, onsubmit: send },
      h('h2', { id: 'correct-title' }, t('correct.title', { mm: measuredText(record), part: record.part_id ?? t('part.none') })),
      h('p', t('correct.how')),
      field(t('entry.label'), value), field(t('field.part_id'), part), field(t('correct.reason'), reason), note,
      h('p.actions', h('button.primary', { type: 'submit' }, t('correct.store')),
        h('button', { type: 'button', onclick: () => dialog.close('') }, t('confirm.cancel')))));
  const order = orderOf(dialog, url(['measurements', record.id, 'corrections']), note, 'corrected', (made) => ledger.told(made));
  document.body.append(dialog);
  dialog.showModal();
  value.select();
  return new Promise((resolve) => {
    dialog.addEventListener('close', () => {
      dialog.remove();
      resolve(dialog.returnValue === 'corrected');
    });
  });
}
