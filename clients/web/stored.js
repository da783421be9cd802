/** What the browser keeps for the page. A browser that keeps nothing, or keeps it damaged, only forgets. */

const name = (key) => `fitgauge.${key}`;

// To name them can throw already, where the browser denies storage.
const PLACES = { local: () => localStorage, session: () => sessionStorage };

/** @param place `local`, or `session` for what ends with the window */
export function store(key, value, place = 'local') {
  try {
    PLACES[place]().setItem(name(key), value);
    return true;
  } catch {
    return false;
  }
}

export function readStored(key, place = 'local') {
  try {
    return PLACES[place]().getItem(name(key));
  } catch {
    return null;
  }
}

/** What was kept as JSON; `otherwise` where there is none that can be read. */
export function readJson(key, otherwise, place = 'local') {
  try {
    return JSON.parse(readStored(key, place)) ?? otherwise;
  } catch {
    return otherwise;
  }
}

export function forget(key, place = 'local') {
  try {
    PLACES[place]().removeItem(name(key));
  } catch {
    // there was nothing
  }
}

/** Stores what changes often a little later, so that no verdict waits for it, and at once where the page is left. */
export class LaterStore {
  static #DELAY_MS = 150;
  #timer = 0;

  /** @param write stores it; @param leaving ends the view */
  constructor(write, leaving) {
    this.write = write;
    addEventListener('pagehide', () => this.flush(), { signal: leaving });
    leaving.addEventListener('abort', () => this.flush());
  }

  changed() {
    this.#timer ||= setTimeout(() => this.flush(), LaterStore.#DELAY_MS);
  }

  /** Stores what has changed. */
  flush() {
    if (!this.#timer) return;
    clearTimeout(this.#timer);
    this.#timer = 0;
    this.write();
  }
}

/** The keys that begin with a prefix, in order. */
export function storedKeys(prefix, place = 'local') {
  try {
    return Object.keys(PLACES[place]())
      .filter((key) => key.startsWith(name(prefix)))
      .map((key) => key.slice(name('').length))
      .sort();
  } catch {
    return [];
  }
}
