/**
 * The pictures of docs/guide/gauging-station.md show the page as it is: scan, measure, reject with its cause, outage,
 * sample, certificate; and every view at four sizes, light and dark, on a sheet. docs/images/words.json has the words
 * of each. PICTURES=write tests/e2e/web/run tests/e2e/web/pictures_test.mjs takes them anew.
 */

import assert from 'node:assert/strict';
import fs from 'node:fs';
import path from 'node:path';
import { after, before, describe, it } from 'node:test';
import { isDeepStrictEqual } from 'node:util';

import { close, drawn, launch, open, PATIENCE_MS } from './support/browser.mjs';
import { Daemon } from './support/daemon.mjs';
import { answer } from './support/reactions.mjs';
import { scan } from './support/scanner.mjs';

const FOLDER = path.join('docs', 'images');
const WORDS = path.join(FOLDER, 'words.json');
const SCREEN = { viewport: { width: 1024, height: 768 }, deviceScaleFactor: 0.75, serviceWorkers: 'allow' };
const PLAN = { name: 'Bearing housing', characteristics: [
  { name: 'bore-A', designation: '25 H7', gauge: 'G-07', reaction: 'Stop, tell the setter', catalogue: 'turning' },
  { name: 'slot', nominal_mm: 8, feature: 'hole', upper_um: 36, lower_um: 0 },
] };
const SAMPLED = { name: 'Flange', characteristics: [
  { name: '4712-bore', designation: '25 H7' }, { name: '4712-seat', designation: '30 k6', subgroup_size: 5, frequency: 'each hour' },
  { name: '4712-slot', designation: '8 P9', frequency: 'every 5th part' },
] };

const CATALOGUE = {
  causes: ['Insert worn', 'Part clamped askew', 'Wrong offset', 'Part too warm'], measures: ['Insert changed', 'Offset corrected', 'Part scrapped'],
};

/** The share of squares of 8 pixels whose brightness differs by more than a fifth; 1 for another size. */
const difference = (page, one, other) => page.evaluate(async (pictures) => {
  const [a, b] = await Promise.all(pictures.map(async (base64) => {
    const image = await createImageBitmap(new Blob([Uint8Array.from(atob(base64), (byte) => byte.charCodeAt(0))]));
    const drawing = new OffscreenCanvas(Math.ceil(image.width / 8), Math.ceil(image.height / 8)).getContext('2d');
    drawing.imageSmoothingQuality = 'high';
    drawing.drawImage(image, 0, 0, image.width / 8, image.height / 8);
    return drawing.getImageData(0, 0, drawing.canvas.width, drawing.canvas.height);
  }));
  if (a.width !== b.width || a.height !== b.height) return 1;
  let different = 0;
  for (let at = 0; at < a.data.length; at += 4) {
    const brightness = (data) => data[at] * 0.3 + data[at + 1] * 0.59 + data[at + 2] * 0.11;
    if (Math.abs(brightness(a.data) - brightness(b.data)) > 51) different += 1;
  }
  return (different * 4) / a.data.length;
}, [one, other].map((bytes) => bytes.toString('base64')));

const keptWords = () => JSON.parse(fs.readFileSync(WORDS, 'utf8'));

/** The different lines of a page that have words, without ids, dates and figures: as soon as they are the kept ones; if they never are, those after a test's patience. */
async function wordsOf(page, name) {
  const kept = keptWords()[name];
  for (let left = PATIENCE_MS / 50; ; left -= 1) {
    const words = await page.evaluate(() => [...new Set(document.body.innerText
      .replace(/\bm\d+-[0-9a-f]{16}\b/g, '#').replace(/\d+([.,:]\d+)*/g, '#')
      .replace(/# (Jan|Feb|Mar|Apr|May|June?|July?|Aug|Sept?|Oct|Nov|Dec)\b( #)?(, #)?/g, '#').split('\n').map((line) => line.trim()).filter((line) => /\p{L}{2}/u.test(line)))]);
    if (left === 0 || isDeepStrictEqual(words, kept)) return words;
    await page.waitForTimeout(50);
  }
}

/** Checks that a page still has the words that its picture was taken with; PICTURES=write keeps them. */
function checkWords(name, words) {
  const kept = keptWords();
  if (process.env.PICTURES === 'write') {
    const lines = Object.entries({ ...kept, [name]: words }).map((entry) => entry.map((each) => JSON.stringify(each)).join(': '));
    fs.writeFileSync(WORDS, `{\n${lines.join(',\n')}\n}\n`);
  } else assert.deepEqual(words, kept[name], `the words of ${name} have changed; PICTURES=write takes it anew`);
}

describe('pictures of the guide', () => {
  const taken = new Map();
  const words = new Map();
  const committed = (name) => path.join(FOLDER, `station-${name}.png`);
  let browser;
  let daemon;
  let blank;
  before(async () => {
    browser = await launch();
    daemon = await new Daemon().start();
    blank = await browser.newPage();
  });
  after(() => daemon.cleanup());

  it('are taken', async () => {
    await daemon.send('PUT', '/v1/plans/4711-A', PLAN);
    await daemon.send('PUT', '/v1/plans/4712-A', SAMPLED);
    await daemon.send('PUT', '/v1/catalogues/turning', CATALOGUE);
    const page = await open(browser, daemon, '#/gauge?order=WO-4711', SCREEN);
    const take = async (name) => {
      words.set(name, await wordsOf(page, `station-${name}`));
      taken.set(name, await page.screenshot());
    };
    const verdict = (state) => page.waitForSelector(`.verdict[data-verdict="${state}"]:not([data-provisional])`);
    const measure = async (characteristic, value) => {
      await page.waitForFunction((name) => document.querySelector('.tiles-of-plan [aria-current]')?.textContent.includes(name), characteristic);
      await scan(page, value);
    };
    await page.waitForSelector('.plan select:visible');
    await scan(page, '4711-A');
    await page.waitForSelector('.echo .figures');
    await scan(page, 'SN-00017');
    await take('scan');
    await measure('bore-A', '25.0131');
    await verdict('good');
    await take('measure');
    await measure('slot', '8.021');
    await scan(page, 'SN-00018');
    await measure('bore-A', '25.0302');
    await verdict('reject');
    await take('reject');
    await answer(page, 'Insert worn', 'Insert changed');
    await daemon.stop();
    await measure('slot', '8.017');
    await page.waitForSelector('.verdict[data-provisional="away"]');
    await page.waitForSelector('.link[data-state="away"]');
    await take('outage');
    await daemon.start();
    await page.waitForSelector('.link[data-state="up"]');
    await page.getByRole('button', { name: 'Seen' }).click();
    await scan(page, '4712-A');
    await page.waitForSelector('.tiles-of-plan li:nth-child(3)');
    for (const [part, bore, seat, slot] of [['SN-00041', '25.011', '30.009', '7.976'], ['SN-00042', '25.013', '30.008']]) {
      await scan(page, part);
      await measure('4712-bore', bore);
      await measure('4712-seat', seat);
      if (slot) await measure('4712-slot', slot);
    }
    await scan(page, 'SN-00043');
    await measure('4712-bore', '25.012');
    await verdict('good');
    await take('sample');
    await page.goto(`${daemon.url}/#/parts?order=WO-4711`);
    await page.waitForSelector('.records tbody tr');
    await page.click('.certificate summary');
    await page.getByLabel('Company').fill('Muster GmbH');
    await take('certificate');
    await close(page);
    if (process.env.PICTURES === 'write') for (const [name, bytes] of taken) fs.writeFileSync(committed(name), bytes);
  });

  for (const name of ['scan', 'measure', 'reject', 'outage', 'sample', 'certificate']) {
    it(`${name} is of this page`, async () => {
      const share = await difference(blank, taken.get(name), fs.readFileSync(committed(name)));
      assert.ok(share < 0.02, `${(share * 100).toFixed(1)} % of ${committed(name)} is different; PICTURES=write takes it anew`);
      checkWords(`station-${name}`, words.get(name));
    });
  }

  it('are told apart', async () => {
    assert.ok(await difference(blank, taken.get('reject'), taken.get('measure')) > 0.05);
    assert.notDeepEqual(words.get('reject'), words.get('measure'));
  });
});

describe('sheets of every view', () => {
  const NOW = '2026-03-10T09:00:00Z';
  const SIZES = [[390, 844], [1024, 768], [1366, 768], [3840, 2160]];
  const ROW_PX = 216;
  /** The address of each, and what stands there when it is drawn. */
  const VIEWS = {
    gauge: ['gauge?plan=4711-A&part_id=SN-00017', '.verdict .word'], fit: ['fit/25H7/g6', '.fit .headline'], trend: ['trend?characteristic=bore-A', '.indices .stability'], overview: ['overview', '.scroll[data-settled]'],
    parts: ['parts?part_id=SN-00017', '.part-verdict'], plans: ['plans/4711-A', '.editor:not([hidden]) .characteristic'], programs: ['programs/nc_prog/probe.h', '.cm-line'], tables: ['tables', '.grid tbody tr'],
    gauges: ['gauges', '.listed tbody tr'], connections: ['connections', '.connections form'],
  };
  const committed = (view) => path.join(FOLDER, `view-${view}.png`);
  let browser;
  let daemon;
  let blank;
  before(async () => {
    browser = await launch();
    daemon = await new Daemon().start();
    blank = await browser.newPage();
    await daemon.send('PUT', '/v1/catalogues/turning', CATALOGUE);
    await daemon.send('PUT', '/v1/plans/4711-A', PLAN);
    await daemon.send('PUT', '/v1/uncertainties/bore', { contributions: [{ name: 'ring', standard_uncertainty: 0.3 }] });
    await daemon.send('PUT', '/v1/gauges-in-use/G-07', { uncertainty: 'bore', calibration_due: '2099-03-31' });
    await daemon.send('PUT', '/v1/files/nc_prog/probe.h', 'BEGIN PGM PROBE MM\nTOOL CALL 30 Z\nL Z+50 R0 FMAX\nTCH PROBE 427 MEASURE COORDINATE ~\n  Q263=+50 ~\n  Q264=+40\nEND PGM PROBE MM\n', 'text/plain');
    const of = (i, characteristic, size) => ({ part_id: `SN-${String(i).padStart(5, '0')}`, characteristic, ...size, machine: `M${1 + i % 2}`, measured_at: new Date(Date.parse(NOW) - (61 - i) * 600_000).toISOString() });
    await daemon.send('POST', '/v1/measurements', Array.from({ length: 60 }, (_, i) => [
      of(i, 'bore-A', { designation: '25 H7', measured_mm: (25.0105 + 0.004 * Math.sin(i * 2.4)).toFixed(4) }),
      ...(i === 17 ? [] : [of(i, 'slot', { nominal_mm: 8, feature: 'hole', upper_um: 36, lower_um: 0, measured_mm: (8.018 + 0.012 * Math.sin(i * 1.7)).toFixed(4) })])]).flat());
  });
  after(() => daemon.cleanup());

  /** A picture of a view at each size, light above dark. */
  async function sheetOf(view, [address, mark]) {
    const rows = [];
    let words;
    for (const colorScheme of ['light', 'dark']) {
      const page = await open(browser, daemon, `#/${address}`, { at: NOW, timezoneId: 'Europe/Berlin', colorScheme });
      await page.waitForSelector(mark);
      await page.setViewportSize({ width: SIZES.at(-1)[0], height: SIZES.at(-1)[1] });
      words = await wordsOf(page, `view-${view}`); // all is there before a picture is taken
      const row = [];
      for (const [width, height] of SIZES) {
        await page.setViewportSize({ width, height });
        await drawn(page);
        row.push(`<img height="${ROW_PX}" src="data:image/png;base64,${(await page.screenshot()).toString('base64')}">`);
      }
      rows.push(`<p>${row.join('')}</p>`);
      await close(page);
    }
    await blank.setContent(`<style>body { margin: 0 } p { display: flex; gap: 6px; margin: 0 0 6px }</style><main style="width: max-content">${rows.join('')}</main>`);
    await blank.evaluate(() => Promise.all([...document.images].map((image) => image.decode())));
    return { words, sheet: await blank.locator('main').screenshot() };
  }

  for (const [view, how] of Object.entries(VIEWS)) {
    it(`${view} is of this page`, async () => {
      const { words, sheet } = await sheetOf(view, how);
      if (process.env.PICTURES === 'write') fs.writeFileSync(committed(view), sheet);
      const share = await difference(blank, sheet, fs.readFileSync(committed(view)));
      assert.ok(share < 0.02, `${(share * 100).toFixed(1)} % of ${committed(view)} is different; PICTURES=write takes it anew`);
      checkWords(`view-${view}`, words);
    });
  }
});
