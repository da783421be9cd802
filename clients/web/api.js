/** Calls of the service. A refusal is a Problem; a service that cannot be reached is a TypeError. */

import { toJson } from './exact.js';
import { forget, readStored, store } from './stored.js';

const KEY = 'key';
/** What somebody stands and waits for, in ms: then what is kept has to do. */
export const PATIENCE_MS = 4000;

/** A problem document (RFC 9457). */
export class Problem extends Error {
  constructor(status, document) {
    super(document.detail ?? document.title ?? `HTTP ${status}`);
    this.status = status;
    this.code = document.code ?? '';
    this.errors = document.errors ?? [];
    this.diagnostics = document.diagnostics ?? [];
  }

  /** The first field's own reason says more than the document's. */
  get reason() {
    return this.errors[0]?.detail ?? this.message;
  }

  /** Whether a reverse proxy says it of a service that is away. */
  get away() {
    return [502, 503, 504].includes(this.status);
  }

  /** Whether the same request may succeed later. */
  get passing() {
    return this.status >= 500 || [408, 429].includes(this.status) || this.code === 'idempotency.in_progress';
  }
}

/** Whether the service could not be reached: then what is kept has to do. */
export const isAway = (problem) => problem.status === undefined || problem.away;

let askForKey = async () => null;
/** @param ask shows why a key is needed and resolves to one, or to null. */
export const onKeyNeeded = (ask) => { askForKey = ask; };

/** The key that was entered in this window, or null. */
export const keyInUse = () => readStored(KEY, 'session');

/** What tells keys apart, and is too little to use one. */
export const signOf = (key) => key?.slice(0, 16);

/** Uses a key from now on, as long as the window lives. */
export function useKey(key) {
  store(KEY, key, 'session');
  dispatchEvent(new Event('keyentered'));
}

export function forgetKey() {
  forget(KEY, 'session');
  dispatchEvent(new Event('keyforgotten'));
}

/** How many questions wait for their answer; `asking` is told of each change. */
export let waiting = 0;
async function counted(method, ask) {
  if (method !== 'GET') return ask();
  const count = (by) => { waiting += by; dispatchEvent(new Event('asking')); };
  count(1);
  return ask().finally(() => count(-1));
}

async function problemOf(response) {
  const document = await response.json().catch(() => ({}));
  return new Problem(response.status, document);
}

/**
 * One request. A 401 asks for a key and repeats it; the key lives as long as the window.
 * @param body text, bytes, or an object that is sent as JSON
 * @param timeout in ms, of each attempt
 * @param asks whether a 401 asks for a key: not for what is only convenient
 * @param sign of the only key that it is sent with; undefined for any
 */
export async function request(method, path, { body, headers = {}, signal, timeout, asks = true, sign } = {}) {
  const isJson = body !== undefined && Object.getPrototypeOf(body) === Object.prototype;
  const sent = isJson ? toJson(body) : body;
  const type = isJson ? { 'Content-Type': 'application/json' } : {};
  for (;;) {
    const key = keyInUse();
    if (key && sign && sign !== signOf(key)) throw new Problem(401, { code: 'auth.required' });
    const authorization = key ? { Authorization: `Bearer ${key}` } : {};
    const response = await counted(method, () => fetch(path, {
      method, body: sent, cache: 'no-cache', headers: { ...type, ...headers, ...authorization },
      signal: timeout ? AbortSignal.timeout(timeout) : signal,
    }));
    if (response.ok) return response;
    const problem = await problemOf(response);
    if (response.status !== 401) throw problem;
    if (key) forgetKey();
    const entered = asks && await askForKey(problem);
    if (!entered) throw problem;
    useKey(entered);
  }
}

export const get = (path, options) => request('GET', path, options);
export const getJson = async (path, options) => (await get(path, options)).json();

/** Whether a browser folds a part out of a path, also where it is encoded. */
export const isFolded = (part) => ['.', '..'].includes(part);

/** A path from parts and a query; parts are encoded, empty options left out. */
export function url(parts, options = {}) {
  const given = Object.entries(options).filter(([, value]) => value !== '' && value !== undefined && value !== null);
  const query = new URLSearchParams(given).toString();
  return `/v1/${parts.map(encodeURIComponent).join('/')}${query && `?${query}`}`;
}
