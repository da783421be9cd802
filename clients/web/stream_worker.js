/**
 * One event stream for all the tabs of a browser, which has six connections to a service: it runs while
 * a tab that is seen wants it. Each key has a stream of its own, so that no tab reads by another's key.
 */

import { followStream } from './stream.js';

const streams = new Map();

class Stream {
  #ports = new Set();
  #last;
  #ending;

  constructor(key) {
    this.key = key;
  }

  /** @param last the id of the last event this tab had, if any: one that may have missed some is told to read anew */
  join(port, last) {
    this.#ports.add(port);
    if (!this.#ending) this.#last ??= last;
    if (this.#ending && last !== this.#last) port.postMessage({ event: { type: 'resync', id: this.#last, data: '{}' } });
    if (!this.#ending) this.#run();
  }

  leave(port) {
    this.#ports.delete(port);
    if (this.#ports.size) return;
    this.#ending?.abort();
    this.#ending = undefined;
  }

  async #run() {
    const ending = new AbortController();
    this.#ending = ending;
    const tell = (message) => this.#ports.forEach((port) => port.postMessage(message));
    await followStream('/v1/events', {
      key: this.key, last: this.#last, signal: ending.signal,
      onEvent: (event) => {
        this.#last = event.id ?? this.#last;
        tell({ event });
      },
    });
    if (ending.signal.aborted) return;
    tell({ refused: true });
    this.#ports.clear();
    this.#ending = undefined;
  }
}

function streamOf(key) {
  if (!streams.has(key)) streams.set(key, new Stream(key));
  return streams.get(key);
}

globalThis.onconnect = ({ ports: [port] }) => {
  let joined;
  port.onmessage = ({ data: { join, key, last } }) => {
    joined?.leave(port);
    joined = join ? streamOf(key) : undefined;
    joined?.join(port, last);
  };
  port.postMessage({ ready: true });
};
