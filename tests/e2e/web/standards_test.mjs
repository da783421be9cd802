/** What is gauged by the designations of other standards than ISO 286: threads and general tolerances. */

import assert from 'node:assert/strict';
import { afterEach, describe, it } from 'node:test';

import { judge, mmText, nmFromMm } from '../../../clients/web/exact.js';
import { close, findings, open, picture } from './support/browser.mjs';
import { untilPoints } from './support/chart.mjs';
import { scan as scanInto, typeSlowly } from './support/scanner.mjs';
import { browser, daemon } from './support/stage.mjs';

let page;

afterEach(() => close(page));

const scan = (text) => scanInto(page, text);
const measure = (text) => typeSlowly(page, text);
const verdict = (word) => page.waitForSelector(`.verdict[data-verdict="${word}"]:not([data-provisional])`);
const echo = (pattern) => page.waitForFunction((source) => new RegExp(source).test(document.querySelector('.echo')?.textContent), pattern);
const stored = async (part) => (await daemon.stored(`part_id=${part}`)).map(({ designation, feature, measured_mm, verdict: word }) => [designation, feature, measured_mm, word]);

describe('other standards at the station', () => {
  it('are scanned like a size and class, and name their edition', async () => {
    page = await open(browser, daemon, '#/gauge/25H7');
    await page.waitForSelector('.echo .figures');
    await scan('P:TH-1');
    await scan('M10-6H');
    // ISO 965-1: D2 of M10 is 9.026, T_D2 of 6H 180 µm.
    await echo('^M10-6Hhole, pitch diameter9\\.026 to 9\\.206 mm.*ISO 965-1:2013$');
    await measure('9.206');
    await verdict('good');
    assert.match(await page.textContent('.verdict .about'), /^TH-1 · M10-6H$/);
    await measure('9.207');
    await verdict('reject');
    await scan('M10×1,25-6g');
    await echo('^M10x1\\.25-6gshaft');
    await measure('9.17');
    await verdict('rework');
    assert.deepEqual(await stored('TH-1'), [['M10-6H', 'hole', 9.206, 'good'], ['M10-6H', 'hole', 9.207, 'reject'], ['M10x1.25-6g', 'shaft', 9.17, 'rework']]);
    await picture(page, 'gauge-thread');
    await scan('M12-3A'); // no class of this standard: the number of a part
    assert.equal(await page.inputValue('[name="part_id"]'), 'M12-3A');
    await typeSlowly(page, 'M10-9H'); // typed, it is nothing
    await page.waitForFunction(() => /Not stored/.test(document.querySelector('#entry-note')?.textContent));
  });

  it('say whether a general tolerance is of an outside or an inside dimension', async () => {
    page = await open(browser, daemon, '#/gauge/25%20ISO%202768-m?part_id=GT-1');
    await echo('^25 ISO 2768-mshaft24\\.800 to 25\\.200 mm');
    await page.focus('#value');
    await measure('25.3');
    await verdict('rework');
    await page.selectOption('[name="feature"]', 'hole');
    await echo('hole');
    assert.match(decodeURIComponent(page.url()), /feature=hole/);
    await page.focus('#value');
    await measure('25.3');
    await verdict('reject');
    assert.deepEqual(await stored('GT-1'), [['25 ISO 2768-m', 'shaft', 25.3, 'rework'], ['25 ISO 2768-m', 'hole', 25.3, 'reject']]);
    assert.deepEqual(await findings(page), []);
    await page.reload();
    await echo('hole');
    await page.fill('#designation', '25H7');
    await echo('^Ø 25 H7');
    assert.ok(await page.isHidden('[name="feature"]'));
  });

  it('are judged by the limits held while the service is away, as the service judges', async () => {
    for (const [designation, side] of [['M10-6H'], ['M10x1.25-6g'], ['25 ISO 2768-m', 'hole'], ['25 ISO 2768-m', 'shaft'], ['R5 ISO 2768-f'], ['C5 ISO 2768-m']]) {
      const given = await daemon.json(`/v1/limits/${encodeURIComponent(designation)}`);
      const limits = { ...given, feature: side ?? given.feature };
      for (const limit of [limits.lower_limit_mm, limits.upper_limit_mm].map((mm) => nmFromMm(String(mm)))) {
        for (const nm of [limit - 1, limit, limit + 1]) {
          const answer = await daemon.json(`/v1/verdicts/${encodeURIComponent(designation)}?measured_mm=${mmText(nm)}${side ? `&feature=${side}` : ''}`);
          assert.equal(judge(nm, limits), answer.verdict, `${designation} ${mmText(nm)}`);
        }
      }
    }
    page = await open(browser, daemon, '#/gauge/M10-6H?part_id=AWAY');
    await echo('^M10-6H');
    await page.focus('#value');
    await daemon.kill();
    await measure('9.2061');
    await page.waitForSelector('.verdict[data-verdict="reject"][data-provisional="away"]');
    await daemon.start();
    await page.waitForSelector('.arrived li');
    assert.deepEqual(await stored('AWAY'), [['M10-6H', 'hole', 9.2061, 'reject']]);
  });

  it('stand in plans, in lists, in a certificate and in every language as they are written', async () => {
    await daemon.send('PUT', '/v1/plans/STUD', { characteristics: [{ name: 'thread', designation: 'M10x1.25-6g' }, { name: 'slot', designation: '12 ISO 2768-f', feature: 'hole' }] });
    page = await open(browser, daemon, '#/gauge', { locale: 'de-DE' });
    await page.waitForSelector('.plan option[value="STUD"]', { state: 'attached' });
    await scan('STUD');
    await scan('P:ST-1');
    await echo('^M10x1,25-6g');
    assert.match(await page.textContent('.tiles-of-plan'), /threadM10x1,25-6gslot12 ISO 2768-f/);
    await measure('9,1');
    await echo('^12 ISO 2768-f');
    await measure('12,11');
    await verdict('reject');
    assert.deepEqual(await stored('ST-1'), [['M10x1.25-6g', 'shaft', 9.1, 'good'], ['12 ISO 2768-f', 'hole', 12.11, 'reject']]);
    await page.evaluate(() => { location.hash = '#/parts?part_id=ST-1'; });
    await page.waitForSelector('.records tbody tr');
    assert.match(await page.textContent('.records tbody'), /slot12 ISO 2768-f.*threadM10x1,25-6g/);
    const sheet = await (await fetch(`${daemon.url}/v1/certificates?part_id=ST-1`, { headers: { Accept: 'application/json' } })).text();
    for (const text of ['M10x1.25-6g', '12 ISO 2768-f', 'ISO 965-1:2013']) assert.ok(sheet.includes(text), text);
  });

  it('are charted by their designation', async () => {
    await daemon.send('POST', '/v1/measurements', Array.from({ length: 30 }, (_, i) => ({ designation: 'M10-6H', measured_mm: `9.1${10 + (i * 7) % 20}`, characteristic: 'pitch' })));
    page = await open(browser, daemon, '#/trend?characteristic=pitch');
    await untilPoints(page, 30);
    assert.equal(await page.textContent('#trend-designation option:checked'), 'M10-6H');
  });
});

describe('the numbers of other standards', () => {
  const texts = (table, row = 'tbody tr') => page.$$eval(`.standard [aria-label="${table}"] ${row} > *`, (all) => all.map((cell) => cell.textContent));

  it('stand among the tables: keyways and bearings by size', async () => {
    page = await open(browser, daemon, '#/tables/hole?find=25+H7');
    await page.waitForSelector('.grid');
    await page.selectOption('#standard', 'din6885-1');
    await page.waitForSelector('.standard tbody tr');
    assert.ok((await page.$$('.standard tbody tr')).length > 10, 'the whole table');
    await page.fill('#find', '25');
    await page.waitForFunction(() => document.querySelectorAll('.standard tbody tr').length === 1);
    // DIN 6885-1: a shaft over 22 to 30 mm has a key of 8 x 7; 8 P9 is -15/-51 by ISO 286-2.
    const keyways = 'Keyways by the diameter of the shaft';
    assert.deepEqual((await texts(keyways, 'thead tr')).slice(0, 7), ['Over', 'Up to', 'Width', 'Height of the key', 'Depth in the shaft', 'Depth in the hub', 'Width P9']);
    assert.deepEqual((await texts(keyways)).slice(0, 7), ['22', '30', '8', '7', '4+2000', '3.3+2000', '−15−51']);
    assert.match(decodeURIComponent(page.url()), /#\/tables\/din6885-1\?find=25$/);
    assert.deepEqual(await findings(page), []);
    await picture(page, 'tables-keyways', { fullPage: true });
    await page.selectOption('#standard', 'iso492');
    await page.waitForSelector('.standard [aria-label^="Bores"]');
    await page.fill('#find', '25');
    await page.waitForFunction(() => document.querySelectorAll('.standard tbody tr').length === 2);
    assert.deepEqual(await texts('Bores, mean diameter'), ['18', '30', '0−10', '0−8', '0−6', '0−5']);
    assert.deepEqual(await texts('Outer rings, mean diameter'), ['18', '30', '0−9', '0−8', '0−6', '0−5']);
    await page.fill('#find', '700');
    await page.waitForFunction(() => (document.querySelector('.note')?.textContent ?? '') !== '');
    await page.selectOption('#standard', 'hole');
    await page.waitForSelector('.grid td');
  });

  it('have names in every language, and fit a phone', async () => {
    for (const [locale, title] of [['en-GB', 'Width'], ['de-DE', 'Breite'], ['nl-NL', 'Breedte'], ['it-IT', 'Larghezza']]) {
      page = await open(browser, daemon, '#/tables/din6885-1?find=25', { locale, viewport: { width: 390, height: 844 } });
      for (const name of ['iso492', 'iso2768-1', 'iso965-1', 'din6885-1']) {
        await page.$eval('.desk', (before) => before.setAttribute('data-before', ''));
        await page.selectOption('#standard', name);
        await page.waitForSelector('.desk:not([data-before]) .standard tbody tr');
        assert.equal(await page.evaluate(() => document.documentElement.scrollWidth), 390, `${locale} ${name}`);
        assert.doesNotMatch(await page.textContent('main'), /tables\.|undefined|NaN|\b[a-z]+_[a-z]+/, `${locale} ${name}`);
      }
      assert.ok((await page.textContent('.standard thead')).includes(title), locale);
      await close(page);
    }
    page = await open(browser, daemon, '#/tables');
  });

  it('of an inside corner stand in the form of a plan and in its table, where another word is refused', async () => {
    await daemon.send('PUT', '/v1/plans/R-9', { characteristics: [{ name: 'groove', designation: 'R5 ISO 2768-m', inside_corner: true }] });
    page = await open(browser, daemon, '#/plans/R-9');
    await page.click('.characteristic .icon.more');
    const corner = page.locator('.of-inside_corner select');
    assert.equal(await corner.inputValue(), 'true');
    await corner.selectOption('');
    await page.click('.editor button[type="submit"]');
    await page.waitForFunction(() => document.querySelector('.done')?.textContent.includes('Plan R-9 is stored'));
    assert.deepEqual((await daemon.json('/v1/plans/R-9')).characteristics, [{ name: 'groove', designation: 'R5 ISO 2768-m' }]);
    await page.setInputFiles('#plan-file', { name: 'more.csv', mimeType: '', buffer: Buffer.from('name;designation;inside_corner\nedge;R2 ISO 2768-m;true\nother;R3 ISO 2768-m;ja\n') });
    await page.waitForFunction(() => document.querySelectorAll('.characteristics > li').length === 3);
    await page.click('.editor button[type="submit"]');
    await page.waitForFunction(() => document.querySelector('.characteristics > li:nth-child(3) .of-inside_corner .note')?.textContent.trim());
  });
});
