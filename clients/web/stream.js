/** Server-Sent Events over fetch, which can send a key where EventSource cannot. Runs in pages and workers. */

const LONGEST_WAIT_MS = 5000;

/** The events of one answer (WHATWG HTML, 9.2.6), as {type, id, data}. */
export async function* eventsOf(response) {
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

/**
 * Follows a stream until `signal`, coming back with the id of the last event after every break. Without an
 * id to begin after, `resync` comes first. Resolves at the end, or once the key is refused.
 */
export async function followStream(path, { key, last, signal, onEvent }) {
  let wait = 250;
  while (!signal.aborted) {
    try {
      const response = await fetch(path, {
        signal, cache: 'no-cache',
        headers: {
          Accept: 'text/event-stream', ...(key && { Authorization: `Bearer ${key}` }), ...(last && { 'Last-Event-ID': last }),
        },
      });
      if (response.status === 401) return;
      if (response.ok) {
        for await (const event of eventsOf(response)) {
          wait = 250;
          // The stream begins at its first id: what came between the first reading of a list and this moment is in no event.
          if (!last && event.id) onEvent({ type: 'resync', id: event.id, data: '{}' });
          last = event.id ?? last;
          if (event.data !== undefined) onEvent(event);
        }
      }
    } catch {
      if (signal.aborted) return;
    }
    await new Promise((resolve) => { setTimeout(resolve, wait); });
    wait = Math.min(2 * wait, LONGEST_WAIT_MS);
  }
}
