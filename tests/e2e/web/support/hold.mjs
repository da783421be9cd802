/** A service that takes its time. */

import { sleep } from './daemon.mjs';

const wait = () => { AbortSignal.timeout = () => new AbortController().signal; };

/** From here on the page waits for an answer as long as it takes, as a test that holds it back on a busy machine needs. */
export async function patient(page) {
  await page.addInitScript(wait);
  await page.evaluate(wait);
}

/** Until the page says that it waits for an answer, or waits for none any more. */
export const waits = (page, is = true) => page.waitForFunction((wanted) => (document.getElementById('loading').textContent !== '') === wanted, is);

/** All that is asked there waits. @returns what lets it through */
export async function holdAll(page, where) {
  let go;
  const told = new Promise((resolve) => { go = resolve; });
  await patient(page);
  await page.route(where, async (route) => {
    await told;
    await route.continue().catch(() => {}); // the page may have given it up
  });
  return go;
}

/** What is asked there waits. @returns what lets the oldest question through, once it was asked */
export async function hold(page, where) {
  const held = [];
  await patient(page);
  await page.route(where, async (route) => {
    await new Promise((resolve) => { held.push(resolve); });
    await route.continue();
  });
  return async () => {
    while (!held.length) await sleep(5);
    held.shift()();
  };
}

/** The next question there waits. @param stage a page, or the context of one that is opened later. @returns {asked, go}: the promise that it was asked, and what lets it through */
export async function holdNext(stage, where) {
  let go;
  let tell;
  const asked = new Promise((resolve) => { tell = resolve; });
  const told = new Promise((resolve) => { go = resolve; });
  await stage.addInitScript(wait);
  await stage.route(where, async (route) => {
    tell();
    await told;
    await route.continue().catch(() => {}); // the page may have given it up
  }, { times: 1 });
  return { asked, go };
}
