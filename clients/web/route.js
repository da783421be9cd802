/** The URL is the state: #/fit/25H7/g6?hole=25.013 names a view, its path and its options. */

import { readStored, store } from './stored.js';

/** What the fragment says: {view, path: [...], options: {...}}. */
export function currentRoute() {
  const [path, query = ''] = location.hash.replace(/^#\/?/, '').split('?');
  const [view, ...rest] = path.split('/').filter(Boolean).map(decoded);
  return { view, path: rest, options: Object.fromEntries(new URLSearchParams(query)) };
}

/** An address may be cut or mistyped: what cannot be decoded stands as it is. */
function decoded(text) {
  try {
    return decodeURIComponent(text);
  } catch {
    return text;
  }
}

export function fragment({ view, path = [], options = {} }) {
  const given = Object.entries(options).filter(([, value]) => value !== '' && value !== undefined && value !== null);
  const query = new URLSearchParams(given).toString();
  return `#/${[view, ...path].map(encodeURIComponent).join('/')}${query && `?${query}`}`;
}

/**
 * Goes to a state; a new entry of the history unless it only refines the one shown. A view that was
 * left refines nothing.
 * @param quiet whether the place within the view alone has changed, which nothing else shows
 */
export function go(route, { refine = false, quiet = false } = {}) {
  const next = fragment(route);
  if (next === location.hash) return;
  const shown = currentRoute().view;
  if (refine && shown && shown !== route.view) return;
  history[refine ? 'replaceState' : 'pushState'](null, '', next);
  remember(route.view);
  if (!quiet) dispatchEvent(new Event('routechange'));
}

/** A view comes back as it was left. */
export const remember = (view) => store(`view.${view}`, location.hash, 'session');
export const lastOf = (view) => readStored(`view.${view}`, 'session') ?? `#/${view}`;
