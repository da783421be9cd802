/** Links that save or open what the service gives. */

import { get, keyInUse } from './api.js';
import { h } from './dom.js';
import { explain } from './i18n.js';

/**
 * A link whose `href` its owner sets; it saves with `download`, and opens with `target`. A link cannot send a key:
 * where one is in use, what it names is fetched and comes from memory. @param onProblem takes why it could not be
 * @param bounded whether the service may refuse it for its length: fetched too, so that the reason is said
 */
export function downloadLink(attributes, text, onProblem, { bounded = false } = {}) {
  const link = h('a.button', { ...attributes, onclick: (event) => {
    if (!keyInUse() && !bounded) return;
    event.preventDefault();
    fetched(link).catch((problem) => onProblem(explain(problem)));
  } }, text);
  return link;
}

async function fetched({ href, download, target }) {
  const bytes = URL.createObjectURL(await (await get(href)).blob());
  h('a', { href: bytes, download: download || null, target: target || null }).click();
  setTimeout(() => URL.revokeObjectURL(bytes), 60_000);
}
