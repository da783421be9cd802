/** Answers that cannot be the wrong ones: a newer question, and leaving the view, end the one before. */

/** Lets the page answer its reader amid long work: a turn of its own, without the 4 ms that a timer waits. */
export const pause = () => new Promise((resolve) => {
  const { port1, port2 } = new MessageChannel();
  port1.onmessage = () => { port1.close(); resolve(); };
  port2.postMessage(null);
});

/** `act` for calls that come while one still runs: each waits for the one before. The second of two clicks, with nothing typed between them, is the first. */
export function inTurn(act, textOf) {
  let last = Promise.resolve();
  let asked;
  return (...given) => {
    const text = textOf();
    if (text === asked) return last;
    asked = text;
    last = last.catch(() => {}).then(() => act(...given)).finally(() => { if (asked === text) asked = undefined; });
    return last;
  };
}

export class Latest {
  #question = new AbortController();

  /** @param leaving the signal of the view that is left */
  constructor(leaving) {
    leaving?.addEventListener('abort', () => this.#question.abort());
    this.leaving = leaving;
  }

  /** Runs `work` with a signal for its requests. What was overtaken ends in silence. */
  async run(work) {
    this.#question.abort();
    const question = new AbortController();
    this.#question = question;
    if (this.leaving?.aborted) question.abort();
    try {
      const result = await work(question.signal);
      return question.signal.aborted ? undefined : result;
    } catch (problem) {
      if (question.signal.aborted) return undefined;
      throw problem;
    }
  }
}
