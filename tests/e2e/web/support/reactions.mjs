/** What a plan demands after a value that is not good, and the taps that answer it. */

import { sleep } from './daemon.mjs';
import { PAIR_MS } from './scanner.mjs';

/** One tap after the other, each in a time of its own: what comes sooner is the second of a pair, and no answer. */
export async function answer(page, ...texts) {
  for (const text of texts) {
    await sleep(PAIR_MS);
    await page.click(`.reactions >> text=${text}`);
  }
}
