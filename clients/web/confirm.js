/** Asks before something is lost. */

import { h } from './dom.js';
import { t } from './i18n.js';

/** @param act the word on the button that does it. Resolves to whether it is to be done. */
export function confirm(question, act) {
  const dialog = h('dialog', { 'aria-labelledby': 'confirm-title' },
    h('form', { method: 'dialog' }, h('h2', { id: 'confirm-title' }, question),
      h('p.actions', h('button.primary', { value: 'yes' }, act), h('button', { value: '', autofocus: true }, t('confirm.cancel')))));
  document.body.append(dialog);
  dialog.showModal();
  return new Promise((resolve) => {
    dialog.addEventListener('close', () => {
      dialog.remove();
      resolve(dialog.returnValue === 'yes');
    });
  });
}
