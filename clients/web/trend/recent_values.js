/** The newest measurements of a filter. The service lists from the oldest, so windows of time are tried. */

import { getJson, url } from '../api.js';
import { connection } from '../connection.js';

const HOURS = [0.05, 0.5, 4, 32, 256, 2048, Infinity];
const PAGE = 1000;
const MOST_PAGES = 20;

/** At most `count` records, the newest last. */
export async function newestValues(filter, count, signal) {
  let newest = [];
  for (const hours of HOURS) {
    const from = hours === Infinity ? '' : new Date(connection.now() - hours * 3600e3).toISOString();
    const { records, whole } = await tail({ ...filter, from }, count, signal);
    // A window too long to be read to its end says nothing about the newest.
    if (!whole && newest.length) return newest;
    newest = records;
    if (newest.length >= count || !whole) break;
  }
  return newest;
}

/** The last records of a list, and whether it was read to its end. */
async function tail(query, count, signal) {
  let records = [];
  let after = '';
  for (let page = 0; page < MOST_PAGES; ++page) {
    const { measurements, next } = await getJson(url(['measurements'], { ...query, limit: PAGE, after }), { signal });
    records = [...records, ...measurements].slice(-count);
    if (!next) return { records, whole: true };
    after = next;
  }
  return { records, whole: false };
}
