/**
 * What it takes to open a run of 100,000 moves in space: from the touch on the run to the frame that shows it, and the
 * processor's time of the page's thread in that, which does not depend on what else the machine does. Asked: a second.
 * The run is a real one, and its trace comes from the service.
 * FITGAUGED=build/release/bin/fitgauged tests/e2e/web/run tests/bench/web/moves.mjs [MOVES...]
 */

import { close, launch, open } from '../../e2e/web/support/browser.mjs';
import { Daemon } from '../../e2e/web/support/daemon.mjs';

const ROUNDS = 5;
const PROGRAM = 'nc_prog/many.h';

const counts = process.argv.slice(2).map(Number);
/** A spiral. */
const programOf = (count) => `0 BEGIN PGM MANY MM
1 Q1 = 0
2 LBL 1
3 Q1 = Q1 + 1
4 Q2 = 50 + 40 * SIN Q1
5 Q3 = 40 + 30 * COS Q1
6 Q4 = 10 - Q1 / 5000
7 L X+Q2 Y+Q3 Z+Q4 R0 F500
8 FN 12: IF +Q1 LT +${count} GOTO LBL 1
9 END PGM MANY MM
`;

const browser = await launch();
const daemon = await new Daemon().start();

for (const count of counts.length ? counts : [1000, 100_000]) {
  await daemon.send('PUT', `/v1/files/${PROGRAM}`, programOf(count), 'text/plain');
  const run = await (await daemon.send('POST', '/v1/runs', { program: 'TNC:\\nc_prog\\many.h', limits: { seconds: 60 } })).json();
  const { moves, dropped } = await daemon.json(`/v1/runs/${run.id}/trace`);
  if (moves.length !== count || dropped) throw new Error(`${run.status}: ${moves.length} moves, ${dropped} dropped: ${JSON.stringify(run.messages)}`);
  const taken = [];
  let sent = 0;
  for (let round = 0; round < ROUNDS; ++round) {
    const page = await open(browser, daemon, `#/programs/${PROGRAM}`);
    await page.waitForSelector('.earlier button');
    const devtools = await page.context().newCDPSession(page);
    await devtools.send('Performance.enable', { timeDomain: 'threadTicks' });
    const spent = async () => (await devtools.send('Performance.getMetrics')).metrics.find(({ name }) => name === 'TaskDuration').value * 1000;
    const before = await spent();
    const { wall, received, bytes } = await page.evaluate(async () => {
      const frame = () => new Promise((resolve) => { requestAnimationFrame(resolve); });
      const begin = performance.now();
      document.querySelector('.earlier button').click();
      while (!document.querySelector('.moves output')) await frame();
      await frame();
      await frame();
      const { responseEnd, encodedBodySize } = performance.getEntriesByType('resource').find(({ name }) => name.endsWith('/trace'));
      return { wall: performance.now() - begin, received: performance.now() - responseEnd, bytes: encodedBodySize };
    });
    sent = bytes;
    taken.push({ wall, received, thread: await spent() - before, scene: Boolean(await page.$('.scene')) });
    await close(page);
  }
  const ordered = (name) => taken.map((one) => one[name]).sort((one, other) => one - other);
  const median = (name) => Math.round(ordered(name)[ROUNDS >> 1]);
  console.log(`${count} moves (${(sent / 1e6).toFixed(1)} MB sent)${taken[0].scene ? '' : ', without WebGL'}: shown ${median('wall')} ms after the touch `
    + `(quickest ${Math.round(ordered('wall')[0])}), ${median('received')} ms after they were received; ${median('thread')} ms of the page's thread`);
}
await browser.close();
await daemon.cleanup();
