/** The newest measurements of a filter. */

import { get, getJson, url } from '../api.js';
import { pause } from '../latest.js';

/** The service gives at most this many on a page; so many are read at once, then the page answers its reader. */
const PAGE = 1000;

/** At most `count` records, the newest last. More than a page are read as they come, without a trip for each page. */
export async function newestValues(filter, count, signal) {
  const wanted = { ...filter, sort: 'newest', notes: 'shown' };
  if (count <= PAGE) return (await getJson(url(['measurements'], { ...wanted, limit: count }), { signal })).measurements.reverse();
  const { body } = await get(url(['measurements'], { ...wanted, format: 'ndjson' }), { signal });
  const reader = body.pipeThrough(new TextDecoderStream()).getReader();
  const records = [];
  for (let begun = ''; records.length < count;) {
    const { value, done } = await reader.read();
    if (done) break;
    const lines = (begun + value).split('\n');
    begun = lines.pop();
    for (let i = 0; i < lines.length; i += PAGE) {
      for (const line of lines.slice(i, i + PAGE)) records.push(JSON.parse(line));
      await pause();
    }
  }
  await reader.cancel();
  return records.slice(0, count).reverse();
}
