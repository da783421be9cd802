/** The box around what matters of a run: the workpiece, the contacts and the probing moves, else every move. */

import { KINDS } from './trace.js';
import { outlines } from './workpiece_outline.js';

const AXES = ['X', 'Y', 'Z'];
const PROBE = KINDS.indexOf('probe');

/** {low, high} as points. @param trace a Trace */
export function boundsOf(trace, features) {
  const low = [Infinity, Infinity, Infinity];
  const high = [-Infinity, -Infinity, -Infinity];
  const add = (numbers, from, to) => {
    for (let at = from; at < to; ++at) {
      const axis = (at - from) % 3;
      if (numbers[at] < low[axis]) low[axis] = numbers[at];
      if (numbers[at] > high[axis]) high[axis] = numbers[at];
    }
  };
  for (const { points } of outlines(features, 'Y')) for (const point of points) add(AXES.map((axis) => point[axis]), 0, 3);
  for (let i = 0; i < trace.length; ++i) if (trace.kinds[i] === PROBE) add(trace.ends, 6 * i, 6 * i + 6);
  add(trace.contacts, 0, trace.contacts.length);
  if (low[0] > high[0]) add(trace.ends, 0, trace.ends.length);
  const point = (values) => Object.fromEntries(AXES.map((axis, i) => [axis, values[i]]));
  return { low: point(low), high: point(high) };
}
