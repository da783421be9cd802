/** A drawing beside the plan of its part, as the service has compared them: the rows, and the plan that comes of them. */

import { kindOf } from './sizes.js';

/** A size of the drawing as a characteristic; with the envelope requirement its class is one of (E). */
export function characteristicOf({ name, nominal_mm, tolerance_class: of, upper_um, lower_um, feature, quantity, count, entity, modifiers }) {
  const envelope = of && modifiers.some((word) => word.startsWith('envelope'));
  const limits = envelope ? { designation: `${nominal_mm} ${of} (E)` } : { nominal_mm, tolerance_class: of };
  return JSON.parse(JSON.stringify({ name, ...limits, upper_um, lower_um, feature: of ? undefined : feature, quantity, count: count > 1 ? count : undefined, entity }));
}

/** What a drawing says of a characteristic; people say the rest. */
const DRAWN = ['name', 'designation', 'nominal_mm', 'tolerance_class', 'upper_um', 'lower_um', 'feature', 'quantity', 'count', 'entity'];
const givenBy = (people) => Object.fromEntries(Object.entries(people ?? {}).filter(([member]) => !DRAWN.includes(member)));

/**
 * @param drawing of the service, compared with the plan; @param plan of the part, or null
 * @returns {rows: [{state, name, one, before, kind, remarks}], kept}: `state` is added, changed, same or gone; `kept` were typed by hand
 */
export function rowsOf(drawing, plan) {
  const known = new Map((plan?.characteristics ?? []).map((one) => [one.name, one]));
  const { gone = [], changed = [] } = drawing.compared ?? {};
  const other = new Set(changed.map(({ name }) => name));
  const drawn = drawing.sizes.map((size) => {
    const before = known.get(size.name);
    known.delete(size.name);
    const state = !before ? 'added' : other.has(size.name) ? 'changed' : 'same';
    return { state, name: size.name, one: { ...characteristicOf(size), ...givenBy(before) }, before, kind: kindOf(size), remarks: size.remarks };
  });
  const rest = gone.filter((name) => known.has(name)).map((name) => {
    const one = known.get(name);
    known.delete(name);
    return { state: 'gone', name, one, before: one, kind: kindOf(one), remarks: [] };
  });
  return { rows: [...drawn, ...rest], kept: [...known.values()] };
}

/** The plan of the rows that are taken: of those that are not, what was there before stays. */
export function planOf(drawing, plan, { rows, kept }, isTaken) {
  const { characteristics, part, ...rest } = plan ?? {};
  const chosen = rows.map((row) => {
    if (row.state === 'gone') return isTaken(row) ? null : row.one;
    return isTaken(row) ? row.one : row.before;
  }).filter(Boolean);
  return { ...rest, drawing: { digest: drawing.digest, ...(drawing.part && { part: drawing.part }) }, characteristics: [...chosen, ...kept] };
}
