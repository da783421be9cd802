/** The values of each machine, tool or operator as a box: quartiles, median, least and greatest, between the limits. */

import { field, h, refill, s } from '../dom.js';
import { NM_PER_UM, umText } from '../exact.js';
import { EDGE, Frame, round, WIDTH } from '../figures/frame.js';
import { signed, t } from '../i18n.js';
import { operatorOf } from '../verdict.js';

export const GROUPS = ['machine', 'tool', 'operator'];
/** So many groups with the most values. */
const MOST = 12;

/** Between the two values that are nearest to a share of them. */
function quantile(sorted, share) {
  const at = (sorted.length - 1) * share;
  const low = Math.floor(at);
  return sorted[low] + (at - low) * (sorted[Math.ceil(at)] - sorted[low]);
}

/** [[name, deviations in µm in order], …] of records that name one, by name. */
export function grouped(points, by) {
  const groups = new Map();
  for (const { record, deviation } of points.flatMap((point) => point.members ?? point)) {
    const name = by === 'operator' ? operatorOf(record) : record[by];
    if (name) groups.set(name, [...(groups.get(name) ?? []), deviation / NM_PER_UM]);
  }
  return [...groups].map(([name, values]) => [name, values.sort((one, other) => one - other)])
    .sort(([, one], [, other]) => other.length - one.length).slice(0, MOST).sort(([one], [other]) => one.localeCompare(other, undefined, { numeric: true }));
}

export class Boxes {
  /** @param by one of GROUPS; @param onChange is told of another choice */
  constructor(by, onChange) {
    this.points = [];
    this.select = h('select', { name: 'boxes', onchange: () => { this.#draw(); onChange(); } }, GROUPS.map((name) => h('option', { value: name, selected: name === by }, t(`field.${name}`))));
    this.place = h('div');
    this.element = h('details.boxes', { hidden: true, open: GROUPS.includes(by), ontoggle: () => { this.#draw(); onChange(); } }, h('summary', t('trend.boxes')), field(t('trend.boxes_by'), this.select), this.place);
  }

  /** What it shows, as the address has it; '' where it is closed. */
  get by() {
    return this.element.open ? this.select.value : '';
  }

  show(points) {
    this.points = points;
    this.element.hidden = !points.length;
    this.#draw();
  }

  #draw() {
    if (!this.element.open || !this.points.length) return;
    const groups = grouped(this.points, this.select.value);
    if (!groups.length) {
      refill(this.place, h('p.aside', t('trend.boxes_none')));
      return;
    }
    const { upper, lower } = this.points.at(-1);
    const limits = [['U', upper, -5], ['L', lower, 16]].filter(([, nm]) => Number.isFinite(nm)).map(([name, nm, below]) => ({ um: nm / NM_PER_UM, name: `${name} ${signed(umText(nm))}`, below }));
    const frame = new Frame(groups.map(([name]) => name), [...limits.map(({ um }) => um), ...groups.flatMap(([, values]) => [values[0], values.at(-1)])], { decimals: 1 });
    const half = round(Math.min(frame.step / 4, 28));
    refill(this.place, frame.draw(t('trend.boxes_title'), limits.map(({ um }) => s('path.bound', { d: `M${EDGE.left} ${frame.y(um)}H${WIDTH - EDGE.right}` })), groups.map(([name, values], i) => {
      const [least, q1, median, q3, most] = [0, 0.25, 0.5, 0.75, 1].map((share) => frame.y(quantile(values, share)));
      const x = frame.x(i);
      return s('g.group', s('title', `${name}: n = ${values.length}`), s('path.whisker', { d: `M${x} ${least}V${q1}M${x} ${q3}V${most}M${x - half / 2} ${least}h${half}M${x - half / 2} ${most}h${half}` }),
        s('rect.box', { x: x - half, y: q3, width: 2 * half, height: Math.max(round(q1 - q3), 1) }), s('path.median', { d: `M${x - half} ${median}h${2 * half}` }));
    }), limits.map(({ um, name, below }) => s('text.limit', { x: EDGE.left + 4, y: frame.y(um) + below }, name))), h('p.aside', groups.map(([name, values]) => `${name}: n = ${values.length}`).join(' · ')));
  }
}
