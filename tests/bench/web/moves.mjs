/**
 * What it takes to open a run of 100,000 moves in space: from the touch on the run to the frame that shows it, and the
 * processor's time of the page's thread in that, which does not depend on what else the machine does. Asked: a second.
 * FITGAUGED=build/release/bin/fitgauged tests/e2e/web/run tests/bench/web/moves.mjs [MOVES...]
 */

import fs from 'node:fs';

import { close, launch, open } from '../../e2e/web/support/browser.mjs';
import { Daemon } from '../../e2e/web/support/daemon.mjs';

const ROUNDS = 5;
const EXAMPLE = 'clients/nc/8255';
const PROGRAM = 'nc_prog/8255/8255.h';

const counts = process.argv.slice(2).map(Number);
const at = (k) => ({ X: 50 + 40 * Math.sin(k / 900), Y: 40 + 30 * Math.cos(k / 700), Z: k / 5000 });
const traceOf = (count) => JSON.stringify({ moves: Array.from({ length: count }, (_, i) => ({
  kind: ['rapid', 'feed', 'probe', 'arc'][i % 4], program: 'TNC:\\nc_prog\\8255\\8255.h', line: 1 + (i % 20),
  start_mm: at(i), end_mm: at(i + 1), feed_mm_min: 500, contact_mm: i % 4 === 2 ? at(i + 1) : null })) });

const browser = await launch();
const daemon = await new Daemon().start();
for (const name of ['8255.h', '82551.h', '82552.a']) await daemon.send('PUT', `/v1/files/nc_prog/8255/${name}`, fs.readFileSync(`${EXAMPLE}/${name}`, 'utf8'), 'text/plain');
await daemon.send('PUT', '/v1/setups/hole-good', fs.readFileSync(`${EXAMPLE}/setups/hole-good.json`, 'utf8'));
await daemon.send('POST', '/v1/runs', { program: 'TNC:\\nc_prog\\8255\\8255.h', setup: 'hole-good' });

for (const count of counts.length ? counts : [1000, 100_000]) {
  const body = traceOf(count);
  const taken = [];
  for (let round = 0; round < ROUNDS; ++round) {
    const page = await open(browser, daemon, `#/programs/${PROGRAM}`);
    await page.route('**/trace', (route) => route.fulfill({ contentType: 'application/json', body }));
    await page.waitForSelector('.earlier button');
    const devtools = await page.context().newCDPSession(page);
    await devtools.send('Performance.enable', { timeDomain: 'threadTicks' });
    const spent = async () => (await devtools.send('Performance.getMetrics')).metrics.find(({ name }) => name === 'TaskDuration').value * 1000;
    const before = await spent();
    const { wall, received } = await page.evaluate(async () => {
      const frame = () => new Promise((resolve) => { requestAnimationFrame(resolve); });
      const begin = performance.now();
      document.querySelector('.earlier button').click();
      while (!document.querySelector('.moves output')) await frame();
      await frame();
      await frame();
      const { responseEnd } = performance.getEntriesByType('resource').find(({ name }) => name.endsWith('/trace'));
      return { wall: performance.now() - begin, received: performance.now() - responseEnd };
    });
    taken.push({ wall, received, thread: await spent() - before, scene: Boolean(await page.$('.scene')) });
    await close(page);
  }
  const median = (name) => Math.round(taken.map((one) => one[name]).sort((one, other) => one - other)[ROUNDS >> 1]);
  console.log(`${count} moves (${(body.length / 1e6).toFixed(1)} MB)${taken[0].scene ? '' : ', without WebGL'}: shown ${median('wall')} ms after the touch, `
    + `${median('received')} ms after they were received; ${median('thread')} ms of the page's thread`);
}
await browser.close();
await daemon.cleanup();
