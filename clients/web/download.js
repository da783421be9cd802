/** Links that save what the service gives. */

import { get, keyInUse } from './api.js';
import { h } from './dom.js';
import { explain } from './i18n.js';

/**
 * A link whose `href` and `download` its owner sets. A link cannot send a key: where one is in use, what it
 * names is fetched and saved from memory. @param onProblem takes why it could not be
 */
export function downloadLink(attributes, text, onProblem) {
  const link = h('a.button', { ...attributes, onclick: (event) => {
    if (!keyInUse()) return;
    event.preventDefault();
    save(link.href, link.download).catch((problem) => onProblem(explain(problem)));
  } }, text);
  return link;
}

async function save(address, name) {
  const bytes = URL.createObjectURL(await (await get(address)).blob());
  const link = h('a', { href: bytes, download: name });
  link.click();
  setTimeout(() => URL.revokeObjectURL(bytes), 60_000);
}
