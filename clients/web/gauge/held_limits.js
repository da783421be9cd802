/** The limits of a size and class: asked of the service, and kept for when it is away. */

import { getJson, PATIENCE_MS, url } from '../api.js';
import { readJson, store } from '../stored.js';

const KEPT = 'limits';

/** The limits the service gives, or gave last where it is away; null where it never gave any. */
export async function limitsOf(text) {
  const kept = `${KEPT}.${text}`;
  try {
    const limits = await getJson(url(['limits', text]), { timeout: PATIENCE_MS });
    store(kept, JSON.stringify(limits));
    return limits;
  } catch (problem) {
    if (problem.status !== undefined) throw problem;
    return readJson(kept, null);
  }
}
