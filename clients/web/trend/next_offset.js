/** The next offset of a machine, as the service proposes it; nothing is moved. */

import { getJson, url } from '../api.js';
import { h } from '../dom.js';
import { number, signed, t } from '../i18n.js';

/** Fewer decimals than the service has: nobody types a hundredth of a µm. */
const um = (value) => `${signed(value.toFixed(1))} µm`;

const tile = (term, value, hint) => h('div', h('dt', term), h('dd', value), hint && h('dd.hint', hint));

/** @param query of the chart. null for several characteristics: an offset is of one. */
export async function nextOffset({ characteristic, ...query }, signal) {
  if (!characteristic) return null;
  return getJson(url(['measurements', 'compensation'], { characteristic, ...query, set_aside: 'false' }), { signal, asks: false }).catch((problem) => {
    if (problem.status === 422) return null;
    throw problem;
  });
}

/** @param found of the service, or null */
export function offsetTiles(found) {
  if (!found) return [];
  const { state, offset_um: offset, interval_um: interval, next_in_parts: parts, wear_um: wear, scatter_um: scatter, dead_band_um: band } = found;
  const isProposed = state === 'propose';
  return [
    h('h2', t('offset.title')),
    h('dl', { class: isProposed ? 'tiles' : 'tiles in-doubt' },
      h('div', h('dt', t('offset.state')), h('dd', { 'data-state': state }, t(`offset.state.${state}`)), h('dd.hint', { lang: 'en' }, found.reason)),
      offset !== null && tile(t('offset.offset'), um(offset), interval && t('trend.interval', { lower: um(interval[0]), upper: um(interval[1]) })),
      parts !== null && tile(t('offset.next'), parts === 1 ? t('offset.in_part') : t('offset.in_parts', { count: parts })),
      wear !== null && tile(t('offset.wear'), `${signed(wear.toFixed(2))} µm`, scatter !== null && t('offset.scatter', { um: number(scatter.toFixed(2)) })),
      band !== null && tile(t('offset.band'), `±${number(band.toFixed(1))} µm`)),
    h('p.aside', t('offset.how', { count: found.values }), ' ', h('span', { lang: 'en' }, found.clause)),
  ];
}
