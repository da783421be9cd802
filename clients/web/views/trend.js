/** The control chart of the newest values as they come in: is it stable, is it capable. */

import { getJson, url } from '../api.js';
import { Asked } from '../asked.js';
import { designationText } from '../designation.js';
import { field, h, refill } from '../dom.js';
import { follow } from '../events.js';
import { FilterBar } from '../filter_bar.js';
import { t } from '../i18n.js';
import { Latest, pause } from '../latest.js';
import { untilLifted } from '../press.js';
import { go } from '../route.js';
import { asideList, askAside, readNotes } from '../trend/aside.js';
import { Boxes } from '../trend/boxes.js';
import { ChartPlace } from '../trend/chart_place.js';
import { CLUSTERED, rulesAt } from '../trend/control_chart.js';
import { capability } from '../trend/figures.js';
import { HeldValues } from '../trend/held_values.js';
import { inFigures } from '../trend/in_figures.js';
import { nextOffset, offsetTiles } from '../trend/next_offset.js';
import { CAUSES, chartOfPhases, isCounted, phasesOf } from '../trend/phases.js';
import { lastRows, pointDetail } from '../trend/records.js';
import { eventsOf, meanPoint, pointOf, subgroupsOf } from '../trend/series.js';
import { capabilityTiles, countTiles } from '../trend/tiles.js';

const COUNTS = [50, 100, 200, 500, 1000, 5000, 10000, 100000];
const RULES = [1, 2, 3, 4];
const KINDS = ['i_mr', 'xbar_r', 'xbar_s'];
/** Many events make one drawing: one of so many ms, and as many more as there are values by ten. */
const DRAW_MS = 120;
const VALUES_PER_MS = 10;

export function mount(main, route) {
  const leaving = new AbortController();
  const [computing, proposing] = [new Latest(leaving.signal), new Latest(leaving.signal)];
  const { options } = route;
  const bar = new FilterBar(options, () => { frozen = null; load(); });
  const values = new HeldValues({
    bar, characteristic: options.characteristic ?? '', size: options.designation ?? '', count: Number(options.count) > 0 ? Number(options.count) : 100,
  }, leaving.signal);
  const select = (name, onchange) => h('select', { id: `trend-${name}`, onchange });
  const characteristic = select('characteristic', () => { values.choose(characteristic.value); frozen = null; load(); });
  const designation = select('designation', () => { values.size = designation.value; frozen = null; load(); });
  const count = select('count', () => { values.count = Number(count.value); load(); });
  const kind = select('kind', () => { frozen = null; chart.picked = null; compute(); });
  const rules = RULES.map((rule) => h('input', { type: 'checkbox', value: rule, checked: (options.rules ?? '1234').includes(rule), onchange: () => compute() }));
  const phases = CAUSES.map((cause) => h('input', { type: 'checkbox', value: cause, checked: (options.phases ?? '').split(',').includes(cause), onchange: () => compute() }));
  const freeze = h('button', { type: 'button', onclick: () => toggleFrozen() });
  const chart = new ChartPlace({ leaving: leaving.signal, onDrawn: () => tell() });
  const tiles = h('dl.tiles');
  const indices = h('div.indices');
  const offset = h('section.sheet.offset', { hidden: true }); // below the chart, which stays in its place when this comes
  const detail = h('div.detail', { role: 'status' });
  const boxes = new Boxes(options.boxes ?? '', () => remembered());
  const figured = h('details.in-figures', { hidden: true });
  const aside = h('section.sheet.aside-values', { hidden: true });
  const note = h('p.note', { role: 'alert' });
  const table = h('div.scroll', { tabindex: 0, role: 'region', 'aria-label': t('recent.title') });
  const offered = new Set();
  let frozen = options.centre && options.sd ? { centre: Number(options.centre), standard_deviation: Number(options.sd) } : null;
  let left = 0;
  let figures = { chart: null, indices: null };
  let timer = 0;
  let told = null;
  let turns = 0;

  count.append(...[...new Set([...COUNTS, values.count])].sort((one, other) => one - other).map((each) => option(each, String(each), each === values.count)));
  kind.append(...KINDS.map((each) => option(each, t(`trend.kind.${each}`), each === options.kind)));
  const kindField = field(t('trend.kind'), kind);
  kindField.hidden = true;
  main.replaceChildren(h('div.desk.trend', h('h1.unseen', { tabindex: -1 }, t('view.trend')),
    h('form.line', { onsubmit: (event) => event.preventDefault() }, field(t('field.characteristic'), characteristic),
      field(t('job.designation'), designation), field(t('trend.count'), count), kindField, bar.element),
    note, h('div.sums', tiles, indices),
    h('div.sheet', chart.element, chart.stretch.element, detail, boxes.element, figured,
      h('div.line.rules', h('span.label', t('trend.rules')), rules.map((input, i) => h('label.choice', input, h('span', t(`trend.rule.${RULES[i]}`)))), freeze),
      h('div.line.rules.phases', h('span.label', t('phases.new')), phases.map((input, i) => h('label.choice', input, h('span', t(`phases.${CAUSES[i]}`)))))),
    aside, offset, table));

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

  const say = (text) => { note.textContent = text; };
  const offering = new Asked(offer, { say, leaving: leaving.signal });
  const loading = new Asked(async () => {
    if (!await values.load()) return;
    chart.picked = null;
    await compute();
  }, { say, leaving: leaving.signal });
  const load = () => loading.run();
  const figuring = new Asked(figure, { say, leaving: leaving.signal });
  const compute = () => figuring.run();

  const chosenPhases = () => phases.filter((input) => input.checked).map(({ value }) => value);
  const chosenRules = () => rules.filter((input) => input.checked).map((input) => Number(input.value));

  /** Asks the service for the figures of what is shown, then draws both together. */
  async function figure() {
    const points = values.shown.map(pointOf);
    const counted = points.filter(isCounted);
    const found = subgroupsOf(counted);
    // Without subgroups there is nothing to choose.
    kindField.hidden = found.groups.length < 2;
    const groups = kindField.hidden || kind.value === 'i_mr' ? null : found.groups;
    const drawn = groups ? groups.map(meanPoint) : points;
    // Limits that are frozen are those of every value.
    const phased = phasesOf(drawn, frozen ? [] : chosenPhases());
    const { from } = phased.at(-1);
    const newest = drawn.slice(from).flatMap((point) => point.members ?? (isCounted(point) ? point : []));
    const charted = { kind: groups ? kind.value : 'i_mr', rules: chosenRules(), frozen };
    const answers = await computing.run(async (signal) => {
      if (!newest.length) return [null, null];
      // Each step is a turn of its own: 100,000 values are long work.
      await pause();
      eventsOf(drawn);
      await pause();
      const charts = chartOfPhases(drawn, phased, charted, signal);
      await pause();
      const found = await Promise.all([charts, capability(newest, groups?.slice(from) ?? null, signal)]);
      await untilLifted();
      return found;
    });
    if (!answers) return;
    await pause();
    figures = { chart: answers[0], indices: answers[1] };
    propose(counted);
    left = groups ? found.left : 0;
    await draw(points, drawn, counted, phased.length > 1 ? { from, values: newest } : null);
  }

  /** What the setter types next: of one characteristic on one machine, with limits that are the same for all values. */
  async function propose(points) {
    const isOne = figures.indices && new Set(points.map(({ record }) => record.machine)).size === 1;
    const found = await proposing.run((signal) => (isOne ? nextOffset(values.query, signal) : null)).catch(() => null);
    if (found === undefined) return;
    refill(offset, offsetTiles(found));
    offset.hidden = !found;
  }

  function remembered() {
    go({
      view: 'trend',
      options: {
        characteristic: values.characteristic, designation: values.size, count: values.count, ...bar.options, kind: kind.value === 'i_mr' ? '' : kind.value,
        rules: chosenRules().join(''), phases: chosenPhases().join(), boxes: boxes.by, ...(frozen && { centre: frozen.centre, sd: frozen.standard_deviation }),
      },
    }, { refine: true });
  }

  /** @param points the values one by one; @param drawn the same, or the means of their subgroups; @param counted those not set aside; @param newest {from, values}: the newest phase, where there are several */
  async function draw(points, drawn, counted, newest) {
    const turn = ++turns;
    refill(designation, [...new Set([...values.sizes, values.size].filter(Boolean))].sort()
      .map((name) => option(name, designationText(name).replace('Ø ', ''), name === values.size)));
    designation.value = values.size;
    remembered();
    freeze.disabled = !figures.chart && !frozen;
    freeze.textContent = t(frozen ? 'trend.thaw' : 'trend.freeze');
    figured.hidden = !points.length;
    boxes.show(counted);
    refill(aside, asideList(points, (index) => chart.goTo(drawn === points ? index : drawn.findIndex((one) => one.members?.includes(points[index]))), setAside));
    aside.hidden = counted.length === points.length;
    if (!points.length) {
      chart.clear(t('trend.empty'));
      for (const place of [tiles, indices, detail, figured, table]) place.replaceChildren();
      told = null;
      return;
    }
    refill(figured, inFigures(drawn, figures.chart, (index) => chart.goTo(index)));
    tiles.replaceChildren(...countTiles(counted, points.length - counted.length));
    const own = newest && figures.chart && { ...figures.chart, violations: figures.chart.violations.filter(({ index }) => index >= newest.from) };
    indices.replaceChildren(...capabilityTiles(figures.indices, newest?.values ?? counted, own ?? figures.chart, drawn), ...(newest ? [h('p.aside', t('phases.newest', { count: newest.values.length }))] : []));
    table.replaceChildren(lastRows(points));
    const charted = figures.chart;
    await pause();
    if (turn === turns && !leaving.signal.aborted) chart.show({ points: drawn, singles: counted, chart: charted });
  }

  /** What there is to say of the point that was picked; nothing new where only the stretch has moved. */
  function tell() {
    const { picked, shown } = chart;
    if (told?.picked === picked && told.shown === shown) return;
    told = { picked, shown };
    refill(detail, picked === null ? h('p.aside', [left && t('trend.left_out', { count: left }), priceText(), eventsOf(shown.points).size > 0 && t('trend.events'), shown.points.length > CLUSTERED && shown.chart?.violations.length > 0 && t('trend.cluster')].filter(Boolean).join(' '))
      : pointDetail(shown.points[picked], rulesAt(shown.chart).get(picked), setAside));
  }

  /** What the rules cost: points to a false alarm. */
  const priceText = () => (figures.chart?.average_run_length
    ? t('trend.price', { points: String(Math.round(figures.chart.average_run_length)) }) : t('trend.pick'));

  /** Sets a value aside, or counts it again; the note is shown at once. */
  async function setAside(record) {
    const stored = await askAside(record);
    if (stored) noted(stored);
  }

  /** A note that is stored, here or elsewhere, beside a value that is shown. */
  async function noted(stored) {
    const record = values.shown.find(({ id }) => id === stored.measurement_id);
    if (!record || record.notes?.some(({ id }) => id === stored.id)) return;
    try {
      await readNotes(record, leaving.signal);
      told = null;
      computeSoon();
    } catch (problem) {
      loading.fail(problem);
    }
  }

  function toggleFrozen() {
    const own = figures.chart?.charts[0];
    frozen = frozen || !own ? null : { centre: own.centre, standard_deviation: figures.chart.standard_deviation };
    compute();
  }

  async function catchUp() {
    const missed = await values.catchUp();
    if (missed === null) return load();
    if (missed) computeSoon();
    return null;
  }

  function arrived(event) {
    if (event.type === 'resync') return catchUp();
    if (event.type === 'note.added') return noted(JSON.parse(event.data));
    if (event.type !== 'measurement.recorded') return null;
    const record = JSON.parse(event.data);
    offerOne(record.characteristic);
    if (values.take(record)) computeSoon();
    return null;
  }

  function computeSoon() {
    timer ||= setTimeout(() => {
      timer = 0;
      compute();
    }, DRAW_MS + values.shown.length / VALUES_PER_MS);
  }

  characteristic.append(option('', t('trend.all'), true));
  offerOne(options.characteristic);
  characteristic.value = values.characteristic;
  bar.offer(leaving.signal);
  Promise.all([offering.run(), load()]).then(() => follow(leaving.signal, arrived));
  return () => {
    leaving.abort();
    clearTimeout(timer);
  };
}

function option(value, text, selected) {
  const element = h('option', { value }, text);
  element.selected = selected;
  return element;
}
