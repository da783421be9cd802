/** What a view asks the service: where there is no answer it says why, and asks again once the service is back. */

import { connection } from './connection.js';
import { explain } from './i18n.js';

export class Asked {
  #turn = 0;
  /** Whether what is shown is not what was asked for. */
  failed = false;

  /** @param work asks and shows the answer; @param again does so after an outage; @param say takes why there is none, '' once there is; @param leaving ends it */
  constructor(work, { again = () => this.run(), say, leaving }) {
    Object.assign(this, { work, say, leaving });
    connection.addEventListener('change', () => { if (connection.up && this.failed) again(); }, { signal: leaving });
  }

  async run(...given) {
    const turn = ++this.#turn;
    try {
      await this.work(...given);
      if (turn !== this.#turn || !this.failed) return;
      this.failed = false;
      this.say('');
    } catch (problem) {
      if (turn === this.#turn) this.fail(problem);
    }
  }

  /** A part of what was asked has failed: all of it is asked again. */
  fail(problem) {
    if (this.leaving.aborted) return;
    ++this.#turn;
    this.failed = true;
    this.say(explain(problem));
    if (problem instanceof TypeError || problem.away) connection.report(false); // not where a name alone is refused
  }
}
