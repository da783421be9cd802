/** The newest measurements of a filter. */

import { getJson, url } from '../api.js';

/** The service gives at most this many at once. */
const PAGE = 1000;

/** At most `count` records, the newest last. */
export async function newestValues(filter, count, signal) {
  let records = [];
  let after = '';
  do {
    const limit = Math.min(count - records.length, PAGE);
    const page = await getJson(url(['measurements'], { ...filter, sort: 'newest', limit, after }), { signal });
    records = [...records, ...page.measurements];
    after = page.next ?? '';
  } while (after && records.length < count);
  return records.reverse();
}
