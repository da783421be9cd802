/** Every characteristic of a part number or a machine, the worst first, as the values come in: a list, parts by characteristic, or small charts. */

import { getJson, url } from '../api.js';
import { Asked } from '../asked.js';
import { field, h, refill } from '../dom.js';
import { follow } from '../events.js';
import { FilterBar } from '../filter_bar.js';
import { number, t } from '../i18n.js';
import { Latest } from '../latest.js';
import { HeatMap } from '../overview/heat_map.js';
import { bySeverity, isDoubtful, LAST, standingOf } from '../overview/standing.js';
import { Wall } from '../overview/wall.js';
import { untilLifted } from '../press.js';
import { fragment, go } from '../route.js';
import { FEWEST } from '../trend/figures.js';
import { verdictShape, VERDICTS } from '../verdict.js';

const LOOKS = ['list', 'heat', 'wall'];
const HEAD = ['field.characteristic', 'trend.count', 'trend.verdict', 'overview.index', 'overview.process'];
/** Many events make one reading. */
const GATHER_MS = 500;

export function mount(main, route) {
  const leaving = new AbortController();
  const latest = new Latest(leaving.signal);
  const plan = h('select', { id: 'overview-plan', onchange: () => load() });
  const bar = new FilterBar(route.options, () => load());
  const note = h('p.note', { role: 'alert' });
  const rows = h('tbody');
  const table = h('div.scroll', { tabindex: 0, role: 'region', 'aria-label': t('view.overview') },
    h('table', h('thead', h('tr', HEAD.map((name) => h('th', { scope: 'col' }, t(name))))), rows));
  const empty = h('p.empty', { hidden: true }, t('trend.empty'));
  let look = LOOKS.includes(route.options.look) ? route.options.look : LOOKS[0];
  const looks = h('div.switch', { role: 'group', 'aria-label': t('overview.look') }, LOOKS.map((name) =>
    h('button', { type: 'button', 'aria-pressed': String(name === look), onclick: () => choose(name) }, t(`overview.look.${name}`))));
  const heat = new HeatMap(leaving.signal, () => bar.options);
  const wall = new Wall(() => bar.options);
  const places = { list: table, heat: heat.element, wall: wall.element };
  for (const place of Object.values(places)) place.hidden = true;
  let standings = new Map();
  let changed = new Set();
  let timer = 0;
  let reading = Promise.resolve();

  main.replaceChildren(h('div.desk.overview', h('h1.unseen', { tabindex: -1 }, t('view.overview')),
    h('form.line', { onsubmit: (event) => event.preventDefault() }, field(t('plan.label'), plan), bar.element),
    h('div.line.looks', looks, h('a.to-gauges', { href: '#/gauges' }, t('gauges.link'))),
    note, h('p.aside', t('overview.what', { count: LAST, fewest: FEWEST })), empty, Object.values(places)));

  async function offer() {
    bar.offer(leaving.signal);
    const { plans } = await getJson(url(['plans']), { signal: leaving.signal });
    const chosen = route.options.plan;
    refill(plan, h('option', { value: '' }, t('overview.characteristics')), [...new Set([...plans.map(({ part }) => part), chosen].filter(Boolean))]
      .map((value) => h('option', { value, selected: value === chosen }, value)));
  }

  /** The names to be shown: those of the plan, or all there are values of. */
  async function namesOf(signal) {
    if (plan.value) return (await getJson(url(['plans', plan.value]), { signal })).characteristics.map(({ name }) => name);
    const { groups } = await getJson(url(['measurements', 'summary'], { ...bar.query, group_by: 'characteristic' }), { signal });
    return groups.map(({ characteristic }) => characteristic).filter(Boolean);
  }

  const remembered = () => go({ view: 'overview', options: { plan: plan.value, look: look === LOOKS[0] ? '' : look, ...bar.options } }, { refine: true });

  function choose(name) {
    look = name;
    [...looks.children].forEach((button, i) => button.setAttribute('aria-pressed', LOOKS[i] === look));
    remembered();
    draw();
  }

  const asked = new Asked(async () => {
    if (!plan.options.length) await offer();
    remembered();
    table.toggleAttribute('data-settled', false);
    await latest.run(async (signal) => {
      const names = await namesOf(signal);
      const found = await standingsOf(names, signal);
      standings = new Map(names.map((name, i) => [name, found[i]]));
      draw();
    });
  }, { again: () => load(), say: (text) => { note.textContent = text; }, leaving: leaving.signal });
  const load = () => { reading = asked.run(); return reading; };

  const standingsOf = (names, signal) => Promise.all(names.map((name) => standingOf({ ...bar.query, characteristic: name }, signal)));

  function draw() {
    const sorted = [...standings].sort(([, one], [, other]) => bySeverity(one, other));
    empty.hidden = sorted.length > 0;
    for (const [name, place] of Object.entries(places)) place.hidden = name !== look || !sorted.length;
    if (look === 'heat') heat.show(sorted);
    else if (look === 'wall') wall.show(sorted);
    else refill(rows, sorted.map(([name, standing]) => row(name, standing)));
    table.toggleAttribute('data-settled', true);
  }

  function arrived(event) {
    if (event.type === 'resync') return load();
    const record = JSON.parse(event.data);
    const { characteristic } = record;
    if (event.type === 'note.added') {
      for (const [name, { records }] of standings) if (records.some(({ id }) => id === record.measurement_id)) renewSoon(name);
    } else if (event.type === 'measurement.recorded' && characteristic && bar.has(record) && !(plan.value && !standings.has(characteristic))) renewSoon(characteristic);
    return null;
  }

  function renewSoon(characteristic) {
    changed.add(characteristic);
    timer ||= setTimeout(renew, GATHER_MS);
  }

  async function renew() {
    timer = 0;
    const names = [...changed];
    changed = new Set();
    // An older reading that ends later would put the old figures back.
    await reading;
    try {
      const found = await standingsOf(names, leaving.signal);
      await untilLifted();
      names.forEach((name, i) => standings.set(name, found[i]));
      draw();
    } catch (problem) {
      asked.fail(problem);
    }
  }

  load().then(() => follow(leaving.signal, arrived));
  return () => {
    leaving.abort();
    clearTimeout(timer);
  };

  function row(name, standing) {
    return h('tr',
      h('th', { scope: 'row' }, h('a', { href: fragment({ view: 'trend', options: { ...bar.options, characteristic: name } }) }, name)),
      h('td.number', String(standing.count)), h('td', counts(standing)), h('td', indexOf(standing)), h('td', processOf(standing)));
  }
}

const counts = ({ verdicts, count }) => (count ? h('span.counts', VERDICTS.filter((word) => verdicts[word]).map((word) =>
  h('span.count', { 'data-verdict': word }, verdictShape(word), h('span.unseen', t(`verdict.${word}`)), ` ${verdicts[word]}`))) : '');

function indexOf(standing) {
  const { ppk } = standing;
  if (!ppk) return '–';
  const text = (value) => number(value.toFixed(2));
  return h('span', { class: isDoubtful(standing) ? 'index in-doubt' : 'index' }, h('strong', text(ppk.value)),
    ppk.lower != null && h('span.aside', t('trend.interval', { lower: text(ppk.lower), upper: text(ppk.upper) })));
}

function processOf({ count, isLimited, stable }) {
  if (!count) return t('overview.nothing');
  if (!isLimited) return t('trend.no_limits');
  if (stable === undefined) return t('overview.unknown');
  if (!stable) return h('span.stability.doubt', t('overview.unstable'));
  return count < FEWEST ? t('trend.too_few', { count, fewest: FEWEST }) : h('span.stability', t('overview.stable'));
}
