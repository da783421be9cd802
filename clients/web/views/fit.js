/** A hole and a shaft: zones, clearances, the classes to choose from. */

import { getJson, url } from '../api.js';
import { Asked } from '../asked.js';
import { isBearing, parseFit } from '../designation.js';
import { copyText, field, h, refill } from '../dom.js';
import { followTables } from '../events.js';
import { judge, mmText, nmFromMm, nmFromUm, parseMeasured, umText } from '../exact.js';
import { ClassMap } from '../fit/class_map.js';
import { clearanceBar } from '../fit/clearance_bar.js';
import { drawingText, Finder } from '../fit/finder.js';
import { preferredFits } from '../fit/preferred.js';
import { zoneFigure } from '../fit/zone_figure.js';
import { number, signed, t } from '../i18n.js';
import { Latest } from '../latest.js';
import { go } from '../route.js';
import { classNames } from '../tables/catalogue.js';
import { limitsText, verdictMark } from '../verdict.js';

const FIRST = '25H7/g6';
const FEATURES = ['hole', 'shaft'];

export function mount(main, route) {
  const leaving = new AbortController();
  const latest = new Latest(leaving.signal);
  const state = parseFit(route.path.join('/') || FIRST) ?? { text: route.path.join('/') };
  const typed = h('input.designation', { id: 'fit', type: 'text', autocomplete: 'off', autocapitalize: 'off', spellcheck: 'false' });
  const measured = Object.fromEntries(FEATURES.map((feature) => [feature, h('input', {
    type: 'text', inputmode: 'decimal', autocomplete: 'off', id: `measured-${feature}`, onchange: () => refresh(),
  })]));
  for (const feature of FEATURES) measured[feature].value = route.options[feature] ?? '';
  const note = h('p.note', { role: 'alert' });
  const result = h('div.result', { role: 'status' });
  const figure = h('figure');
  const preferred = h('div');
  const maps = h('div.class-maps');
  const finder = new Finder({ leaving: leaving.signal, sizeOf: () => state.size, onPick: pick });
  let classMaps = {};
  /** Whether what was typed last is the fit that is shown. */
  let isRead = true;
  let drawn = () => {};

  main.replaceChildren(h('div.desk.fit', h('h1.unseen', { tabindex: -1 }, t('view.fit')),
    h('div.main-column', h('div.sheet', figure), preferred, finder.element),
    h('div.side', h('form', { novalidate: true, onsubmit: (event) => { event.preventDefault(); readTyped(); } },
      field(t('fit.label'), typed), note,
      h('div.pair', FEATURES.map((feature) => field(t(`fit.measured.${feature}`), measured[feature]))),
      h('button.unseen', { type: 'submit', tabindex: -1 }, t('fit.show'))),
    result),
    maps));
  typed.addEventListener('change', readTyped);

  function readTyped() {
    const parsed = parseFit(typed.value);
    if (parsed?.size !== state.size) finder.clear();
    if (parsed) return pick(parsed);
    latest.run(() => {}); // an answer that is on its way is of the fit before
    isRead = false;
    return nothing(t('error.fit.malformed'));
  }

  /** No result stands below a note that is about something else. */
  function nothing(reason) {
    note.setAttribute('role', 'alert');
    note.textContent = reason;
    drawn = () => {};
    figure.replaceChildren();
    result.replaceChildren();
    answered();
  }

  const answered = () => [figure, result].forEach((now) => now.removeAttribute('aria-busy'));

  function pick(change) {
    Object.assign(state, change);
    refresh();
  }

  /** The class of a side as it is asked for, with its envelope requirement. */
  const classOf = (feature) => state[feature] + (state.envelope?.[feature] ? '(E)' : '');

  function remembered() {
    const options = Object.fromEntries(FEATURES.map((feature) => [feature, measured[feature].value.trim()]));
    go({ view: 'fit', path: [`${state.size}${classOf('hole')}`, classOf('shaft')], options });
  }

  function refresh() {
    if (!state.size) {
      typed.value = state.text;
      nothing(t('error.fit.malformed'));
      return;
    }
    const designation = `${number(state.size)} ${classOf('hole')}/${classOf('shaft')}`;
    typed.value = designation;
    isRead = true;
    remembered();
    note.textContent = '';
    for (const old of [figure, result]) old.setAttribute('aria-busy', true);
    refill(preferred, preferredFits(state, pick));
    ask();
  }

  /** What the tables say now, which may have changed. */
  const asked = new Asked(() => {
    if (!state.size || !isRead) return undefined;
    return Promise.all([showMaps(), latest.run(async (signal) => {
      const fit = await getJson(url(['fits', `${state.size}${classOf('hole')}`, classOf('shaft')]), { signal });
      if (note.getAttribute('role') === 'alert') note.textContent = '';
      await draw(fit, signal);
    })]);
  }, { say: (text) => text && nothing(text), leaving: leaving.signal });
  const ask = () => asked.run();

  async function draw(fit, signal) {
    const sizes = {};
    for (const feature of FEATURES) {
      const text = parseMeasured(measured[feature].value);
      if (measured[feature].value.trim() && text === null) note.textContent = t('entry.malformed', { typed: measured[feature].value });
      sizes[feature] = text === null ? NaN : nmFromMm(text);
    }
    const actual = sizes.hole - sizes.shaft;
    const judged = await verdicts(fit, sizes, signal);
    drawn = () => figure.replaceChildren(zoneFigure(fit, sizes, figure.clientWidth), clearanceBar(fit, actual, figure.clientWidth));
    drawn();
    result.replaceChildren(...summary(fit, actual), limitsTable(fit, judged, copy));
    answered();
  }

  const verdicts = async (fit, sizes, signal) => Object.fromEntries(await Promise.all(FEATURES
    .filter((feature) => sizes[feature] > 0)
    .map(async (feature) => {
      if (isBearing(fit[feature].tolerance_class)) return [feature, { verdict: judge(sizes[feature], fit[feature]) }];
      const name = `${fit[feature].nominal_mm}${fit[feature].tolerance_class}`;
      return [feature, await getJson(url(['verdicts', name], { measured_mm: mmText(sizes[feature], 0) }), { signal })];
    })));

  async function copy(limits) {
    const text = drawingText(limits, (nm) => mmText(nm));
    await copyText(text);
    note.setAttribute('role', 'status');
    note.textContent = t('fit.copied', { text });
  }

  const showMaps = () => Promise.all(FEATURES.map((feature) => classMaps[feature]?.show(nmFromMm(state.size), state[feature])));

  const mapping = new Asked(async () => {
    const names = await classNames();
    classMaps = Object.fromEntries(FEATURES.map((feature) => [feature, new ClassMap(feature, names[feature], { onPick: (name) => pick({ [feature]: name }), onProblem: (problem) => mapping.fail(problem) })]));
    maps.replaceChildren(...FEATURES.map((feature) => classMaps[feature].element));
    if (state.size) await showMaps();
  }, { say: (text) => { note.textContent = text && (note.textContent || text); }, leaving: leaving.signal });

  const resized = new ResizeObserver(() => drawn());
  resized.observe(figure);
  refresh();
  mapping.run();
  followTables(leaving.signal, ask);
  return () => {
    leaving.abort();
    resized.disconnect();
  };
}

function summary(fit, actual) {
  const [least, most] = [fit.min_clearance_um, fit.max_clearance_um].map(nmFromUm);
  const um = (nm) => `${number(umText(Math.abs(nm)))} µm`;
  const line = (nm, which) => h('div', h('dt', t(`fit.${which}.${nm < 0 ? 'interference' : 'clearance'}`)), h('dd', um(nm)));
  return [
    h('p.headline', t(`fit.type.${fit.type}`)), h('p.aside', t(fit.assumes_envelope ? 'fit.form_counts' : 'fit.envelope')),
    h('dl', ...(most <= 0 ? [line(least, 'max'), line(most, 'min')]
      : least < 0 ? [line(most, 'max'), line(least, 'max')] : [line(most, 'max'), line(least, 'min')]),
    h('div', h('dt', t('fit.probable')), h('dd', probable(fit).map((nm) => number(umText(nm))).join(' … '), ' µm')),
    Number.isFinite(actual) && h('div', h('dt', t(`fit.actual.${actual < 0 ? 'interference' : 'clearance'}`)), h('dd', um(actual)))),
  ];
}

/** The clearances of all but 0.27 % of the pairs, where sizes are normal, centred, and six standard deviations fill a tolerance. */
function probable(fit) {
  const [least, most] = [fit.min_clearance_um, fit.max_clearance_um].map(nmFromUm);
  const half = Math.hypot(...FEATURES.map((feature) => nmFromUm(fit[feature].tolerance_um))) / 2;
  // To a tenth of a micrometre: it is an estimate.
  return [-half, half].map((from) => Math.round(((least + most) / 2 + from) / 100) * 100);
}

function limitsTable(fit, verdicts, onCopy) {
  return h('table.limits', h('tbody', FEATURES.map((feature) => h('tr',
    h('th', { scope: 'row' }, `${t(`feature.${feature}`)} ${fit[feature].tolerance_class}`),
    h('td', limitsText(fit[feature]), h('span.aside', `${signed(fit[feature].upper_deviation_um)} / ${signed(fit[feature].lower_deviation_um)} µm`)),
    h('td', verdicts[feature] && verdictMark(verdicts[feature].verdict),
      h('button.quiet', { type: 'button', 'aria-label': t('fit.copy_this', { size: `${number(fit[feature].nominal_mm)} ${fit[feature].tolerance_class}` }), onclick: () => onCopy(fit[feature]) }, t('fit.copy')))))));
}
