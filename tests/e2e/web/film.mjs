/**
 * tests/e2e/web/run tests/e2e/web/film.mjs: takes the pictures of docs/guide/gauging-station.md anew, from a
 * service of its own: scan, measure, reject with its cause, outage, sample, certificate.
 */

import path from 'node:path';

import { close, launch, open } from './support/browser.mjs';
import { Daemon } from './support/daemon.mjs';
import { scan } from './support/scanner.mjs';

const FOLDER = path.resolve('docs/images');
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

const browser = await launch();
const daemon = await new Daemon().start();
try {
  await daemon.send('PUT', '/v1/plans/4711-A', PLAN);
  await daemon.send('PUT', '/v1/plans/4712-A', SAMPLED);
  await daemon.send('PUT', '/v1/catalogues/turning', CATALOGUE);
  const page = await open(browser, daemon, '#/gauge?order=WO-4711', SCREEN);
  const take = (name) => page.screenshot({ path: path.join(FOLDER, `station-${name}.png`) });
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
  await page.click('text=Insert worn');
  await page.click('text=Insert changed');
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
} finally {
  await browser.close();
  await daemon.cleanup();
}
