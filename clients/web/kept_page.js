/** The page itself, kept by the browser for when the service is away: where its origin is secure. */

const WORKER = '/web/service_worker.js';

/** Whether this page would load again without the service. */
export const isKept = () => Boolean(navigator.serviceWorker?.controller);

/** Begins to keep the page, with what was loaded of it. A browser that refuses only does not. */
export async function keepPage() {
  try {
    await navigator.serviceWorker.register(WORKER, { scope: '/', updateViaCache: 'none' });
    const { active } = await navigator.serviceWorker.ready;
    active.postMessage({ files: performance.getEntriesByType('resource').map(({ name }) => new URL(name).pathname) });
  } catch {
    // isKept says so
  }
}
