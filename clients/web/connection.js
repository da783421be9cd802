/** Whether the service answers, and what time it is there. */

const NEAR_MS = 5000;
const AWAY_MS = 1000;
const TIMEOUT_MS = 4000;

/** Fires `change` whenever the service goes or comes back. */
class Connection extends EventTarget {
  up = true;
  #offset = 0;
  #timeKnown = false;
  #timer = 0;

  watch() {
    this.#ask().catch(() => this.report(false)).finally(() => this.#schedule());
  }

  /** Resolves once the service has told its time; rejects while it cannot be reached. */
  async knowsTime() {
    if (!this.#timeKnown) await this.#ask();
  }

  async #ask() {
    const response = await fetch('/livez', { cache: 'no-store', signal: AbortSignal.timeout(TIMEOUT_MS) });
    this.#setClock(response.headers.get('Date'));
    this.report(response.ok);
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
    return this.at(Date.now());
  }

  /** A time of this station's clock by the service's. */
  at(milliseconds) {
    return new Date(milliseconds + this.#offset);
  }

  #setClock(date) {
    const offset = Date.parse(date ?? '') - Date.now();
    // The field counts in seconds, so less than two says nothing.
    this.#timeKnown = Number.isFinite(offset);
    if (this.#timeKnown) this.#offset = Math.abs(offset) < 2000 ? 0 : offset;
  }
}

export const connection = new Connection();
