/**
 * What it takes to open the station where a round trip takes 100 ms: from the address to a field that takes keys, the
 * first time and the second, with the requests and bytes of each. Asked: 0.9 s and 60 kB the first time, and no
 * round trip for unchanged modules the second.
 * FITGAUGED=build/release/bin/fitgauged tests/e2e/web/run tests/bench/web/load.mjs
 */

import { launch } from '../../e2e/web/support/browser.mjs';
import { Daemon } from '../../e2e/web/support/daemon.mjs';

const ROUND_TRIP_MS = 100;
const ROUNDS = 7;

const browser = await launch();
const daemon = await new Daemon().start();
const found = { first: [], second: [] };

async function load(page, address) {
  await page.goto(address);
  const usable = await page.evaluate(async () => {
    while (!document.querySelector('#value')) await new Promise((resolve) => { setTimeout(resolve, 2); });
    return performance.now();
  });
  await page.waitForSelector('.echo .figures');
  const limits = await page.evaluate(() => performance.now());
  await page.waitForLoadState('networkidle', { timeout: 5000 }).catch(() => {});
  const files = await page.evaluate(() => [...performance.getEntriesByType('navigation'), ...performance.getEntriesByType('resource')]
    .filter(({ name }) => !name.includes('/v1/')).map(({ transferSize, encodedBodySize }) => ({ sent: transferSize, size: encodedBodySize })));
  return { usable, limits, asked: files.filter(({ sent }) => sent > 0).length, bytes: files.reduce((sum, { sent }) => sum + sent, 0) };
}

for (let round = 0; round < ROUNDS; ++round) {
  const context = await browser.newContext({ serviceWorkers: 'block' });
  const page = await context.newPage();
  const devtools = await context.newCDPSession(page);
  await devtools.send('Network.enable');
  await devtools.send('Network.emulateNetworkConditions', { offline: false, latency: ROUND_TRIP_MS, downloadThroughput: -1, uploadThroughput: -1 });
  for (const time of ['first', 'second']) found[time].push(await load(page, `${daemon.url}/?${time}#/gauge/25H7`));
  await context.close();
}
const median = (rows, name) => rows.map((row) => row[name]).sort((one, other) => one - other)[rows.length >> 1];
for (const [time, rows] of Object.entries(found)) {
  console.log(`${time} load at ${ROUND_TRIP_MS} ms: usable after ${median(rows, 'usable').toFixed(0)} ms, its limits shown after ${median(rows, 'limits').toFixed(0)} ms; `
    + `${median(rows, 'asked')} requests for files of the page, ${(median(rows, 'bytes') / 1000).toFixed(1)} kB`);
}
await browser.close();
await daemon.cleanup();
