/** Gauges in use: until when they are calibrated, and how uncertain what they measure is. */

import { getJson, request, url } from '../api.js';
import { connection } from '../connection.js';
import { date, number, t } from '../i18n.js';

/** A date holds to its end in UTC, as the service has it. */
const endOf = (due) => new Date(due.length === 10 ? `${due}T23:59:59Z` : due);

/** A date without a time is the same day everywhere. */
export const dayShown = (text) => date(new Date(text.length === 10 ? `${text}T12:00` : text));

/** The names of the gauges in use; none where the service cannot say. */
export const gaugeNames = async (signal) =>
  (await getJson(url(['gauges-in-use']), { signal, asks: false }).catch(() => ({ gauges: [] }))).gauges.map(({ name }) => name);

/** {name, due, day: of it as text, overdue, blocked, uncertainty_um} of a gauge in use, by its calibration of today; null where it is none. */
export async function gaugeInUse(name, signal) {
  if (!name) return null;
  try {
    const gauge = await getJson(url(['gauges-in-use', name]), { signal, asks: false });
    const { calibrations } = await getJson(url(['gauges-in-use', name, 'calibrations']), { signal, asks: false });
    const now = calibrations.filter(({ from }) => new Date(from) <= connection.now()).at(-1) ?? {};
    const blocked = now.status === 'blocked';
    const text = blocked ? now.from : now.due ?? gauge.calibration_due;
    const due = blocked ? new Date(text) : endOf(text);
    return { name, due, day: dayShown(text), blocked, overdue: blocked || due < connection.now(),
      uncertainty_um: await uncertaintyOf(now.uncertainty ?? gauge.uncertainty, signal) };
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

/** "calibrated until 31 Mar 2027 · u = 0.8 µm", or that it is overdue or blocked. */
export function gaugeText({ name, day, overdue, blocked, uncertainty_um: um }) {
  if (blocked) return t('gauge.blocked', { gauge: name, date: day });
  if (overdue) return t('gauge.overdue', { gauge: name, date: day });
  return [t('gauge.due', { gauge: name, date: day }), um && `u = ${number(um)} µm`].filter(Boolean).join(' · ');
}
