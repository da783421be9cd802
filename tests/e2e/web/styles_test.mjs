/** No style sheet hides what a view shows, and every view has the room it needs: found by computed styles. */

import assert from 'node:assert/strict';
import { before, describe, it } from 'node:test';

import { close, drawn, open } from './support/browser.mjs';
import { browser, daemon } from './support/stage.mjs';

/** What is there for the eye at another time: on paper, for screen readers, or where a folder is opened. */
const ELSEWHERE = '.printed, .skip, .unseen, datalist, option, script, style, template, details:not([open]) > *, dialog:not([open]), source, .colour-of';

/** Elements that a style sheet hides, though no attribute does. */
const hidden = (page) => page.evaluate((elsewhere) => {
  const isShown = (element) => !element.closest(`[hidden], ${elsewhere}`);
  const says = (element) => [...element.childNodes].some((child) => !child.hidden) || ['path', 'circle', 'rect', 'line', 'canvas', 'input'].includes(element.localName);
  return [...document.querySelectorAll('main *')].filter((element) => isShown(element) && says(element)).filter((element) => {
    const { display, visibility } = getComputedStyle(element);
    return display === 'none' || visibility === 'hidden';
  }).map((element) => element.outerHTML.slice(0, 90));
}, ELSEWHERE);

describe('the style sheets', () => {
  before(async () => {
    await daemon.send('PUT', '/v1/plans/4711-A', { characteristics: [{ name: 'bore-A', designation: '25 H7' }, { name: 'bore-B', designation: '40 H8' }] });
    await daemon.send('POST', '/v1/measurements', Array.from({ length: 30 }, (_, i) => ({
      designation: '25 H7', measured_mm: `25.0${10 + i % 7}`, part_id: `SN-${i}`, characteristic: 'bore-A', machine: i % 2 ? 'M1' : 'M2', operator: 'Kim' })));
  });

  it('show every move of a program that probes, in the drawing and in its legend', async () => {
    const page = await open(browser, daemon, '#/programs');
    await page.click('.empty .actions button >> text=8255');
    await page.waitForSelector('.path');
    if (await page.$('.switch >> text=As a drawing')) await page.click('.switch >> text=As a drawing');
    await page.waitForSelector('.path-view path.probe');
    assert.deepEqual(await hidden(page), []);
    const looks = await page.$$eval('path.probe', (all) => all.map((path) => [getComputedStyle(path).display, getComputedStyle(path).stroke !== 'none']));
    assert.ok(looks.length >= 3 && looks.every(([display, stroke]) => display !== 'none' && stroke), JSON.stringify(looks));
    // The run says why it is good, and is gone through by block.
    assert.match(await page.textContent('.report .sizes thead'), /Deviation, µmCharacteristicMeasured, mmNominal, mmLimits, mm/);
    const lines = await page.$$eval('.report .sizes :is(td.number, td:nth-child(6))', (cells) => cells.map((cell) => {
      const range = document.createRange();
      range.selectNodeContents(cell);
      return new Set([...range.getClientRects()].map(({ top }) => top)).size;
    }));
    assert.ok(lines.length >= 4 && lines.every((count) => count === 1), `a figure or its limits in ${lines} lines`);
    assert.doesNotMatch(await page.textContent('.report .sizes tbody'), /mm|µm/);
    assert.match(await page.textContent('.moves output'), /\S/);
    await page.click('.steps button:first-child');
    await page.click('.steps button:last-child');
    await close(page);
  });

  it('have room for what was measured and how it is, whatever the width and the language', async () => {
    const page = await open(browser, daemon, '#/programs');
    await page.click('.empty .actions button >> text=8255');
    await page.waitForSelector('.report .sizes td');
    const names = await page.$$eval('.report .sizes thead th', (all) => all.map(({ textContent }) => textContent));
    const columns = ['Verdict', 'Deviation, µm', 'Characteristic', 'Measured, mm'].map((name) => names.indexOf(name));
    for (const language of ['de', 'it', 'nl', 'en']) {
      await page.selectOption('#language', language);
      await page.waitForFunction((wanted) => document.documentElement.lang === wanted, language);
      await page.waitForSelector('.report .sizes td');
      for (const width of [1024, 1280, 1366, 1536]) {
        await page.setViewportSize({ width, height: 768 });
        await drawn(page);
        const cut = await page.$eval('.report .sizes', (place, wanted) => {
          const { left, right } = place.getBoundingClientRect();
          return [...place.querySelectorAll('tr')].flatMap(({ cells }) => wanted.map((i) => {
            const range = document.createRange();
            range.selectNodeContents(cells[i]);
            return [cells[i].textContent, range.getBoundingClientRect()];
          }).filter(([text, at]) => text && (at.left < left || at.right > Math.min(right, innerWidth))).map(([text]) => text));
        }, columns);
        assert.deepEqual(cut, [], `${language} at ${width}`);
      }
    }
    await close(page);
  });

  const VIEWS = {
    'gauge?plan=4711-A&part_id=SN-1': '.tiles-of-plan li', 'fit/25H7/g6': '.zones', 'trend?characteristic=bore-A': '.control-chart',
    overview: '.scroll[data-settled]', 'overview?look=heat': '.heat .picture .cell', 'overview?look=wall': '.wall .spark', parts: '.records tbody tr', tables: '.grid tbody tr', plans: '.plans-there tbody tr', 'plans/4711-A': '.editor .characteristic', connections: '.connections form',
    gauges: '.study-grid input',
  };
  for (const [view, drawn] of Object.entries(VIEWS)) {
    it(`hide nothing of ${view}`, async () => {
      const page = await open(browser, daemon, `#/${view}`);
      await page.waitForSelector(drawn);
      assert.deepEqual(await hidden(page), []);
      await close(page);
    });
  }

  it('leave the width of the list to the panel before the first value', async () => {
    const page = await open(browser, daemon, '#/gauge/25H7', { viewport: { width: 1366, height: 768 } });
    await page.waitForSelector('.echo .figures');
    assert.equal(await page.$eval('.verdict', (panel) => Math.round(panel.getBoundingClientRect().right)), 1366);
    await close(page);
  });

  it('show a verdict with its limits, and the last ten values beside them, without scrolling', async () => {
    const page = await open(browser, daemon, '#/gauge/25H7?characteristic=bore-R', { viewport: { width: 1366, height: 768 } });
    await page.waitForSelector('.echo .figures');
    const values = Array.from({ length: 12 }, (_, i) => (i === 5 ? '25.030' : `25.0${10 + i}`));
    for (const [i, value] of values.entries()) {
      await page.keyboard.type(`${value}\n`);
      await page.waitForFunction((count) => document.querySelectorAll('.recent li.stored').length === count, i + 1);
    }
    await page.waitForSelector('.verdict[data-verdict="good"]:not([data-provisional])');
    const dots = await page.$$eval('.lately .dot', (all) => all.map((dot) => [dot.getAttribute('cx'), dot.getAttribute('cy')].map(Number)));
    assert.equal(dots.length, 10);
    // The value above the limit, the fourth of the ten, is the highest and above the zone; the others rise.
    const zone = await page.$eval('.lately .zone', (one) => Number(one.getAttribute('y')));
    assert.deepEqual(dots.map(([, y], i) => [i, y < zone]).filter(([, isOut]) => isOut), [[3, true]]);
    assert.ok(dots.filter((_, i) => i !== 3).every(([x, y], i, all) => i === 0 || (x > all[i - 1][0] && y < all[i - 1][1])), JSON.stringify(dots));
    for (const height of [640, 768, 800, 860, 900]) {
      await page.setViewportSize({ width: 1366, height });
      const ends = await page.$$eval('.verdict :is(.strip, .lately)', (all) => all.map((one) => Math.round(one.getBoundingClientRect().bottom)));
      assert.ok(ends.length === 2 && ends.every((end) => end <= height), `${ends} of ${height}`);
    }
    await page.click('.recent li:nth-child(7) .fix button'); // another value in the place of the reject
    await page.keyboard.type('25.0105\n');
    await page.waitForFunction(() => document.querySelectorAll('.recent li.stored:not(.corrected)').length === 12 && /25.0105/.test(document.querySelector('.verdict').textContent));
    await page.waitForFunction(() => [...document.querySelectorAll('.lately .dot')].every((dot) => Number(dot.getAttribute('cy')) >= Number(document.querySelector('.lately .zone').getAttribute('y'))));
    await close(page);
  });

  it('have what corrects a value beside what corrects its part', async () => {
    const page = await open(browser, daemon, '#/gauge/25H7?part_id=SN-FIX&characteristic=bore-F', { viewport: { width: 1366, height: 768 } });
    await page.waitForSelector('.echo .figures');
    await page.keyboard.type('25.010\n');
    await page.waitForSelector('.recent .fix a');
    const tops = await page.$$eval('.recent .fix button', (all) => all.map((button) => button.getBoundingClientRect().top));
    assert.ok(tops.length === 2 && tops[0] === tops[1], tops.join());
    await close(page);
  });

  it('have every view of the bar in sight at 1024 in Italian, and what is done with a record at 1366', async () => {
    const page = await open(browser, daemon, '#/parts', { viewport: { width: 1024, height: 768 }, locale: 'it-IT' });
    await page.waitForSelector('.records tbody tr');
    const ends = () => page.$eval('#views', (nav) => [nav.scrollWidth, nav.clientWidth]);
    const [whole, seen] = await ends();
    assert.ok(whole <= seen, `${whole} in ${seen}`);
    await page.setViewportSize({ width: 1366, height: 768 });
    const right = await page.$$eval('.records tbody tr:first-child .quiet', (all) => all.map((button) => button.getBoundingClientRect().right));
    assert.ok(right.length === 2 && right.every((x) => x <= 1366), right.join());
    await close(page);
  });
});
