/** What the values come to: verdicts, mean, spread, and whether the process is stable and capable. */

import { h } from '../dom.js';
import { umText } from '../exact.js';
import { has, number, signed, t } from '../i18n.js';
import { verdictShape, VERDICTS } from '../verdict.js';
import { FEWEST } from './figures.js';
import { countVerdicts, hasLimits, statisticsOf } from './series.js';

const INDICES = ['cp', 'cpk', 'pp', 'ppk'];

const tile = (shape, term, value, hint) => h('div', h('dt', shape, term), h('dd', value), hint && h('dd.hint', hint));

export function countTiles(points, aside = 0) {
  const counts = countVerdicts(points);
  const { mean, deviation } = statisticsOf(points);
  const um = (nm) => `${signed(umText(Math.round(nm / 10) * 10))} µm`;
  return [
    ...VERDICTS.filter((verdict) => counts[verdict] || (verdict !== 'indeterminate' && counts.unjudged < Math.max(points.length, 1)))
      .map((verdict) => tile(verdictShape(verdict), t(`verdict.${verdict}`), String(counts[verdict]))),
    counts.unjudged > 0 && tile(null, t('verdict.unjudged'), String(counts.unjudged)),
    aside > 0 && tile(null, t('aside.tile'), String(aside)),
    tile(null, t('trend.mean'), points.length ? um(mean) : '–'),
    tile(null, t('trend.deviation'), Number.isFinite(deviation) ? um(deviation).replace('+', '') : '–'),
  ].filter(Boolean);
}

/** The indices with their 95 % interval and n. Never green: grey, and with the reason, while they mean little. */
export function capabilityTiles(figures, points, chart, drawn = points) {
  if (!figures) return [h('p.aside', t(points[0] && !hasLimits(points[0].record) ? 'trend.no_limits' : 'trend.no_capability'))];
  const doubt = doubtOf(points, chart, drawn);
  const index = (value) => number(value.toFixed(2));
  const { reason } = figures;
  return [
    h('dl', { class: doubt ? 'tiles in-doubt' : 'tiles' }, INDICES.filter((name) => reason || figures[name]?.value != null).map((name) => {
      const { value, lower, upper } = figures[name] ?? {};
      const interval = lower != null && upper != null && t('trend.interval', { lower: index(lower), upper: index(upper) });
      return tile(null, name.replace('c', 'C').replace(/^p/, 'P'), value == null ? '–' : index(value), interval);
    })),
    h('p', { class: doubt ? 'stability doubt' : 'stability' }, doubt || t('trend.stable', { count: points.length })),
    ...fitted(figures).map((text) => h('p.aside.fitted', text)),
  ];
}

/** Of which distribution the indices are, or why there are none; and the process model of ISO 22514-2. */
function fitted({ distribution, model, reason }) {
  const { name, p } = distribution ?? {};
  const meaning = model && (has(`model.${model.name}`) ? t(`model.${model.name}`) : model.meaning);
  return [
    reason && t('trend.unfitted'),
    name && [t('trend.fitted', { name: t(`distribution.${name}`) }), p != null && t('trend.fit', { p: number(p.toFixed(3)) }), name !== 'normal' && t('trend.percentile')].filter(Boolean).join(' · '),
    model && t('trend.model', { name: model.name, meaning }),
  ].filter(Boolean);
}

/** Why the indices say little of what comes: '' where they do. */
function doubtOf(points, chart, drawn) {
  const location = chart?.charts[0].name;
  const first = [...(chart?.violations ?? [])].filter(({ chart: name }) => name === location).sort((one, other) => other.index - one.index)[0];
  if (first) {
    return t('trend.unstable', { rule: first.rule, part: drawn[first.index].record.part_id ?? t('trend.value_number', { number: first.index + 1 }) });
  }
  if (chart?.violations.length) return t('trend.unstable_range');
  if (points.length < FEWEST) return t('trend.too_few', { count: points.length, fewest: FEWEST });
  return '';
}
