/** The plans of the service with their drawings: list, read, store, delete. */

import { getJson, request, url } from '../api.js';
import { findDocument, readDocument, removeDocument, writeDocument } from '../documents.js';

export const listPlans = async (signal) => (await getJson(url(['plans']), { signal })).plans;

/** A plan as {plan, tag}. */
export async function readPlan(part, signal) {
  const { body: plan, tag } = await readDocument(['plans', part], signal);
  return { plan, tag };
}

/** The same, or {plan: null, tag: null} if there is none. */
export async function findPlan(part) {
  const { body: plan, tag } = await findDocument(['plans', part]);
  return { plan, tag };
}

/** What the service reads of a STEP file; with a part, compared with its plan. */
export const readDrawing = async (file, part) =>
  (await request('POST', url(['drawings'], { part }), { body: file, headers: { 'Content-Type': 'model/step' } })).json();

export const writePlan = (part, plan, tag) => writeDocument(['plans', part], plan, tag);
export const removePlan = (part, tag) => removeDocument(['plans', part], tag);
