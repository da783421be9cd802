/** A small chart for each characteristic, drawn anew as its values come: the newest values between their limits. */

import { h, refill, s } from '../dom.js';
import { number, t } from '../i18n.js';
import { fragment } from '../route.js';
import { asideOf } from '../trend/aside.js';
import { pointOf, rangeOf } from '../trend/series.js';
import { measuredText, recordMark, verdictShape } from '../verdict.js';
import { isDoubtful } from './standing.js';

const WIDTH = 300;
const HEIGHT = 96;
const INSET = 10;
const MARK = 14;
/** So many of the newest values. */
export const SHOWN = 50;

const round = (value) => Math.round(10 * value) / 10;

/** The newest values as a line, with a shape at each that is not good and at the newest one. */
export function spark(records) {
  const points = records.slice(-SHOWN).map(pointOf);
  const { high, low, upper, lower } = rangeOf(points);
  const x = (i) => round(INSET + (points.length > 1 ? i / (points.length - 1) : 1) * (WIDTH - 2 * INSET));
  const y = (nm) => round(INSET / 2 + (HEIGHT - INSET) * (high - Math.min(Math.max(nm, low), high)) / (high - low));
  const steps = (side) => points.map((point, i) => (Number.isFinite(point[side]) ? `${i ? 'L' : 'M'}${x(i)} ${y(point[side])}` : '')).join('');
  const marked = points.map(({ record, deviation }, i) => [record.verdict, x(i), y(deviation), i === points.length - 1]).filter(([verdict, , , isLast]) => verdict && (isLast || verdict !== 'good'));
  return s('svg.spark', { viewBox: `0 0 ${WIDTH} ${HEIGHT}`, 'aria-hidden': 'true' },
    Number.isFinite(upper) && Number.isFinite(lower) && s('rect.zone', { x: 0, y: y(upper), width: WIDTH, height: Math.max(round(y(lower) - y(upper)), 1) }),
    ['upper', 'lower'].filter((side) => Number.isFinite(points[0][side])).map((side) => s('path.limit', { d: steps(side) })),
    s('path.values', { d: points.map(({ deviation }, i) => `${i ? 'L' : 'M'}${x(i)} ${y(deviation)}`).join('') }),
    marked.map(([verdict, cx, cy]) => {
      const shape = verdictShape(verdict);
      for (const [name, value] of Object.entries({ x: cx - MARK / 2, y: cy - MARK / 2, width: MARK, height: MARK })) shape.setAttribute(name, value);
      return shape;
    }));
}

export class Wall {
  /** @param options of the address of a trend */
  constructor(options) {
    this.options = options;
    this.element = h('ul.wall', { 'aria-label': t('wall.title') });
  }

  /** @param standings [[name, standing]], in the order of the charts */
  show(standings) {
    refill(this.element, standings.map(([name, standing]) => this.#card(name, standing)));
  }

  #card(name, standing) {
    const { ppk } = standing;
    const records = standing.records.filter((record) => !asideOf(record));
    const last = records.at(-1);
    return h('li.sheet', { 'data-verdict': last?.verdict },
      h('div.line', h('h2', h('a', { href: fragment({ view: 'trend', options: { ...this.options(), characteristic: name } }) }, name)),
        ppk && h('span', { class: isDoubtful(standing) ? 'ppk in-doubt' : 'ppk' }, `Ppk ${number(ppk.value.toFixed(2))}`)),
      last ? spark(records) : h('p.empty', t('overview.nothing')),
      last && h('div.line.last', recordMark(last), h('strong', `${measuredText(last)} mm`), last.part_id && h('span.aside', last.part_id)));
  }
}
