/**
 * Keeps the page for the time when the service is away: the entry as it was last, with the files of its build.
 * Nothing of /v1 goes through here. The service is asked first for the entry; what stands below a build's name
 * never changes.
 */

const CACHE = 'page';
const ENTRY = '/';
const BUILD = /^\/web\/[0-9a-f]{12}\//;
const NAMED = /"(\/web\/[0-9a-f]{12}\/[^"]+)"/g;
/** A reverse proxy says so of a service that is away. */
const AWAY = [502, 503, 504];
/** A network that swallows what is sent counts as away then. */
const LONGEST_WAIT_MS = 5000;

const pathOf = ({ url }) => new URL(url).pathname;

/** Adds files that are not there. */
async function add(cache, paths) {
  const there = new Set((await cache.keys()).map(pathOf));
  await cache.addAll(paths.filter((path) => BUILD.test(path) && !there.has(path)));
}

/** Keeps an entry once all it names is kept, and forgets the builds before. */
async function keepEntry(cache, response) {
  const named = [...(await response.clone().text()).matchAll(NAMED)].map(([, path]) => path);
  if (!named.length) return;
  await add(cache, named);
  await cache.put(ENTRY, response);
  const [build] = BUILD.exec(named[0]);
  for (const request of await cache.keys()) {
    const path = pathOf(request);
    if (path !== ENTRY && !path.startsWith(build)) await cache.delete(request);
  }
}

async function entry(event) {
  const cache = await caches.open(CACHE);
  const kept = await cache.match(ENTRY);
  const asked = fetch(event.request);
  if (!kept) return asked;
  const late = new Promise((resolve) => { setTimeout(() => resolve(kept), LONGEST_WAIT_MS); });
  const response = await Promise.race([asked.catch(() => kept), late]);
  if (response.ok && response !== kept) event.waitUntil(keepEntry(cache, response.clone()));
  return AWAY.includes(response.status) ? kept : response;
}

async function file(event) {
  const cache = await caches.open(CACHE);
  const kept = await cache.match(event.request, { ignoreVary: true });
  if (kept) return kept;
  const response = await fetch(event.request);
  if (response.ok) event.waitUntil(cache.put(event.request, response.clone()));
  return response;
}

/** A page tells which files it has loaded: those of its first time did not pass through here. */
async function keepLoaded(files) {
  const cache = await caches.open(CACHE);
  if (!await cache.match(ENTRY)) {
    const response = await fetch(ENTRY);
    if (response.ok) await keepEntry(cache, response);
  }
  await add(cache, files);
}

addEventListener('install', (event) => event.waitUntil(globalThis.skipWaiting()));
addEventListener('activate', (event) => event.waitUntil(globalThis.clients.claim()));
addEventListener('message', (event) => event.waitUntil(keepLoaded(event.data.files)));
addEventListener('fetch', (event) => {
  const { origin, pathname } = new URL(event.request.url);
  if (event.request.method !== 'GET' || origin !== location.origin) return;
  if (pathname === ENTRY) event.respondWith(entry(event));
  else if (BUILD.test(pathname)) event.respondWith(file(event));
});
