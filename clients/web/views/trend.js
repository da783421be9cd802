/** The last values as they come in: run chart, histogram, counts. */

import { getJson, url } from '../api.js';
import { field, h } from '../dom.js';
import { follow } from '../events.js';
import { umText } from '../exact.js';
import { dateTime, explain, number, signed, t } from '../i18n.js';
import { Latest } from '../latest.js';
import { go } from '../route.js';
import { newestValues } from '../trend/recent_values.js';
import { runChart } from '../trend/run_chart.js';
import { countVerdicts, pointOf, statisticsOf } from '../trend/series.js';
import { distanceText, measuredText, verdictMark, verdictShape, VERDICTS } from '../verdict.js';

const COUNTS = [50, 100, 200, 500];
const ROWS = 12;
/** Many events make one drawing. */
const DRAW_MS = 50;

export function mount(main, route) {
  const leaving = new AbortController();
  const latest = new Latest(leaving.signal);
  const select = (name, onchange) => h('select', { id: `trend-${name}`, onchange });
  const characteristic = select('characteristic', () => { wanted = ''; load(); });
  const designation = select('designation', () => { wanted = designation.value; draw(); });
  const count = select('count', load);
  const chart = h('figure');
  const tiles = h('dl.tiles');
  const note = h('p.note', { role: 'alert' });
  const table = h('div.scroll', { tabindex: 0, role: 'region', 'aria-label': t('recent.title') });
  let wanted = route.options.designation ?? '';
  let records = [];
  let timer = 0;
  const offered = new Set();

  count.append(...COUNTS.map((each) => option(each, String(each), each === (Number(route.options.count) || 100))));
  main.replaceChildren(h('div.desk.trend', h('h1.unseen', { tabindex: -1 }, t('view.trend')),
    h('form.line', { onsubmit: (event) => event.preventDefault() }, field(t('field.characteristic'), characteristic),
      field(t('job.designation'), designation), field(t('trend.count'), count)),
    note, tiles, h('div.sheet', chart), table));

  /** The choices; what the URL names is offered even when nothing has it yet. */
  async function offer() {
    const { groups } = await getJson(url(['measurements', 'summary'], { group_by: 'characteristic' }), { signal: leaving.signal });
    characteristic.append(option('', t('trend.all'), true));
    for (const name of [route.options.characteristic, ...groups.map((group) => group.characteristic)]) offerOne(name);
    characteristic.value = route.options.characteristic ?? '';
  }

  function offerOne(name) {
    if (!name || offered.has(name)) return;
    offered.add(name);
    characteristic.append(option(name, name, false));
  }

  const filter = () => ({ characteristic: characteristic.value });
  const matches = (record) => !characteristic.value || record.characteristic === characteristic.value;

  async function load() {
    try {
      const newest = await latest.run((signal) => newestValues(filter(), Number(count.value), signal));
      if (!newest) return;
      records = newest;
      note.textContent = '';
      draw();
    } catch (problem) {
      note.textContent = explain(problem);
    }
  }

  function offerDesignations() {
    const names = [...new Set([...records.map((record) => record.designation ?? ''), wanted].filter(Boolean))].sort();
    // Chosen once: a chart that follows whatever is measured last hops from size to size.
    wanted ||= records.at(-1)?.designation ?? '';
    const chosen = wanted;
    designation.replaceChildren(...names.map((name) => option(name, number(name), name === chosen)));
  }

  function draw() {
    offerDesignations();
    const points = records.filter((record) => !designation.value || record.designation === designation.value).map(pointOf);
    go({ view: 'trend', options: { characteristic: characteristic.value, designation: designation.value, count: count.value } }, { refine: true });
    if (!points.length) {
      chart.replaceChildren(h('p.empty', t('trend.empty')));
      tiles.replaceChildren();
      table.replaceChildren();
      return;
    }
    chart.replaceChildren(runChart(points, Math.max(chart.clientWidth, 320)));
    tiles.replaceChildren(...summary(points));
    table.replaceChildren(lastRows(points));
  }

  function drawSoon() {
    timer ||= setTimeout(() => {
      timer = 0;
      draw();
    }, DRAW_MS);
  }

  function arrived(event) {
    if (event.type === 'resync') return load();
    if (event.type !== 'measurement.recorded') return null;
    const record = JSON.parse(event.data);
    note.textContent = '';
    offerOne(record.characteristic);
    if (!matches(record) || records.some(({ id }) => id === record.id)) return null;
    records = [...records.filter(({ id }) => id !== record.correction_of), record].slice(-Number(count.value));
    return drawSoon();
  }

  const resized = new ResizeObserver(() => records.length && drawSoon());
  resized.observe(chart);
  offer().then(load, (problem) => { if (!leaving.signal.aborted) note.textContent = explain(problem); })
    .then(() => follow(leaving.signal, arrived));
  return () => {
    leaving.abort();
    resized.disconnect();
    clearTimeout(timer);
  };
}

function option(value, text, selected) {
  const element = h('option', { value }, text);
  element.selected = selected;
  return element;
}

function summary(points) {
  const counts = countVerdicts(points);
  const { mean, deviation } = statisticsOf(points);
  const tile = (shape, term, value) => h('div', h('dt', shape, term), h('dd', value));
  const um = (nm) => `${signed(umText(Math.round(nm / 10) * 10))} µm`;
  return [
    ...VERDICTS.filter((verdict) => verdict !== 'indeterminate' || counts[verdict])
      .map((verdict) => tile(verdictShape(verdict), t(`verdict.${verdict}`), String(counts[verdict]))),
    tile(null, t('trend.mean'), um(mean)),
    tile(null, t('trend.deviation'), Number.isFinite(deviation) ? um(deviation).replace('+', '') : '–'),
  ];
}

function lastRows(points) {
  const head = ['trend.verdict', 'trend.value', 'trend.distance', 'field.part_id', 'trend.time'];
  return h('table', h('caption', t('recent.title')),
    h('thead', h('tr', head.map((name) => h('th', { scope: 'col' }, t(name))))),
    h('tbody', points.slice(-ROWS).reverse().map(({ record }) => h('tr',
      h('td', verdictMark(record.verdict)), h('td', `${measuredText(record)} mm`), h('td', distanceText(record)),
      h('td', record.part_id ?? ''), h('td', dateTime(new Date(record.measured_at)))))));
}
