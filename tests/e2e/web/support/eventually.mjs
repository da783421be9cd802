/** What becomes true a little later, as soon as the machine has time for it. */

import assert from 'node:assert/strict';

import { PATIENCE_MS } from './browser.mjs';
import { sleep } from './daemon.mjs';

const PAUSE_MS = 50;

/** Runs `check` until it throws no AssertionError; what it says in the end is why the test fails. */
export async function eventually(check) {
  for (const until = Date.now() + PATIENCE_MS;;) {
    try {
      return await check();
    } catch (problem) {
      if (!(problem instanceof assert.AssertionError) || Date.now() > until) throw problem;
    }
    await sleep(PAUSE_MS);
  }
}
