/** The newest measurements of a filter. */

import { getJson, url } from '../api.js';

/** The service gives at most this many at once. */
const MOST = 1000;

/** At most `count` records, the newest last. */
export async function newestValues(filter, count, signal) {
  const { measurements } = await getJson(url(['measurements'], { ...filter, last: Math.min(count, MOST) }), { signal });
  return measurements;
}
