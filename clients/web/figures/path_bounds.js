/** The box around what matters of a run: the workpiece, the contacts and the probing moves, else every move. */

import { outlines } from './workpiece_outline.js';

const AXES = ['X', 'Y', 'Z'];

/** {low, high} as points. */
export function boundsOf(moves, features) {
  const low = { X: Infinity, Y: Infinity, Z: Infinity };
  const high = { X: -Infinity, Y: -Infinity, Z: -Infinity };
  const add = (point) => {
    for (const axis of AXES) {
      low[axis] = Math.min(low[axis], point[axis]);
      high[axis] = Math.max(high[axis], point[axis]);
    }
  };
  const ends = (move) => [move.start_mm, move.end_mm].forEach(add);
  for (const { points } of outlines(features, 'Y')) points.forEach(add);
  for (const move of moves) {
    if (move.kind === 'probe') ends(move);
    if (move.contact_mm) add(move.contact_mm);
  }
  if (low.X > high.X) moves.forEach(ends);
  return { low, high };
}
