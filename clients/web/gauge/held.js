/** What the service gives, kept for when it is away. */

import { getJson, isAway, PATIENCE_MS, url } from '../api.js';
import { connection } from '../connection.js';
import { readJson, store } from '../stored.js';

/** Limits that were given since the tables changed last. */
let atHand = new Map();

/**
 * What the service gives at a path, or gave last where it is away.
 * @param parts of the path below /v1
 * @param otherwise where it never gave anything
 */
export async function held(parts, otherwise) {
  const kept = parts.join('.');
  // Nobody waits for a service that is known to be away.
  const last = connection.up ? undefined : readJson(kept, undefined);
  if (last) return last;
  try {
    const given = await getJson(url(parts), { timeout: PATIENCE_MS });
    store(kept, JSON.stringify(given));
    return given;
  } catch (problem) {
    if (!isAway(problem)) throw problem;
    return readJson(kept, otherwise);
  }
}

/** The limits of a size and class; null where the service is away and never gave any. */
export async function limitsOf(text) {
  const kept = atHand;
  const limits = await held(['limits', text], null);
  if (limits) kept.set(text, limits);
  return limits;
}

/** The limits at once; null where they have to be asked for. */
export const limitsAtHand = (text) => atHand.get(text) ?? null;

/** The tables may have changed. */
export const forgetAtHand = () => { atHand = new Map(); };
