/** The plans of the service with their drawings and catalogues: list, read, store with the state that was read, delete. */

import { get, getJson, request, url } from '../api.js';

export const listPlans = async (signal) => (await getJson(url(['plans']), { signal })).plans;

/** A document as {body, tag}; the tag names the state that was read. @param path such as ['plans', part] */
export async function readDocument(path, signal) {
  const response = await get(url(path), { signal });
  return { body: await response.json(), tag: response.headers.get('ETag') };
}

/** @param tag of the state that was read; null: there was none; undefined: whatever stands there. @returns the new tag */
export async function writeDocument(path, body, tag) {
  const condition = tag === undefined ? {} : tag === null ? { 'If-None-Match': '*' } : { 'If-Match': tag };
  return (await request('PUT', url(path), { body, headers: condition })).headers.get('ETag');
}

export const removeDocument = (path, tag) => request('DELETE', url(path), { headers: tag ? { 'If-Match': tag } : {} });

/** A plan as {plan, tag}. */
export async function readPlan(part, signal) {
  const { body: plan, tag } = await readDocument(['plans', part], signal);
  return { plan, tag };
}

/** The same, or {plan: null, tag: null} if there is none. */
export const findPlan = (part) => readPlan(part).catch((problem) => {
  if (problem.status === 404) return { plan: null, tag: null };
  throw problem;
});

/** What the service reads of a STEP file; with a part, compared with its plan. */
export const readDrawing = async (file, part) =>
  (await request('POST', url(['drawings'], { part }), { body: file, headers: { 'Content-Type': 'model/step' } })).json();

export const writePlan = (part, plan, tag) => writeDocument(['plans', part], plan, tag);
export const removePlan = (part, tag) => removeDocument(['plans', part], tag);
