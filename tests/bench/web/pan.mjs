/**
 * What a frame costs while the control chart of 10,000 values pans: the processor's time of the page's thread, which
 * does not depend on what else the machine does. 60 frames a second leave 16.7 ms.
 * FITGAUGED=build/release/bin/fitgauged tests/e2e/web/run tests/bench/web/pan.mjs [IN SIGHT...]
 */

import { close, launch, open } from '../../e2e/web/support/browser.mjs';
import { Daemon } from '../../e2e/web/support/daemon.mjs';

const VALUES = 10_000;
const FRAMES = 120;

const inSight = process.argv.slice(2).map(Number);
const browser = await launch();
const daemon = await new Daemon().start();
await daemon.send('POST', '/v1/measurements', Array.from({ length: VALUES }, (_, i) => (
  { designation: '25 H7', measured_mm: (25.0105 + 0.004 * Math.sin(i / 3) * Math.cos(i * i)).toFixed(4), part_id: `SN-${i}`, characteristic: 'pan' })));
const page = await open(browser, daemon, `#/trend?characteristic=pan&count=${VALUES}`, { viewport: { width: 1366, height: 900 } });
await page.waitForSelector('.control-chart .centre', { state: 'attached', timeout: 60000 });
const devtools = await page.context().newCDPSession(page);
await devtools.send('Performance.enable', { timeDomain: 'threadTicks' });
const spent = async () => (await devtools.send('Performance.getMetrics')).metrics.find(({ name }) => name === 'TaskDuration').value * 1000;

for (const count of inSight.length ? inSight : [300, 2000, 9000]) {
  await page.evaluate(() => { const whole = document.querySelector('.stretch button'); if (whole.checkVisibility()) whole.click(); });
  await page.waitForTimeout(300);
  const { x, y, width } = await (await page.$('.control-chart')).boundingBox();
  const { left, right } = { left: x + 70, right: x + width - 206 };
  await page.mouse.move(left, y + 100);
  await page.mouse.down();
  await page.mouse.move(left + (right - left) * count / VALUES, y + 100, { steps: 4 });
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
await close(page);
await browser.close();
await daemon.cleanup();
