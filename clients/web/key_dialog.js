/** Asks for an API key when the service wants one. One question at a time, however many calls wait. */

import { field, h } from './dom.js';
import { BurstWatch } from './gauge/reading.js';
import { t } from './i18n.js';

/** Every key of the service begins so. */
const KEY = /^fg_/;

let asking = null;

/** Resolves to the key that was entered, or to null. */
export function enterKey(problem) {
  asking ??= ask(problem).finally(() => { asking = null; });
  return asking;
}

function ask(problem) {
  const before = document.activeElement;
  const watch = new BurstWatch();
  const input = h('input', {
    type: 'password', autocomplete: 'off', spellcheck: 'false', required: true,
    onkeydown: ({ key, timeStamp }) => key.length === 1 && watch.key(timeStamp),
  });
  const note = h('p.note', { role: 'alert' });
  const dialog = h('dialog', { 'aria-labelledby': 'key-title' },
    h('form', { method: 'dialog', onsubmit: (event) => take(event) },
      h('h2', { id: 'key-title' }, t('key.title')),
      h('p', t(['auth.invalid', 'auth.expired'].includes(problem.code) ? 'key.invalid' : 'key.why')),
      field(t('key.label'), input, t('key.hint')), note,
      h('p.actions', h('button.primary', { value: 'use' }, t('key.use')),
        h('button', { value: '', formnovalidate: true }, t('key.cancel')))));

  /** Who gauges goes on: a scan or a value that was typed here goes where scans and values go. */
  function take(event) {
    const text = input.value.trim();
    if (event.submitter?.value === '' || KEY.test(text)) return;
    event.preventDefault();
    dispatchEvent(new CustomEvent('strayline', { detail: { text, burst: watch.isBurst(text) } }));
    note.textContent = t('key.none');
    input.value = '';
    watch.reset();
  }

  document.body.append(dialog);
  dialog.showModal();
  return new Promise((resolve) => {
    dialog.addEventListener('close', () => {
      dialog.remove();
      // The caret went with the dialog: to focus a field that has the focus would not bring it back.
      before?.blur();
      before?.focus();
      resolve(dialog.returnValue === 'use' ? input.value.trim() : null);
    });
  });
}
