/**
 * What a frame costs while the control chart of 10,000 and 100,000 values pans: the processor's time of the page's
 * thread, which does not depend on what else the machine does; 60 frames a second leave 16.7 ms. And how long the
 * chart takes from the service's answer until it is drawn.
 * FITGAUGED=build/release/bin/fitgauged tests/e2e/web/run tests/bench/web/pan.mjs [IN SIGHT...]
 */

import { close, launch, open } from '../../e2e/web/support/browser.mjs';
import { Daemon } from '../../e2e/web/support/daemon.mjs';

const CHARTS = [10_000, 100_000];
const FRAMES = 120;

const inSight = process.argv.slice(2).map(Number);
const browser = await launch();
const daemon = await new Daemon().start();
const seconds = (ms) => `${(ms / 1000).toFixed(2)} s`;

async function pan(page, count, values) {
  const devtools = await page.context().newCDPSession(page);
  await devtools.send('Performance.enable', { timeDomain: 'threadTicks' });
  const spent = async () => (await devtools.send('Performance.getMetrics')).metrics.find(({ name }) => name === 'TaskDuration').value * 1000;
  await page.evaluate(() => { const whole = document.querySelector('.stretch button'); if (whole.checkVisibility()) whole.click(); });
  await page.waitForTimeout(300);
  const { x, y, width } = await (await page.$('.control-chart .u-over')).boundingBox();
  await page.mouse.move(x + 12, y + 100);
  await page.mouse.down();
  await page.mouse.move(x + 12 + (width - 24) * count / values, y + 100, { steps: 4 });
  await page.mouse.up();
  await page.waitForTimeout(300);
  const before = await spent();
  const shown = await page.evaluate(async (frames) => {
    const slider = document.querySelector('.stretch input');
    for (let i = 0; i < frames; ++i) {
      slider.value = Math.round(slider.max * i / frames);
      slider.dispatchEvent(new Event('input'));
      await new Promise((resolve) => { requestAnimationFrame(() => requestAnimationFrame(resolve)); });
    }
    return document.querySelector('.stretch span').textContent;
  }, FRAMES);
  console.log(`${shown}: ${((await spent() - before) / FRAMES).toFixed(1)} ms a frame`);
}

for (const values of CHARTS) {
  await daemon.send('POST', '/v1/measurements', Array.from({ length: values }, (_, i) => (
    { designation: '25 H7', measured_mm: (25.0105 + 0.004 * Math.sin(i / 3) * Math.cos(i * i)).toFixed(4), part_id: `SN-${i}`, characteristic: `pan-${values}` })));
  const page = await open(browser, daemon, '#/parts', { viewport: { width: 1366, height: 900 } });
  await page.evaluate((address) => {
    performance.setResourceTimingBufferSize(1000);
    globalThis.began = performance.now();
    location.hash = address;
  }, `#/trend?characteristic=pan-${values}&count=${values}`);
  await page.waitForFunction((wanted) => document.querySelector('.control-chart')?.getAttribute('aria-label').includes(` ${wanted} `), values, { timeout: 120000 });
  const { read, answered, drawn } = await page.evaluate(() => {
    const ends = (name) => Math.max(...performance.getEntriesByType('resource').filter((each) => each.name.includes(name)).map(({ responseEnd }) => responseEnd));
    return { read: ends('/v1/measurements?') - globalThis.began, answered: ends('/v1/statistics/') - globalThis.began, drawn: performance.now() - globalThis.began };
  });
  console.log(`${values} values: read after ${seconds(read)}, figures of them after ${seconds(answered)}, drawn after ${seconds(drawn)}`);
  for (const count of inSight.length ? inSight : [300, 2000, 9 * values / 10]) await pan(page, count, values);
  await close(page);
}
await browser.close();
await daemon.cleanup();
