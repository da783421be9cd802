/** What a dialog orders of the service: once, however often its button is pressed and however late the answer comes. */

import { request } from '../api.js';
import { toJson } from '../exact.js';
import { explain } from '../i18n.js';
import { randomText } from '../queue.js';

const TIMEOUT_MS = 10000;

/**
 * @param note takes why it was refused; @param done what the dialog closes with; @param onDone takes what the service has made of it. Until there is an answer nothing closes it:
 *   whoever has given it up would not know that it was stored.
 * @returns takes the body and posts it; one that is posted again after an answer was lost is the same order
 */
export function orderOf(dialog, path, note, done, onDone = () => {}) {
  let last = {};
  for (const type of ['click', 'submit', 'cancel']) {
    dialog.addEventListener(type, (event) => {
      if (!dialog.ariaBusy) return;
      event.preventDefault();
      event.stopPropagation();
    }, { capture: true });
  }
  return async (order) => {
    const body = toJson(order);
    if (body !== last.body) last = { body, key: randomText() };
    dialog.ariaBusy = 'true';
    note.textContent = '';
    try {
      const answer = await request('POST', path, { body, timeout: TIMEOUT_MS, headers: { 'Content-Type': 'application/json', 'Idempotency-Key': `"${last.key}"` } });
      onDone(await answer.json());
      dialog.close(done);
    } catch (problem) {
      note.textContent = explain(problem);
    } finally {
      dialog.ariaBusy = null;
    }
  };
}
