/** What a reader of the control chart, which is a canvas, sees of it and hears of it. */

import { open } from './browser.mjs';

/** A page with a control chart, whose lettering `lettering` can tell. */
export async function openChart(browser, daemon, fragment, options) {
  const page = await open(browser, daemon, '#/parts', options);
  await page.evaluate(() => {
    const { clearRect, fillText } = CanvasRenderingContext2D.prototype;
    globalThis.lettering = new WeakMap();
    Object.assign(CanvasRenderingContext2D.prototype, {
      clearRect(...at) {
        globalThis.lettering.set(this.canvas, []);
        clearRect.apply(this, at);
      },
      fillText(text, ...at) {
        globalThis.lettering.get(this.canvas)?.push({ text, font: this.font });
        fillText.call(this, text, ...at);
      },
    });
  });
  await page.evaluate((address) => { location.hash = address; }, fragment);
  await page.waitForSelector('.trend');
  return page;
}

/** Waits until the chart says that it shows so many points. */
export const untilPoints = (page, count) => page.waitForFunction((wanted) =>
  Number(/\d+/.exec(document.querySelector('.control-chart')?.getAttribute('aria-label') ?? '')) === wanted, count);

/** The texts that stand on the chart. */
export const lettering = (page) => page.$eval('.control-chart canvas', (canvas) => globalThis.lettering.get(canvas).map(({ text }) => text));

/** The least height of these, in pixels of the page. */
export const leastLettering = (page) => page.$eval('.control-chart canvas', (canvas) => {
  const shown = canvas.getBoundingClientRect().width / canvas.width;
  return Math.min(...globalThis.lettering.get(canvas).map(({ font }) => parseFloat(/[\d.]+(?=px)/.exec(font)) * shown));
});

/**
 * Where marks of a verdict stand: the middle of each patch of its colour, in pixels of the page.
 * @param name of the colour in the style sheets
 */
export const marksOf = (page, name) => page.evaluate((variable) => {
  const canvas = document.querySelector('.control-chart canvas');
  const probe = document.querySelector('.trend figure').appendChild(document.createElement('i'));
  probe.className = 'colour-of';
  probe.style.color = `var(--${variable})`;
  const [r, g, b] = getComputedStyle(probe).color.match(/\d+/g).map(Number);
  probe.remove();
  const { width, height } = canvas;
  const { data } = canvas.getContext('2d').getImageData(0, 0, width, height);
  const isOf = (at) => data[4 * at] === r && data[4 * at + 1] === g && data[4 * at + 2] === b && data[4 * at + 3] === 255;
  const seen = new Uint8Array(width * height);
  const place = canvas.getBoundingClientRect();
  const found = [];
  for (let first = 0; first < seen.length; ++first) {
    if (seen[first] || !isOf(first)) continue;
    const patch = [first];
    seen[first] = 1;
    for (let n = 0; n < patch.length; ++n) {
      const at = patch[n];
      for (const next of [at - 1, at + 1, at - width, at + width]) {
        if (next < 0 || next >= seen.length || seen[next] || !isOf(next)) continue;
        seen[next] = 1;
        patch.push(next);
      }
    }
    const mean = (values) => values.reduce((sum, value) => sum + value, 0) / values.length + 0.5;
    if (patch.length > 16) {
      found.push({ x: place.left + mean(patch.map((at) => at % width)) * place.width / width, y: place.top + mean(patch.map((at) => Math.floor(at / width))) * place.height / height });
    }
  }
  return found;
}, name);
