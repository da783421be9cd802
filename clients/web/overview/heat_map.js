/** Parts by characteristic: where each value lies in its tolerance, and its verdict. The arrow keys go from cell to cell. */

import { h, refill, s } from '../dom.js';
import { dateTime, t } from '../i18n.js';
import { fragment } from '../route.js';
import { asideOf } from '../trend/aside.js';
import { pointOf } from '../trend/series.js';
import { distanceText, measuredText, placesOf, recordMark, verdictShape, VERDICTS } from '../verdict.js';

const CELL = { width: 26, widest: 44, height: 30 };
const HEAD = 58;
/** What the slanting name of the last part needs at the right. */
const SLANT = 34;
/** Of the names at the left, at most this share of the width. */
const NAMES = { widest: 220, share: 0.36, letter: 8 };
const MOST_PARTS = 60;
const STEPS = { ArrowLeft: [0, -1], ArrowRight: [0, 1], ArrowUp: [-1, 0], ArrowDown: [1, 0], Home: [0, -MOST_PARTS], End: [0, MOST_PARTS] };

/** From -1 at the lower limit to 1 at the upper one; null without two limits. */
export function placeOf(record) {
  const { deviation, upper, lower } = pointOf(record);
  return Number.isFinite(upper - lower) && upper > lower ? (2 * deviation - upper - lower) / (upper - lower) : null;
}

/** The newest parts, the newest last, and the value in force of each characteristic. @param standings {name: {records}} */
export function partsOf(standings, most) {
  const parts = new Map();
  for (const [name, { records }] of standings) {
    for (const record of records) {
      if (!record.part_id) continue;
      const part = parts.get(record.part_id) ?? { name: record.part_id, last: '', values: new Map() };
      part.values.set(name, record);
      if (record.measured_at > part.last) part.last = record.measured_at;
      parts.set(record.part_id, part);
    }
  }
  return [...parts.values()].sort((one, other) => one.last.localeCompare(other.last)).slice(-most);
}

const cut = (text, most) => (text.length > most ? `${text.slice(0, most - 1)}…` : text);

export class HeatMap {
  #at = null;
  #width = 0;

  /** @param leaving ends it; @param options of the address of a trend */
  constructor(leaving, options) {
    this.options = options;
    this.picture = h('div.picture', { tabindex: 0, role: 'application', 'aria-label': t('heat.browse'), onkeydown: (event) => this.#browse(event), onclick: (event) => this.#touch(event) });
    this.said = h('div.detail', { role: 'status' });
    this.figures = h('details', { ontoggle: () => this.#drawFigures() }, h('summary', t('heat.table')));
    this.element = h('div.sheet.heat', this.picture, legend(), this.said, this.figures);
    const resized = new ResizeObserver(() => this.picture.clientWidth !== this.#width && this.#draw());
    resized.observe(this.picture);
    leaving.addEventListener('abort', () => resized.disconnect());
  }

  /** @param standings [[name, {records}]], in the order of the rows */
  show(standings) {
    this.standings = standings;
    this.#draw();
  }

  #draw() {
    this.#width = this.picture.clientWidth;
    if (!this.#width || !this.standings) return;
    const longest = Math.max(...this.standings.map(([name]) => name.length));
    this.left = Math.round(Math.min((longest + 2) * NAMES.letter, NAMES.widest, this.#width * NAMES.share));
    const fit = Math.max(Math.floor((this.#width - this.left - SLANT) / CELL.width), 1);
    this.parts = partsOf(this.standings, Math.min(fit, MOST_PARTS));
    this.cell = Math.min(Math.floor((this.#width - this.left - SLANT) / Math.max(this.parts.length, 1)), CELL.widest);
    const every = Math.ceil(30 / this.cell);
    const height = HEAD + this.standings.length * CELL.height + 2;
    refill(this.picture, s('svg', { width: this.#width, height, 'aria-hidden': 'true' },
      this.parts.map((part, i) => i % every === 0 && s('text.of-part', { transform: `translate(${this.left + (i + 0.62) * this.cell} ${HEAD - 8}) rotate(-45)` }, cut(part.name, 9))),
      this.standings.map(([name], row) => [
        s('text', { x: this.left - 10, y: HEAD + (row + 0.68) * CELL.height, 'text-anchor': 'end' }, cut(name, Math.floor(this.left / NAMES.letter) - 1)),
        this.parts.map(({ values }, i) => this.#cell(values.get(name), i, row))])));
    this.#say();
    this.#drawFigures();
  }

  #cell(record, column, row) {
    const x = this.left + column * this.cell;
    const y = HEAD + row * CELL.height;
    const box = { x: x + 1, y: y + 1, width: this.cell - 2, height: CELL.height - 2 };
    const isHere = this.#at && this.#at.row === row && this.#at.part === this.parts[column].name;
    return s('g', { class: isHere ? 'cell here' : 'cell', 'data-verdict': record ? (asideOf(record) ? 'aside' : record.verdict ?? 'unjudged') : 'none' },
      s('rect', box), record && mark(record, box), isHere && s('rect.ring', box));
  }

  #touch({ clientX, clientY }) {
    const { left, top } = this.picture.getBoundingClientRect();
    const row = Math.floor((clientY - top - HEAD) / CELL.height);
    const part = this.parts?.[Math.floor((clientX - left - this.left) / this.cell)];
    if (!part || row < 0 || row >= this.standings.length) return;
    this.#go(row, part.name);
  }

  #browse(event) {
    const step = STEPS[event.key];
    if (!step || !this.parts?.length) return;
    event.preventDefault();
    const column = this.parts.findIndex(({ name }) => name === this.#at?.part);
    const within = (value, count) => Math.min(Math.max(value, 0), count - 1);
    const start = column < 0 ? [0, this.parts.length - 1] : [within(this.#at.row + step[0], this.standings.length), within(column + step[1], this.parts.length)];
    this.#go(start[0], this.parts[start[1]].name);
  }

  #go(row, part) {
    this.#at = { row, part };
    this.#draw();
  }

  #say() {
    const part = this.parts.find(({ name }) => name === this.#at?.part);
    const name = this.standings[this.#at?.row]?.[0];
    if (!part || !name) return refill(this.said, h('p.aside', t('heat.pick')));
    const record = part.values.get(name);
    const links = [h('a', { href: fragment({ view: 'parts', options: { part_id: part.name } }) }, part.name), h('a', { href: fragment({ view: 'trend', options: { ...this.options(), characteristic: name } }) }, name)];
    return refill(this.said, h('div.line', links, record ? [recordMark(record), h('strong', `${measuredText(record)} mm`), h('span', distanceText(record)), asideOf(record) && h('span.aside', `${t('aside.mark')}: ${asideOf(record).cause}`), h('span.aside', dateTime(new Date(record.measured_at)))]
      : h('span', t('heat.none'))));
  }

  /** The same in figures, for those who do not see it. */
  #drawFigures() {
    if (!this.figures.open || !this.parts) return;
    const [summary] = this.figures.children;
    const names = this.standings.map(([name]) => name);
    const places = names.map((name) => placesOf(this.parts.flatMap(({ values }) => values.get(name) ?? [])));
    this.figures.replaceChildren(summary, h('div.scroll', { tabindex: 0, role: 'region', 'aria-label': t('heat.table') }, h('table',
      h('thead', h('tr', h('th', { scope: 'col' }, t('field.part_id')), names.map((name) => h('th', { scope: 'col' }, name)))),
      h('tbody', [...this.parts].reverse().map((part) => h('tr', h('th', { scope: 'row' }, part.name), names.map((name, i) => {
        const record = part.values.get(name);
        return h('td', record ? [recordMark(record), ` ${measuredText(record, places[i])}`] : '–');
      })))))));
  }
}

/** A good value is a bar at its place between the limits, darker towards them; another its verdict. */
function mark(record, { x, y, width, height }) {
  const place = placeOf(record);
  if (asideOf(record)) return s('path.aside-mark', { d: `M${x + 6} ${y + 8}l${width - 12} ${height - 16}m0 ${16 - height}l${12 - width} ${height - 16}` });
  if (record.verdict && record.verdict !== 'good') {
    const shape = verdictShape(record.verdict);
    for (const [name, value] of Object.entries({ x: x + (width - 20) / 2, y: y + (height - 20) / 2, width: 20, height: 20 })) shape.setAttribute(name, value);
    return shape;
  }
  if (place === null) return s('circle', { cx: x + width / 2, cy: y + height / 2, r: 2.5 });
  const inside = Math.min(Math.max(place, -1), 1);
  return [s('rect.shade', { x, y, width, height, 'fill-opacity': (0.04 + 0.34 * inside * inside).toFixed(2) }),
    s('rect.place', { x: x + 3, y: y + 1.5 + (height - 6) * (1 - inside) / 2, width: width - 6, height: 3 })];
}

function legend() {
  const sample = (deviation_um) => s('svg', { width: CELL.width, height: CELL.height, 'aria-hidden': 'true' }, s('g.cell', { 'data-verdict': 'good' }, s('rect', { x: 1, y: 1, width: 24, height: 28 }),
    mark({ deviation_um, upper_deviation_um: 10, lower_deviation_um: -10, verdict: 'good' }, { x: 1, y: 1, width: 24, height: 28 })));
  return h('ul.legend', [['heat.upper', 9], ['heat.middle', 0], ['heat.lower', -9]].map(([name, um]) => h('li', sample(um), t(name))),
    VERDICTS.slice(1).map((verdict) => h('li.count', { 'data-verdict': verdict }, verdictShape(verdict), t(`verdict.${verdict}`))),
    h('li', s('svg', { width: CELL.width, height: CELL.height, 'aria-hidden': 'true' }, s('g.cell', { 'data-verdict': 'none' }, s('rect', { x: 1, y: 1, width: 24, height: 28 }))), t('heat.none')));
}
