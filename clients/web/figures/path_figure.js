/** The path of a run and its contacts in plan (X, Y) and from the side (X, Z), true to scale. */

import { h, s } from '../dom.js';
import { t } from '../i18n.js';
import { boundsOf } from './path_bounds.js';
import { KINDS } from './trace.js';
import { outlines } from './workpiece_outline.js';

const SIZE = 480;
const MARGIN = 0.12;
const AXES = ['X', 'Y', 'Z'];

/** {element, show}: `show` marks one move. @param trace a Trace; @param features of the workpiece, drawn behind them */
export function pathFigure(trace, features) {
  const views = [['Y', 'programs.plan'], ['Z', 'programs.side']];
  const drawn = views.map(([up, name]) => [name, view(up, trace, features, t(name))]);
  const element = h('div.paths', drawn.map(([name, { figure }]) => h('figure', h('figcaption', t(name)), figure)));
  return { element, show: (move) => drawn.forEach(([, { mark }]) => mark(move)) };
}

/** What the lines and points of a path mean. */
export const pathLegend = (trace) => h('ul.legend', KINDS.filter((_, kind) => trace.kinds.includes(kind)).map((kind) =>
  h('li', s('svg', { viewBox: '0 0 32 12', 'aria-hidden': 'true' }, s(`path.${kind}`, { d: 'M0 6H32' })), t(`programs.kind.${kind}`))),
trace.contacts.length > 0 && h('li', s('svg', { viewBox: '0 0 32 12', 'aria-hidden': 'true' }, s('circle.contact', { cx: 16, cy: 6, r: 5 })), t('programs.kind.contact')));

function view(up, trace, features, name) {
  const behind = outlines(features, up);
  const frame = frameOf(up, boundsOf(trace, features));
  const height = AXES.indexOf(up);
  const place = (x, y) => [SIZE * (x - frame.left) / frame.size, SIZE * (frame.top - y) / frame.size].map((value) => value.toFixed(1));
  const at = (point) => place(point.X, point[up]).join(' ');
  const atNumber = (numbers, first) => place(numbers[first], numbers[first + height]);
  const scale = SIZE / frame.size;
  const here = s('g.here');
  const figure = s('svg.path-view', { viewBox: `0 0 ${SIZE} ${SIZE}`, role: 'img', 'aria-label': `${name}: ${t('programs.path_summary', { moves: trace.length, contacts: trace.contacts.length / 3 })}` },
    behind.map(({ kind, points, round }) => (round
      ? s(`circle.${kind}`, { cx: at(round.centre).split(' ')[0], cy: at(round.centre).split(' ')[1], r: (round.radius * scale).toFixed(1) })
      : s(`path.${kind}`, { d: `M${points.map(at).join('L')}Z` }))),
    Object.entries(trace.endsByKind).map(([kind, ends]) => s(`path.${kind}`, { d: segments(ends, atNumber) })),
    Array.from({ length: trace.contacts.length / 3 }, (_, i) => atNumber(trace.contacts, 3 * i)).map(([cx, cy]) => s('circle.contact', { cx, cy, r: 5 })),
    s('text', { x: SIZE - 6, y: SIZE - 8, 'text-anchor': 'end' }, `X → ${up} ↑`), here);
  const mark = (move) => {
    const [x, y] = at(move.end_mm).split(' ');
    here.replaceChildren(s('path', { d: `M${at(move.start_mm)}L${at(move.end_mm)}` }), s('circle', { cx: x, cy: y, r: 8 }));
  };
  return { figure, mark };
}

function segments(ends, atNumber) {
  let path = '';
  for (let i = 0; i < ends.length; i += 6) path += `M${atNumber(ends, i).join(' ')}L${atNumber(ends, i + 3).join(' ')}`;
  return path;
}

/** A square around what matters. */
function frameOf(up, { low, high }) {
  const size = Math.max(high.X - low.X, high[up] - low[up], 1) * (1 + 2 * MARGIN);
  return { size, left: (low.X + high.X - size) / 2, top: (low[up] + high[up] + size) / 2 };
}
