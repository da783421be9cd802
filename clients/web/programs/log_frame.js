/** A file a run has written, in a frame that runs no script and reaches nothing. */

import { get, keyInUse, url } from '../api.js';
import { h } from '../dom.js';

/** A frame cannot send a key: with one the file is fetched and shown without its own styles. */
export async function logFrame(run, name) {
  const address = url(['runs', run, 'files', name]);
  if (!keyInUse()) return h('iframe', { sandbox: '', src: address, title: name });
  const response = await get(address);
  const text = await response.text();
  return response.headers.get('Content-Type')?.startsWith('text/html')
    ? h('iframe', { sandbox: '', srcdoc: text, title: name }) : h('pre', text);
}
