/** The control chart of the newest values as they come in: is it stable, is it capable. */

import { getJson, url } from '../api.js';
import { designationText } from '../designation.js';
import { field, h, refill } from '../dom.js';
import { follow } from '../events.js';
import { umText } from '../exact.js';
import { dateTime, explain, number, signed, t } from '../i18n.js';
import { Latest } from '../latest.js';
import { fragment, go } from '../route.js';
import { ControlChart, PAPER, rulesAt } from '../trend/control_chart.js';
import { capability, controlChart } from '../trend/figures.js';
import { inFigures } from '../trend/in_figures.js';
import { newestValues } from '../trend/recent_values.js';
import { Stretch } from '../trend/stretch.js';
import { meanPoint, pointOf, sizeOf, subgroupsOf } from '../trend/series.js';
import { capabilityTiles, countTiles } from '../trend/tiles.js';
import { distanceText, measuredText, verdictMark } from '../verdict.js';

const COUNTS = [50, 100, 200, 500, 1000, 5000, 10000, 100000];
const RULES = [1, 2, 3, 4];
const KINDS = ['i_mr', 'xbar_r', 'xbar_s'];
const ROWS = 12;
/** More than so many values missed are a list to read anew. */
const MOST_MISSED = 1000;
/** Many events make one drawing: one of so many ms, and as many more as there are values by ten. */
const DRAW_MS = 120;
const VALUES_PER_MS = 10;

export function mount(main, route) {
  const leaving = new AbortController();
  const loading = new Latest(leaving.signal);
  const computing = new Latest(leaving.signal);
  const { options } = route;
  const select = (name, onchange) => h('select', { id: `trend-${name}`, onchange });
  const characteristic = select('characteristic', () => { wanted = ''; sizes.clear(); frozen = null; load(); });
  const designation = select('designation', () => { wanted = designation.value; frozen = null; load(); });
  const count = select('count', () => load());
  const kind = select('kind', () => { frozen = null; picked = null; compute(); });
  const rules = RULES.map((rule) => h('input', { type: 'checkbox', value: rule, checked: (options.rules ?? '1234').includes(rule), onchange: () => compute() }));
  const freeze = h('button', { type: 'button', onclick: () => toggleFrozen() });
  const chart = h('figure', { tabindex: 0, 'aria-label': t('trend.browse'), onkeydown: (event) => browse(event) });
  const stretch = new Stretch(() => drawSoon());
  const tiles = h('dl.tiles');
  const indices = h('div.indices');
  const detail = h('div.detail', { role: 'status' });
  const figured = h('details.in-figures', { hidden: true });
  const note = h('p.note', { role: 'alert' });
  const table = h('div.scroll', { tabindex: 0, role: 'region', 'aria-label': t('recent.title') });
  const offered = new Set();
  const sizes = new Set();
  let wanted = options.designation ?? '';
  let frozen = options.centre && options.sd ? { centre: Number(options.centre), standard_deviation: Number(options.sd) } : null;
  let records = [];
  let meanwhile = [];
  let points = [];
  let drawn = [];
  let left = 0;
  let figures = { chart: null, indices: null };
  let picked = null;
  let timer = 0;
  let frame = 0;
  let width = 0;
  let onPaper = false;
  let shown = null;
  let stale = true;
  let told = null;

  count.append(...COUNTS.map((each) => option(each, String(each), each === (Number(options.count) || 100))));
  kind.append(...KINDS.map((each) => option(each, t(`trend.kind.${each}`), each === options.kind)));
  const kindField = field(t('trend.kind'), kind);
  kindField.hidden = true;
  main.replaceChildren(h('div.desk.trend', h('h1.unseen', { tabindex: -1 }, t('view.trend')),
    h('form.line', { onsubmit: (event) => event.preventDefault() }, field(t('field.characteristic'), characteristic),
      field(t('job.designation'), designation), field(t('trend.count'), count), kindField),
    note, h('div.sums', tiles, indices),
    h('div.sheet', chart, stretch.element, detail, figured,
      h('div.line.rules', h('span.label', t('trend.rules')), rules.map((input, i) => h('label.choice', input, h('span', t(`trend.rule.${RULES[i]}`)))), freeze)),
    table));

  /** The characteristics there are; what the URL names is offered even when nothing has it yet. */
  async function offer() {
    const { groups } = await getJson(url(['measurements', 'summary'], { group_by: 'characteristic' }), { signal: leaving.signal });
    for (const group of groups) offerOne(group.characteristic);
  }

  function offerOne(name) {
    if (!name || offered.has(name)) return;
    offered.add(name);
    characteristic.append(option(name, name, false));
  }

  /** A drawing's own limits have no designation that the service could look for. */
  const filter = () => ({ characteristic: characteristic.value, designation: wanted.includes('/') ? '' : wanted });
  const matches = (record) => !characteristic.value || record.characteristic === characteristic.value;

  async function load() {
    meanwhile = [];
    try {
      let newest = await loading.run((signal) => newestValues(filter(), Number(count.value), signal));
      if (!newest) return;
      for (const record of newest) sizes.add(sizeOf(record));
      // Chosen once: a chart that follows whatever is measured last hops from size to size.
      if (!wanted && newest.length) {
        wanted = sizeOf(newest.at(-1));
        if (sizes.size > 1) newest = await loading.run((signal) => newestValues(filter(), Number(count.value), signal)) ?? newest;
      }
      records = newest;
      // What was stored while the list was read may not be in it.
      for (const record of meanwhile) add(record);
      note.textContent = '';
      picked = null;
      await compute();
    } catch (problem) {
      note.textContent = explain(problem);
    }
  }

  /** Asks the service for the figures of what is shown, then draws both together. */
  async function compute() {
    points = records.filter((record) => !wanted || sizeOf(record) === wanted).map(pointOf);
    const found = subgroupsOf(points);
    // Without subgroups there is nothing to choose.
    kindField.hidden = found.groups.length < 2;
    const groups = kindField.hidden || kind.value === 'i_mr' ? null : found.groups;
    const chosen = rules.filter((input) => input.checked).map((input) => Number(input.value));
    try {
      const answers = await computing.run((signal) => (points.length
        ? Promise.all([controlChart(points, { kind: groups ? kind.value : 'i_mr', groups, rules: chosen, frozen }, signal), capability(points, groups, signal)]) : [null, null]));
      if (!answers) return;
      figures = { chart: answers[0], indices: answers[1] };
      drawn = groups ? groups.map(meanPoint) : points;
      left = groups ? found.left : 0;
      if (picked !== null && !drawn[picked]) picked = null;
      draw();
    } catch (problem) {
      note.textContent = explain(problem);
    }
  }

  function remembered() {
    go({
      view: 'trend',
      options: {
        characteristic: characteristic.value, designation: wanted, count: count.value, kind: kind.value === 'i_mr' ? '' : kind.value,
        rules: rules.filter((input) => input.checked).map((input) => input.value).join(''),
        ...(frozen && { centre: frozen.centre, sd: frozen.standard_deviation }),
      },
    }, { refine: true });
  }

  function draw() {
    refill(designation, [...new Set([...sizes, wanted].filter(Boolean))].sort().map((name) => option(name, designationText(name).replace('Ø ', ''), name === wanted)));
    designation.value = wanted;
    remembered();
    const computable = Boolean(figures.chart);
    freeze.disabled = !computable && !frozen;
    freeze.textContent = t(frozen ? 'trend.thaw' : 'trend.freeze');
    figured.hidden = !points.length;
    if (!points.length) {
      chart.replaceChildren(h('p.empty', t('trend.empty')));
      for (const place of [tiles, indices, detail, figured, table]) place.replaceChildren();
      told = null;
      return;
    }
    width ||= Math.max(chart.clientWidth, 300);
    redraw();
    refill(figured, inFigures(drawn, figures.chart, goTo));
    tiles.replaceChildren(...countTiles(points));
    indices.replaceChildren(...capabilityTiles(figures.indices, points, figures.chart, drawn));
    table.replaceChildren(lastRows(points));
  }

  function drawChart() {
    if (!points.length || shown?.isTouched) return; // not under the finger
    if (stale || !shown.element.isConnected) {
      shown?.plot.destroy();
      chart.classList.toggle('on-paper', onPaper);
      shown = new ControlChart(chart, drawn, points, figures.chart, { ...(onPaper ? PAPER : { width }), onPick: pick, onStretch: (from, to) => stretch.choose(from, to) });
      stale = false;
    }
    shown.show(stretch.of(drawn.length), picked);
    if (told?.picked !== picked || told.drawn !== drawn || told.chart !== figures.chart) tell();
  }

  /** Of other values, in another width or other colours, on paper and back. */
  function redraw() {
    stale = true;
    drawChart();
  }

  /** What there is to say of the point that was picked. */
  function tell() {
    told = { picked, drawn, chart: figures.chart };
    refill(detail, picked === null ? h('p.aside', [left && t('trend.left_out', { count: left }), priceText()].filter(Boolean).join(' ')) : pointDetail(drawn[picked], rulesAt(figures.chart).get(picked)));
  }

  /** A slider says more often where it is than a screen shows. */
  function drawSoon() {
    frame ||= requestAnimationFrame(() => {
      frame = 0;
      drawChart();
    });
  }

  /** What the rules cost: points to a false alarm. */
  const priceText = () => (figures.chart?.average_run_length
    ? t('trend.price', { points: String(Math.round(figures.chart.average_run_length)) }) : t('trend.pick'));

  function pick(index) {
    picked = index;
    drawChart();
  }

  function browse(event) {
    const step = { ArrowLeft: -1, ArrowRight: 1 }[event.key];
    if (!step || !drawn.length) return;
    event.preventDefault();
    goTo(Math.min(Math.max((picked ?? drawn.length) + step, 0), drawn.length - 1));
  }

  function goTo(index) {
    stretch.reveal(index);
    pick(index);
  }

  function toggleFrozen() {
    const own = figures.chart?.charts[0];
    frozen = frozen || !own ? null : { centre: own.centre, standard_deviation: figures.chart.standard_deviation };
    compute();
  }

  /** @returns whether the record belongs to what is shown, and was not there */
  function add(record) {
    if (!matches(record) || records.some(({ id, correction_of: old }) => id === record.id || old === record.id)) return false;
    sizes.add(sizeOf(record));
    wanted ||= sizeOf(record);
    if (sizeOf(record) !== wanted) return false;
    records = [...records.filter(({ id }) => id !== record.correction_of), record].slice(-Number(count.value));
    return true;
  }

  /** Adds a record, also to a list that is being read and may not have it yet. */
  function take(record) {
    meanwhile.push(record);
    return add(record);
  }

  /** Reads what was stored since the newest value held, which the stream of events may not have told of. */
  async function catchUp() {
    const newest = records.at(-1);
    if (!newest) return load();
    try {
      const { measurements, next } = await getJson(url(['measurements'], { ...filter(), after: newest.id, limit: MOST_MISSED }), { signal: leaving.signal });
      if (next) return load();
      if (measurements.filter(take).length) computeSoon();
      return null;
    } catch {
      return leaving.signal.aborted ? null : load(); // another log, or none: it says why
    }
  }

  function arrived(event) {
    if (event.type === 'resync') return catchUp();
    if (event.type !== 'measurement.recorded') return null;
    const record = JSON.parse(event.data);
    note.textContent = '';
    offerOne(record.characteristic);
    if (take(record)) computeSoon();
    return null;
  }

  function computeSoon() {
    timer ||= setTimeout(() => {
      timer = 0;
      compute();
    }, DRAW_MS + points.length / VALUES_PER_MS);
  }

  // Asked for in every frame, the width would make the browser lay out the page once more in each.
  const resized = new ResizeObserver(() => {
    const now = Math.max(chart.clientWidth, 300);
    if (now === width) return;
    width = now;
    redraw();
  });
  resized.observe(chart);
  const { signal } = leaving;
  const print = ({ type }) => {
    onPaper = type === 'beforeprint';
    redraw();
  };
  for (const event of ['beforeprint', 'afterprint']) addEventListener(event, print, { signal });
  for (const look of ['(prefers-color-scheme: dark)', '(forced-colors: active)']) matchMedia(look).addEventListener('change', redraw, { signal });
  characteristic.append(option('', t('trend.all'), true));
  offerOne(options.characteristic);
  characteristic.value = options.characteristic ?? '';
  Promise.all([offer(), load()]).catch((problem) => { if (!leaving.signal.aborted) note.textContent = explain(problem); })
    .then(() => follow(leaving.signal, arrived));
  return () => {
    leaving.abort();
    resized.disconnect();
    shown?.plot.destroy();
    clearTimeout(timer);
    cancelAnimationFrame(frame);
  };
}

function option(value, text, selected) {
  const element = h('option', { value }, text);
  element.selected = selected;
  return element;
}

/** The record of one point. */
function pointDetail({ record, members, deviation }, broken) {
  const marks = broken && h('span.stability.doubt', t('trend.broken', { rules: [...broken].join(', ') }));
  if (members) {
    return h('div.line', verdictMark(record.verdict), h('strong', `x̄ = ${signed(umText(Math.round(deviation)))} µm`), h('span', record.subgroup),
      h('span.aside', members.map((each) => `${measuredText(each.record)} mm`).join(' · ')), marks);
  }
  return h('div.line', verdictMark(record.verdict), h('strong', `${measuredText(record)} mm`), h('span', distanceText(record)),
    record.part_id && h('a', { href: fragment({ view: 'parts', options: { part_id: record.part_id } }) }, record.part_id),
    h('span.aside', [record.characteristic, record.machine, record.operator, record.gauge, dateTime(new Date(record.measured_at))].filter(Boolean).join(' · ')),
    marks);
}

function lastRows(points) {
  const head = ['trend.verdict', 'trend.value', 'trend.distance', 'field.part_id', 'trend.time'];
  return h('table', h('caption', t('recent.title')),
    h('thead', h('tr', head.map((name) => h('th', { scope: 'col' }, t(name))))),
    h('tbody', points.slice(-ROWS).reverse().map(({ record }) => h('tr',
      h('td', verdictMark(record.verdict)), h('td', `${measuredText(record)} mm`), h('td', distanceText(record)),
      h('td', record.part_id ?? ''), h('td', dateTime(new Date(record.measured_at)))))));
}
