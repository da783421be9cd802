/** The tolerance classes there are, sorted as in ISO 286, and the row a size falls into. */

import { getJson, url } from '../api.js';
import { nmFromMm } from '../exact.js';

const ISO_CLASS = /^([A-Za-z]{1,2})(01|0|[1-9]|1[0-8])$/;

/** {letters: "JS", grade: "7"}; null for a custom tolerance class. */
export function isoClass(name) {
  const match = ISO_CLASS.exec(name);
  return match && { letters: match[1], grade: match[2] };
}

/** {revision, hole: [names], shaft: [names], own: {hole: [names], shaft: [names]}} */
export async function classNames() {
  const { revision, tables } = await getJson(url(['tables']));
  const of = (member) => Object.fromEntries(tables.map((table) => [table.feature, table[member]]));
  return { revision, ...of('classes'), own: of('own') };
}

export const tableRows = (feature, classes) => getJson(url(['tables', feature], { classes: classes.join(',') }));

/** The row whose range holds a size in nm. */
export const rowOf = (rows, size) => rows.find((row) => nmFromMm(row.over_mm) < size && size <= nmFromMm(row.up_to_mm));
