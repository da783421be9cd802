/** What a gauge study comes to: whether the gauge is suitable and why, its components as a table and as pictures. */

import { h } from '../dom.js';
import { number, t } from '../i18n.js';
import { verdictShape } from '../verdict.js';
import { averageAndRange, byOne, components, interaction, masterRun } from './study_figures.js';

/** AIAG, MSA 4: a gauge that takes up to a tenth is suitable, beyond three tenths it is not; five categories are told apart. */
const GOOD_PERCENT = 10;
const MOST_PERCENT = 30;
const FEWEST_CATEGORIES = 5;
/** Of Cg and Cgk. */
const LEAST_INDEX = 1.33;
const COMPONENTS = ['grr', 'ev', 'av', 'interaction', 'pv', 'tv'];
const SHARES = ['contribution_percent', 'study_variation_percent', 'tolerance_percent'];
const MARKS = { good: 'good', marginal: 'rework', bad: 'reject' };

/** Of ISO 22514-7: most of the resolution, of the measuring system and of the process. */
const MOST_OF_PROCESS = { re_percent: 5, q_ms_percent: 15, q_mp_percent: 30 };

const micrometres = (mm) => number((mm * 1000).toFixed(2));
/** The capability of a measuring process, where it was asked for. */
const processTiles = (of) => of && h('dl.tiles', Object.entries(MOST_OF_PROCESS).filter(([name]) => of[name] !== undefined)
  .map(([name, most]) => h('div', { class: of[name] > most && 'beyond' }, h('dt', t(`study.${name}`)), h('dd', percent(of[name])), h('dd.hint', t('study.most', { percent: percent(most) })))));

const percent = (value) => (value === null ? '–' : `${number(value.toFixed(1))} %`);
const head = (verdict, ...said) => h('div.study-verdict', verdictShape(MARKS[verdict]), h('div', h('p.headline', t(`study.verdict.${verdict}`)), said.map((text) => h('p', text))));

/** @param study what the service computed; @param readings [{part, operator, value}] in mm; @param parts and @param operators in order; @param charts of averages and ranges, null if a trial is missing, undefined if the service did not answer */
export function variationResult(study, { readings, parts, operators, charts }) {
  const of = study.tolerance_percent.grr === null ? 'study_variation_percent' : 'tolerance_percent';
  const share = study[of].grr;
  const few = study.ndc !== null && study.ndc < FEWEST_CATEGORIES;
  const verdict = share > MOST_PERCENT ? 'bad' : share > GOOD_PERCENT || few ? 'marginal' : 'good';
  const there = COMPONENTS.filter((name) => study[name] !== null);
  const shares = SHARES.filter((name) => study[name].grr !== null);
  const { intervals } = study;
  const interval = (name) => (intervals[name] ? `${micrometres(intervals[name].lower)} – ${micrometres(intervals[name].upper)}` : '–');
  return [
    head(verdict, t(`study.takes.${of}`, { percent: percent(share) }), t(few ? 'study.ndc_few' : 'study.ndc', { count: study.ndc ?? '–', fewest: FEWEST_CATEGORIES }), t('study.rule')),
    h('div.scroll', { tabindex: 0, role: 'region', 'aria-label': t('study.title') }, h('table', h('caption', t('study.figure.components')),
      h('thead', h('tr', h('th', { scope: 'col' }, t('study.component')), h('th', { scope: 'col' }, t('study.sigma')), intervals && h('th', { scope: 'col' }, t('study.interval', { percent: number(100 * intervals.confidence) })), shares.map((name) => h('th', { scope: 'col' }, t(`study.${name}`))))),
      h('tbody', there.map((name) => h('tr', { class: name }, h('th', { scope: 'row' }, t(`study.component.${name}`)), h('td.number', micrometres(study[name])), intervals && h('td.number', interval(name)),
        shares.map((each) => h('td.number', percent(study[each][name])))))))),
    processTiles(study.measuring_process),
    charts === null && h('p.hint', t('study.no_charts')),
    h('div.study-figures', components(study, there.filter((name) => name !== 'tv'), shares), charts && averageAndRange(charts, { parts, operators }), byOne(readings, 'part', parts), byOne(readings, 'operator', operators), interaction(readings, parts, operators)),
  ];
}

/** @param study what the service computed of one master; @param of {values, reference, tolerance} in mm */
export function masterResult({ cg, cgk, bias, standard_deviation: sigma, measuring_system: system }, { values, reference, tolerance }) {
  const um = (mm) => `${micrometres(mm)} µm`;
  const index = (value) => (value === null ? '–' : number(value.toFixed(2)));
  return [
    head(cg >= LEAST_INDEX && cgk >= LEAST_INDEX ? 'good' : 'bad', t('study.indices', { cg: index(cg), cgk: index(cgk), least: number(LEAST_INDEX) }), t('study.bias', { bias: um(bias), sigma: um(sigma) })),
    processTiles(system),
    h('div.study-figures', masterRun(values, reference, tolerance)),
  ];
}
