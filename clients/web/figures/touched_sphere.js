/** Where the sphere on a table that turns stood: in the middle of what was touched at each position of the rotary axes. */

import { KINDS } from './trace.js';

const PROBE = KINDS.indexOf('probe');
/** Less is no sphere: the points lie in one plane. */
const FLAT = 1e-9;

export const poseName = (degrees = {}) => JSON.stringify(degrees);

/** [{name, degrees, centre: [x, y, z] in mm}], one each time the axes stand otherwise. @param trace a Trace */
export function touchedSpheres(trace) {
  const spots = [];
  for (let i = 0; i < trace.length; ++i) {
    if (trace.kinds[i] !== PROBE) continue;
    const { contact_mm: contact, end_deg: degrees } = trace.at(i);
    if (!contact) continue;
    const name = poseName(degrees);
    if (spots.at(-1)?.name !== name) spots.push({ name, degrees, points: [] });
    spots.at(-1).points.push([contact.X, contact.Y, contact.Z]);
  }
  return spots.map(({ points, ...spot }) => ({ ...spot, centre: sphereCentre(points) })).filter(({ centre }) => centre);
}

/** The centre of the sphere through points, by least squares: 2 x·c + k = x·x. @returns null where they do not make one */
export function sphereCentre(points) {
  const rows = points.map((point) => [...point.map((value) => 2 * value), 1, point.reduce((sum, value) => sum + value * value, 0)]);
  const normal = Array.from({ length: 4 }, (_, i) => Array.from({ length: 5 }, (__, k) => rows.reduce((sum, row) => sum + row[i] * row[k], 0)));
  for (let i = 0; i < 4; ++i) {
    const best = normal.slice(i).reduce((most, row) => (Math.abs(row[i]) > Math.abs(most[i]) ? row : most));
    if (Math.abs(best[i]) < FLAT) return null;
    normal.splice(normal.indexOf(best), 1);
    normal.splice(i, 0, best);
    for (let k = 0; k < 4; ++k) {
      if (k === i) continue;
      const factor = normal[k][i] / best[i];
      normal[k] = normal[k].map((value, at) => value - factor * best[at]);
    }
  }
  return [0, 1, 2].map((i) => normal[i][4] / normal[i][i]);
}
