/** Whether the service answers, and what time it is there. */

const NEAR_MS = 5000;
const AWAY_MS = 1000;
const TIMEOUT_MS = 4000;

/** Fires `change` whenever the service goes or comes back. */
class Connection extends EventTarget {
  up = true;
  #offset = 0;
  #timer = 0;

  watch() {
    fetch('/livez', { cache: 'no-store', signal: AbortSignal.timeout(TIMEOUT_MS) })
      .then((response) => {
        this.#setClock(response.headers.get('Date'));
        this.report(response.ok);
      })
      .catch(() => this.report(false))
      .finally(() => this.#schedule());
  }

  #schedule() {
    clearTimeout(this.#timer);
    this.#timer = setTimeout(() => this.watch(), this.up ? NEAR_MS : AWAY_MS);
  }

  /** What another request found out. */
  report(up) {
    if (up === this.up) return;
    this.up = up;
    this.dispatchEvent(new Event('change'));
    this.#schedule();
  }

  /** The time by the service's clock: a station's own may be hours off. */
  now() {
    return new Date(Date.now() + this.#offset);
  }

  #setClock(date) {
    const offset = Date.parse(date ?? '') - Date.now();
    // The field counts in seconds, so less than two says nothing.
    if (Number.isFinite(offset)) this.#offset = Math.abs(offset) < 2000 ? 0 : offset;
  }
}

export const connection = new Connection();
