/** What a file of tests stands on: a browser and a service for all of it. To import it is to have both. */

import { before } from 'node:test';

import { launch } from './browser.mjs';
import { Daemon } from './daemon.mjs';

export let browser;
export let daemon;

before(async () => {
  browser = await launch();
  daemon = await new Daemon().start();
});
