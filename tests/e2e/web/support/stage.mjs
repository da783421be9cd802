/** What a file of tests stands on: a browser and a service for all of it. To import it is to have both. */

import { before } from 'node:test';

import { launch } from './browser.mjs';
import { Daemon } from './daemon.mjs';

export let browser;
export let daemon;

let first = 0;

/** What is stored from here on is the test's own; a service that a failed test has left away is back. */
export async function begin() {
  if (!daemon.isRunning) await daemon.start();
  first = (await daemon.stored()).length;
}

/** What was stored since then. */
export const storedSince = async () => (await daemon.stored()).slice(first);

before(async () => {
  browser = await launch();
  daemon = await new Daemon().start();
});
