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
    const asked = Date.now();
    const response = await fetch('/livez', { cache: 'no-store', signal: AbortSignal.timeout(TIMEOUT_MS) });
    this.#setClock(response.headers.get('Date'), asked);
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

  /** The field counts in seconds, and was written at some time since the question: where the clocks may agree, they do. */
  #setClock(date, asked) {
    const written = Date.parse(date ?? '');
    this.#timeKnown = Number.isFinite(written);
    if (!this.#timeKnown) return;
    const [least, greatest] = [written - Date.now(), written + 1000 - asked];
    const offset = (least + greatest) / 2;
    this.#offset = least <= 0 && greatest >= 0 || Math.abs(offset) < 2000 ? 0 : offset;
  }
}

export const connection = new Connection();
