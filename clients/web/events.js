/** What happens at the service: one stream for all tabs of a browser, none for a tab nobody sees. */

import { get, keyInUse } from './api.js';
import { pageFile } from './page_files.js';
import { untilLifted } from './press.js';
import { eventsOf, followStream } from './stream.js';

const WORKER = pageFile('stream_worker.js');
/** A worker that is not there by then never comes: its file may be blocked. */
const WORKER_START_MS = 4000;

/** The events of one stream, to its end. */
export async function* readEvents(path, signal) {
  yield* eventsOf(await get(path, { signal, headers: { Accept: 'text/event-stream' } }));
}

/**
 * Follows /v1/events until `signal` while the page is seen, and tells nothing under a press. A page that was hidden
 * goes on where it was, or gets `resync`: then it reads anew.
 */
export async function follow(signal, onEvent) {
  const port = await sharedPort();
  let last;
  const take = async (event) => {
    last = event.id ?? last;
    await untilLifted();
    if (!signal.aborted) onEvent(event);
  };
  const join = port ? joinShared(port, take, () => last) : joinAlone(take, () => last);
  let leave = () => {};
  let left = false;
  const look = () => {
    leave();
    leave = () => {};
    if (signal.aborted) return;
    if (document.hidden) {
      left = true;
      return;
    }
    leave = join();
    // Without an event there is no id to go on from.
    if (left && !last) take({ type: 'resync', data: '{}' });
  };
  document.addEventListener('visibilitychange', look, { signal });
  addEventListener('pagehide', () => leave(), { signal });
  addEventListener('pageshow', (event) => event.persisted && look(), { signal });
  signal.addEventListener('abort', () => leave());
  look();
}

/** Calls `renew` whenever the tables may have changed, until `signal`. */
export const followTables = (signal, renew) =>
  follow(signal, ({ type }) => { if (type === 'table.changed' || type === 'resync') renew(); });

/** A port to the worker of this browser; null where there is none. */
function sharedPort() {
  if (!globalThis.SharedWorker) return null;
  return new Promise((resolve) => {
    try {
      const worker = new SharedWorker(WORKER, { type: 'module' });
      const give = setTimeout(() => resolve(null), WORKER_START_MS);
      worker.onerror = () => resolve(null);
      worker.port.onmessage = () => {
        clearTimeout(give);
        resolve(worker.port);
      };
    } catch {
      resolve(null);
    }
  });
}

function joinShared(port, take, last) {
  port.onmessage = ({ data }) => data.event && take(data.event);
  return () => {
    port.postMessage({ join: true, key: keyInUse(), last: last() });
    return () => port.postMessage({ join: false });
  };
}

function joinAlone(take, last) {
  return () => {
    const ending = new AbortController();
    followStream('/v1/events', { key: keyInUse(), last: last(), signal: ending.signal, onEvent: take });
    return () => ending.abort();
  };
}
