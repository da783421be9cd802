/** Documents of the service: each is stored with the state that was read, so that nothing is replaced before somebody says so. */

import { get, request, url } from './api.js';
import { confirm } from './confirm.js';
import { h, refill } from './dom.js';
import { t } from './i18n.js';

/** A document as {body, tag}; the tag names the state that was read. @param path such as ['plans', part] */
export async function readDocument(path, signal) {
  const response = await get(url(path), { signal });
  return { body: await response.json(), tag: response.headers.get('ETag') };
}

/** {body: null, tag: null} if there is none. */
export const findDocument = (path, signal) => readDocument(path, signal).catch((problem) => {
  if (problem.status === 404) return { body: null, tag: null };
  throw problem;
});

/** @param tag of the state that was read; null: there was none; undefined: whatever stands there. @returns the new tag */
export async function writeDocument(path, body, tag) {
  const condition = tag === undefined ? {} : tag === null ? { 'If-None-Match': '*' } : { 'If-Match': tag };
  return (await request('PUT', url(path), { body, headers: condition })).headers.get('ETag');
}

export const removeDocument = (path, tag) => request('DELETE', url(path), { headers: tag ? { 'If-Match': tag } : {} });

/** Asks whether what was typed and not stored may go. */
export const mayDrop = () => confirm(t('document.drop_sure'), t('document.drop'));
/** Asks whether what is stored under these names may be replaced. */
export const mayReplace = (names) => confirm(t('document.replace_sure', { names: names.join(', ') }), t('document.replace'));

/** Stores what may be there already. @param write takes conditions such as If-None-Match. @returns whether it is stored */
export async function writeOrAsk(name, write) {
  try {
    await write({ 'If-None-Match': '*' });
  } catch (problem) {
    if (problem.status !== 412) throw problem;
    if (!await mayReplace([name])) return false;
    await write();
  }
  return true;
}

/**
 * Says in `note` that another was stored first, and what can be done.
 * @param isNew whether none was read before; @param open shows the stored one; @param replace stores in its place
 */
export function sayStoredFirst(note, name, isNew, { open, replace }) {
  const act = (word, onclick) => h('button', { type: 'button', onclick }, t(`document.${word}`));
  refill(note, t(isNew ? 'document.exists' : 'document.changed', { name }), ' ', act(isNew ? 'open_it' : 'theirs', open), ' ', act('mine', replace));
}
