/** Asks for an API key when the service wants one. One question at a time, however many calls wait. */

import { field, h } from './dom.js';
import { parseMeasured } from './exact.js';
import { t } from './i18n.js';

let asking = null;

/** Resolves to the key that was entered, or to null. */
export function enterKey(problem) {
  asking ??= ask(problem).finally(() => { asking = null; });
  return asking;
}

function ask(problem) {
  const before = document.activeElement;
  const input = h('input', { type: 'password', autocomplete: 'off', spellcheck: 'false', required: true });
  const dialog = h('dialog', { 'aria-labelledby': 'key-title' },
    h('form', { method: 'dialog', onsubmit: (event) => isReading(event, input) },
      h('h2', { id: 'key-title' }, t('key.title')),
      h('p', t(problem.code === 'auth.invalid' ? 'key.invalid' : 'key.why')),
      field(t('key.label'), input, t('key.hint')),
      h('p.actions', h('button.primary', { value: 'use' }, t('key.use')),
        h('button', { value: '', formnovalidate: true }, t('key.cancel')))));
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

/** A key is never a number: a gauge typed this, and its value goes where values go. */
function isReading(event, input) {
  if (event.submitter?.value === '' || parseMeasured(input.value) === null) return;
  event.preventDefault();
  dispatchEvent(new CustomEvent('strayline', { detail: input.value.trim() }));
  input.value = '';
}
