/** The plans of the service and their drawings: list, read, store with the state that was read, delete. */

import { get, getJson, request, url } from '../api.js';

export const listPlans = async (signal) => (await getJson(url(['plans']), { signal })).plans;

/** A plan as {plan, tag}; the tag names the state that was read. */
export async function readPlan(part) {
  const response = await get(url(['plans', part]));
  return { plan: await response.json(), tag: response.headers.get('ETag') };
}

/** The same, or {plan: null, tag: null} if there is none. */
export const findPlan = (part) => readPlan(part).catch((problem) => {
  if (problem.status === 404) return { plan: null, tag: null };
  throw problem;
});

/** What the service reads of a STEP file; with a part, compared with its plan. */
export const readDrawing = async (file, part) =>
  (await request('POST', url(['drawings'], { part }), { body: file, headers: { 'Content-Type': 'model/step' } })).json();

/** @param tag of the state that was read; null: there was none; undefined: whatever stands there. @returns the new tag */
export async function writePlan(part, plan, tag) {
  const condition = tag === undefined ? {} : tag === null ? { 'If-None-Match': '*' } : { 'If-Match': tag };
  return (await request('PUT', url(['plans', part]), { body: plan, headers: condition })).headers.get('ETag');
}

export const removePlan = (part, tag) => request('DELETE', url(['plans', part]), { headers: tag ? { 'If-Match': tag } : {} });
