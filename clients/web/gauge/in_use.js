/** Gauges in use: until when they are calibrated, and how uncertain what they measure is. */

import { getJson, request, url } from '../api.js';
import { connection } from '../connection.js';
import { date, number, t } from '../i18n.js';

/** A date holds to its end in UTC, as the service has it. */
const endOf = (due) => new Date(due.length === 10 ? `${due}T23:59:59Z` : due);

/** The names of the gauges in use; none where the service cannot say. */
export const gaugeNames = async (signal) =>
  (await getJson(url(['gauges-in-use']), { signal, asks: false }).catch(() => ({ gauges: [] }))).gauges.map(({ name }) => name);

/** {name, due, overdue, uncertainty_um} of a gauge in use; null where it is none. */
export async function gaugeInUse(name, signal) {
  if (!name) return null;
  try {
    const gauge = await getJson(url(['gauges-in-use', name]), { signal, asks: false });
    const due = endOf(gauge.calibration_due);
    return { name, due, overdue: due < connection.now(), uncertainty_um: await uncertaintyOf(gauge.uncertainty, signal) };
  } catch (problem) {
    if ([401, 404, undefined].includes(problem.status)) return null;
    throw problem;
  }
}

/** Standard uncertainty in µm of a named budget, rounded up to the nanometre as the service has it; null without one. */
async function uncertaintyOf(budget, signal) {
  if (!budget) return null;
  const body = await getJson(url(['uncertainties', budget]), { signal });
  const { combined_standard_uncertainty: um } = await (await request('POST', url(['uncertainty']), { body, signal })).json();
  return um === null ? null : (Math.ceil(Number((um * 1000).toFixed(6))) / 1000).toString();
}

/** "calibrated until 31 Mar 2027 · u = 0.8 µm", or that it is overdue. */
export function gaugeText({ name, due, overdue, uncertainty_um: um }) {
  if (overdue) return t('gauge.overdue', { gauge: name, date: date(due) });
  return [t('gauge.due', { gauge: name, date: date(due) }), um && `u = ${number(um)} µm`].filter(Boolean).join(' · ');
}
