/** Server-Sent Events over fetch, which can send a key where EventSource cannot. */

import { get } from './api.js';

const LONGEST_WAIT_MS = 5000;

/** The events of one answer (WHATWG HTML, 9.2.6), as {type, id, data}. */
async function* eventsOf(response) {
  const reader = response.body.pipeThrough(new TextDecoderStream()).getReader();
  let rest = '';
  let event = {};
  for (;;) {
    const { value, done } = await reader.read();
    if (done) return;
    const lines = (rest + value).split('\n');
    rest = lines.pop();
    for (const line of lines) {
      if (line === '') {
        if (event.data !== undefined || event.id !== undefined) yield event;
        event = {};
        continue;
      }
      const [, name, text] = /^([^:]*):? ?(.*)$/.exec(line.replace(/\r$/, ''));
      if (name === 'event') event.type = text;
      else if (name === 'id') event.id = text;
      else if (name === 'data') event.data = event.data === undefined ? text : `${event.data}\n${text}`;
    }
  }
}

/** The events of one stream, to its end. */
export async function* readEvents(path, signal) {
  yield* eventsOf(await get(path, { signal, headers: { Accept: 'text/event-stream' } }));
}

/** Resolves once the page is seen. */
const seen = () => new Promise((resolve) => {
  const look = () => {
    if (document.hidden) return;
    document.removeEventListener('visibilitychange', look);
    resolve();
  };
  document.addEventListener('visibilitychange', look);
  look();
});

/** A signal that also ends when the page is hidden: a browser has six connections to a service for all its tabs. */
function whileSeen(signal) {
  const hidden = new AbortController();
  const look = () => document.hidden && hidden.abort();
  document.addEventListener('visibilitychange', look, { signal: hidden.signal });
  signal.addEventListener('abort', () => hidden.abort(), { signal: hidden.signal });
  if (signal.aborted) hidden.abort();
  return hidden.signal;
}

/**
 * Follows a stream until `signal` while the page is seen, coming back with the id of the last event
 * after every break.
 */
export async function follow(path, signal, onEvent) {
  let last;
  let wait = 250;
  while (!signal.aborted) {
    await seen();
    try {
      const headers = { Accept: 'text/event-stream', ...(last && { 'Last-Event-ID': last }) };
      for await (const event of eventsOf(await get(path, { signal: whileSeen(signal), headers }))) {
        wait = 250;
        last = event.id ?? last;
        if (event.data !== undefined) onEvent(event);
      }
    } catch (error) {
      if (signal.aborted || error.status === 401) return;
    }
    await new Promise((resolve) => setTimeout(resolve, wait));
    wait = Math.min(2 * wait, LONGEST_WAIT_MS);
  }
}
