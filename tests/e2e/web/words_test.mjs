/**
 * Every word of the page is in the reader's language: texts by code, and nothing that slips past the tables of
 * texts.
 *
 * Tried, and held here:
 * - Any refusal or finding in German, Dutch, Italian: every code in four languages
 */

import assert from 'node:assert/strict';
import fs from 'node:fs';
import path from 'node:path';
import { before, describe, it } from 'node:test';

import { close, launch, open } from './support/browser.mjs';
import { Daemon } from './support/daemon.mjs';
import { drawingOf, dropFile, housing } from './support/drawing.mjs';
import { known } from './support/scanner.mjs';

const LANG = path.resolve('clients/web/lang');
const textsOf = async (file) => (await import(path.join(LANG, `${file}.js`))).default;
const codesOf = (file) => [...fs.readFileSync(file, 'utf8').matchAll(/^\w+\(\w+,\s*"([^"]+)"/gm)].map((match) => match[1]);

/** Words that are the same in every language, or come from the test's own data. */
const KNOWN = /FITGAUGE-TEST:\S+|fitgauge|DIN 6885-1:1968|127\.0\.0\.1:\d+|PRESS9|bore-1|G-07|SN-\d+|WO-17|M3\b|IT\d+|Cpk|Ppk|nc_prog|826?\.?\w*\.[hHaA]|Q\w?\d+|\bm[\w-]*\d\b|\d+\.? \p{L}+\.? \d{4}|gibberish|Letter|TNC:|\b[a-z_]+\.[a-z_]+\b/gu;

describe('the words', () => {
  let browser;
  let daemon;

  before(async () => {
    browser = await launch();
    daemon = await new Daemon().start();
    await daemon.send('PUT', '/v1/files/nc_prog/82.h', '0 BEGIN PGM 82 MM\n1 CALL LBL 5\n2 END PGM 82 MM\n', 'text/plain');
    await daemon.send('PUT', '/v1/tables/hole/classes/PRESS9', { rows: [{ over_mm: 18, up_to_mm: 30, upper_um: 9, lower_um: 1 }] });
    await daemon.send('PUT', '/v1/gauges-in-use/G-07', { calibration_due: '2099-03-31' });
    await daemon.send('PUT', '/v1/plans/WO-17', { characteristics: [{ name: 'bore-1', designation: '25 H7' }] });
    await daemon.send('POST', '/v1/measurements', Array.from({ length: 30 }, (_, i) => ({
      designation: '25 H7', measured_mm: i === 7 ? '25.03' : `25.00${i % 10}`, part_id: `SN-${i}`, order: 'WO-17', characteristic: 'bore-1', machine: 'M3' })));
  });

  it('are there for every code the service knows, in every language', async () => {
    const errors = codesOf('server/base/error_codes.inc');
    const findings = codesOf('server/nc/klartext/diagnostic_codes.inc');
    assert.ok(errors.length > 100 && findings.length > 30);
    for (const language of ['de', 'nl', 'it']) {
      const texts = { ...await textsOf(`${language}_codes`), ...await textsOf(language) };
      assert.deepEqual([...errors.map((code) => `error.${code}`), ...findings.map((code) => `finding.${code}`)]
        .filter((name) => !texts[name]), [], language);
    }
  });

  /** A page whose German is ⟦marked⟧, so that whatever is not marked did not come from the tables of texts. */
  async function openMarked(fragment) {
    const page = await open(browser, daemon, '', { locale: 'en-GB' });
    for (const file of ['de', 'de_codes', 'plans_de', 'desk_de', 'figures_de']) {
      const marked = Object.fromEntries(Object.entries(await textsOf(file)).map(([name, text]) => [name, `⟦${text}⟧`]));
      await page.route(`**/lang/${file}.js`, (route) => route.fulfill({ contentType: 'text/javascript', body: `export default ${JSON.stringify(marked)}` }));
    }
    await page.selectOption('#language', 'de');
    await page.waitForFunction(() => document.getElementById('views').textContent.includes('⟦'));
    await page.evaluate((address) => { location.hash = address; }, fragment);
    return page;
  }

  /** The words on the screen, and those that are read out or shown on a touch, that no table of texts has. */
  async function unmarked(page) {
    const texts = await page.evaluate(() => {
      const skipped = 'script, style, noscript, .findings code, pre, textarea, #language, [lang]:not(html)';
      const found = [];
      const walker = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
      for (let node = walker.nextNode(); node; node = walker.nextNode()) {
        if (!node.parentElement.closest(skipped)) found.push(node.textContent);
      }
      for (const name of ['aria-label', 'title']) {
        for (const element of document.querySelectorAll(`[${name}]`)) if (!element.closest(skipped)) found.push(element.getAttribute(name));
      }
      return found;
    });
    const without = (text) => (text.includes('⟦') ? without(text.replace(/⟦[^⟦⟧]*⟧/g, ' ')) : text);
    return texts.map((text) => without(text).replace(KNOWN, ' ').trim()).filter((text) => /\p{L}{3}/u.test(text));
  }

  const VISITS = {
    'the gauge': ['#/gauge/25H7?part_id=SN-1&characteristic=bore-1&plan=WO-17', async (page) => {
      await page.waitForFunction(() => document.querySelector('.plan .progress')?.textContent);
      await page.waitForSelector('.echo .figures');
      await known(page);
      await page.focus('#value');
      await page.keyboard.type('25.0131\n');
      await page.waitForSelector('.verdict[data-verdict="good"]:not([data-provisional])');
      await page.keyboard.type('gibberish?\n');
      await page.waitForFunction(() => (document.querySelector('#entry-note')?.textContent ?? '') !== '');
    }],
    'a class that is none': ['#/gauge/25H77', (page) => page.waitForSelector('.echo.wrong')],
    'the fit': ['#/fit/25H7/k6?hole=25.013', (page) => page.waitForSelector('.class-zones :checked')],
    'the trend': ['#/trend', async (page) => {
      await page.waitForSelector('.control-chart');
      await page.focus('.trend figure');
      await page.keyboard.press('ArrowLeft');
    }],
    'the overview': ['#/overview', (page) => page.waitForSelector('.overview [data-settled]')],
    'the map of parts': ['#/overview?look=heat', async (page) => {
      await page.waitForSelector('.heat .picture .cell');
      await page.focus('.heat .picture');
      await page.keyboard.press('ArrowLeft');
      await page.click('.heat summary');
    }],
    'the small charts': ['#/overview?look=wall', (page) => page.waitForSelector('.wall .spark')],
    'the parts': ['#/parts?order=WO-17', (page) => page.waitForSelector('.records tbody tr')],
    'a part': ['#/parts?part_id=SN-7', (page) => page.waitForSelector('.records tbody tr')],
    'the programs': ['#/programs/nc_prog/82.h', async (page) => {
      await page.waitForSelector('.cm-line');
      await page.waitForSelector('.finding');
    }],
    'the connections': ['#/connections', (page) => page.waitForSelector('.schema-fields')],
    'the gauges': ['#/gauges/G-07', (page) => page.waitForSelector('.of-gauge form')],
    'the plans': ['#/plans', (page) => page.waitForSelector('.plans-there tbody tr')],
    'a plan': ['#/plans/WO-17', async (page) => {
      await page.waitForSelector('.editor:not([hidden]) .characteristic');
      await page.click('.characteristics .icon.more');
      await page.click('.characteristics .icon.remove');
    }],
    'a drawing': ['#/plans', async (page) => {
      await page.waitForSelector('.plans-there tbody tr');
      await dropFile(page, 'bore.stp', drawingOf('WO-17', [{ ...housing(1)[0], name: 'bore-1', of: 'H8' }]));
      await page.waitForSelector('.review .read tbody tr');
    }],
    'the examples': ['#/programs', (page) => page.waitForSelector('.empty button')],
    'the numbers of a standard': ['#/tables/din6885-1?find=25', (page) => page.waitForSelector('.standard td')],
    'the tables': ['#/tables/hole?find=25+H+PRESS9', (page) => page.waitForSelector('.grid td')],
  };
  for (const [name, [fragment, ready]] of Object.entries(VISITS)) {
    it(`of ${name} all come from the tables of texts`, async () => {
      const page = await openMarked(fragment);
      await ready(page);
      assert.deepEqual(await unmarked(page), []);
      await close(page);
    });
  }

  it('would be found if one did not: the test bites', async () => {
    const page = await openMarked('#/tables');
    await page.waitForSelector('.grid td');
    await page.evaluate(() => document.querySelector('main').append('Ready or not'));
    assert.deepEqual(await unmarked(page), ['Ready or not']);
    await close(page);
  });
});
