/** What the service gives, kept for when it is away. */

import { getJson, PATIENCE_MS, url } from '../api.js';
import { readJson, store } from '../stored.js';

/**
 * What the service gives at a path, or gave last where it is away.
 * @param parts of the path below /v1
 * @param otherwise where it never gave anything
 */
export async function held(parts, otherwise) {
  const kept = parts.join('.');
  try {
    const given = await getJson(url(parts), { timeout: PATIENCE_MS });
    store(kept, JSON.stringify(given));
    return given;
  } catch (problem) {
    if (problem.status !== undefined) throw problem;
    return readJson(kept, otherwise);
  }
}

/** The limits of a size and class; null where the service is away and never gave any. */
export const limitsOf = (text) => held(['limits', text], null);
