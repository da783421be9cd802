/**
 * What holds for the whole page: its size, its policy, languages, keys, and that everybody can use it.
 *
 * Tried, and held here:
 * - Load at 100 ms a round trip: two round trips; unchanged files are not asked for again
 */

import assert from 'node:assert/strict';
import fs from 'node:fs';
import http from 'node:http';
import path from 'node:path';
import { before, describe, it } from 'node:test';

import { browserName, close, findings, launch, open, picture, timer } from './support/browser.mjs';
import { untilPoints } from './support/chart.mjs';
import { Daemon } from './support/daemon.mjs';

const FOLDER = 'clients/web';
/** Asked of the station; and of it with the two views that are opened from it most. */
const LARGEST_BYTES = 60000;
const LARGEST_OF_THREE = 100000;
const SMALLEST_TARGET = 44;
const WIDTHS = [390, 1024, 1366, 3840];
const VIEWS = {
  gauge: '#/gauge/25H7', fit: '#/fit/25H7/k6?hole=25.013', trend: '#/trend', overview: '#/overview', parts: '#/parts', programs: '#/programs/nc_prog/8255.h?setup=bore',
  tables: '#/tables/hole?find=25+H', connections: '#/connections', plans: '#/plans/WO-17',
};

/** How the page is seen; the driver of Firefox knows no forced colours. */
const MODES = { dark: { colorScheme: 'dark' }, ...(browserName === 'chromium' && { forced: { colorScheme: 'light', forcedColors: 'active' } }),
  light: { colorScheme: 'light', ...(browserName === 'chromium' && { forcedColors: 'none' }) } };

/** Whether people get a picture of it: of each view one in each mode. All views together show every width in every mode. */
const isPictured = (view, width, mode) =>
  (Object.keys(VIEWS).indexOf(view) + Object.keys(MODES).indexOf(mode)) % WIDTHS.length === WIDTHS.indexOf(width);

/** What axe-core looks at: what is pictured, with TESTS_DEEP each view in every width too: a mode changes colours alone. Scrolling is looked at everywhere. */
const looksAt = (view, width, mode) => isPictured(view, width, mode) || Boolean(process.env.TESTS_DEEP && mode === 'light');

/** What comes when somebody wants it, with a name of each library in it. */
const LATER = { 'views/fit.js': null, 'views/parts.js': null, 'views/plans.js': null, 'views/programs.js': /cm-editor/, 'views/trend.js': /uPlot/i, 'figures/path_scene.js': /WebGLRenderer/ };
/** The connections that a browser opens: no more files are asked for before the page can be used, so they come in one round trip. */
const AT_ONCE = 6;
const SCRIPTS = ['app.js', 'service_worker.js', 'stream_worker.js'];
const files = fs.readdirSync(FOLDER, { recursive: true, withFileTypes: true })
  .filter((entry) => entry.isFile())
  .map((entry) => path.relative(FOLDER, path.join(entry.parentPath ?? entry.path, entry.name)))
  .filter((name) => name.endsWith('.js') && !name.startsWith('bundled/'));
const languages = files.filter((name) => name.startsWith('lang/') && name !== 'lang/en.js');

/** An answer as it is sent, not unpacked. */
const rawGet = (daemon, target, headers = {}) => new Promise((resolve, reject) => {
  http.get(daemon.url + target, { headers }, (response) => {
    const pieces = [];
    response.on('data', (piece) => pieces.push(piece));
    response.on('end', () => resolve({ status: response.statusCode, headers: response.headers, body: Buffer.concat(pieces) }));
  }).on('error', reject);
});

describe('the page', () => {
  let browser;
  let daemon;

  before(async () => {
    browser = await launch();
    daemon = await new Daemon().start();
    for (const name of ['8255.h', '82551.h', '82552.a']) {
      await daemon.send('PUT', `/v1/files/nc_prog/${name}`, fs.readFileSync(`clients/nc/8255/${name}`, 'utf8'), 'text/plain');
    }
    await daemon.send('PUT', '/v1/plans/WO-17', { name: 'Flange', characteristics: [{ name: 'bore-A', designation: '25 H7', gauge: 'G-07' }, { name: 'slot', nominal_mm: 8, feature: 'hole', upper_um: 36, lower_um: -4, frequency: 'each hour' }] });
    await daemon.send('PUT', '/v1/setups/bore', fs.readFileSync('clients/nc/8255/setups/hole-good.json', 'utf8'));
    await daemon.send('POST', '/v1/measurements', ['24.999', '25.0131', '25.02', '25.0215'].map((text) => ({ designation: '25 H7', measured_mm: text, characteristic: 'bore-A' })));
  });

  /** A view with something in it. */
  async function openView(view, options) {
    const page = await open(browser, daemon, VIEWS[view], options);
    if (view === 'gauge') {
      await page.waitForSelector('.echo .figures');
      await page.keyboard.type('25.0131\n');
      await page.waitForSelector('.verdict[data-verdict="good"]:not([data-provisional])');
      await page.waitForSelector('.recent .mark-of');
    }
    if (view === 'fit') await page.waitForSelector('.class-zones :checked');
    if (view === 'trend') await page.waitForSelector('.control-chart');
    if (view === 'overview') await page.waitForSelector('.overview [data-settled]');
    if (view === 'parts') await page.waitForSelector('.records tbody tr');
    if (view === 'tables') await page.waitForSelector('.grid');
    if (view === 'plans') {
      await page.waitForSelector('.editor:not([hidden]) .characteristic');
      await page.click('.characteristics li:last-child .icon.more');
    }
    if (view === 'connections') await page.waitForSelector('.schema-fields');
    if (view === 'programs') {
      await page.waitForFunction(() => document.querySelector('.run select')?.value === 'bore');
      await page.click('.run button[type="submit"]');
      await page.waitForSelector('.path');
    }
    return page;
  }

  /** The files that the entry names, without the name of the build. */
  const named = async () => [...String((await rawGet(daemon, '/')).body).matchAll(/(?:href|src)="\/web\/[0-9a-f]{12}\/([^"]+)"/g)].map(([, name]) => name);

  /** The bytes, gzipped, of all that a browser is sent for the views at these fragments, one after the other; and that they are named at once. */
  async function sentFor(locale, views) {
    const page = await open(browser, daemon, '#/gauge/25H7', { locale });
    await page.waitForSelector('.echo .figures');
    for (const [fragment, ready] of views) {
      await page.evaluate((address) => { location.hash = address; }, fragment);
      await page.waitForSelector(ready);
    }
    const asked = await page.evaluate(() => performance.getEntriesByType('resource').map(({ name }) => /\/web\/[^/]+\/(.+)$/.exec(name)?.[1]));
    await close(page);
    // Workers are asked for in every browser, and listed in some.
    const all = new Set([...asked.filter(Boolean), ...await named(), 'index.html', 'stream_worker.js', 'service_worker.js']);
    let bytes = 0;
    for (const name of all) {
      const answer = await rawGet(daemon, `/web/${name}`, { 'Accept-Encoding': 'gzip' });
      assert.ok(answer.headers['content-encoding'] === 'gzip' || answer.body.length <= 1024, name);
      bytes += answer.body.length;
    }
    return { bytes, all: [...all] };
  }

  it('is at most 60 kB, gzipped, for the station in each language, and 100 kB with fit and parts', async (test) => {
    for (const [locale, code] of [['en-GB', 'en'], ['de-DE', 'de'], ['nl-NL', 'nl'], ['it-IT', 'it']]) {
      const { bytes, all } = await sentFor(locale, []);
      test.diagnostic(`${locale}: ${all.length} files, ${bytes} bytes gzipped`);
      assert.ok(bytes <= LARGEST_BYTES, `${locale}: ${bytes} bytes`);
      const texts = code === 'en' ? [] : [`lang/${code}.js`, `lang/${code}_codes.js`];
      assert.deepEqual(all.filter((name) => /^(lang|views|style)\//.test(name)).sort(), [...texts, 'style/page.css'].sort());
    }
    const { bytes } = await sentFor('de-DE', [['#/fit/25H7/g6', '.class-zones :checked'], ['#/parts', '.records tbody tr']]);
    test.diagnostic(`with fit and parts: ${bytes} bytes gzipped`);
    assert.ok(bytes <= LARGEST_OF_THREE, `${bytes} bytes`);
  });

  it('shows the station as before once the style of the other views is there', async () => {
    const later = String((await rawGet(daemon, '/web/style/later.css')).body);
    assert.ok(later.length > 10000);
    for (const isOfPlan of [false, true]) {
      const page = isOfPlan ? await open(browser, daemon, '#/gauge/25H7?plan=WO-17') : await openView('gauge');
      if (isOfPlan) await page.waitForSelector('.tiles-of-plan li');
      await page.click('.more > summary');
      for (const width of WIDTHS) {
        await page.setViewportSize({ width, height: 800 });
        const changed = await page.evaluate((text) => {
          const all = [...document.querySelectorAll('main *')];
          const looks = () => all.map((element) => { const style = getComputedStyle(element); return [...style].map((name) => `${name}: ${style[name]}`); });
          const before = looks();
          const sheet = new CSSStyleSheet();
          sheet.replaceSync(text);
          document.adoptedStyleSheets = [sheet];
          const after = looks();
          document.adoptedStyleSheets = [];
          return after.flatMap((own, i) => own.filter((one, k) => one !== before[i][k]).map((one) => `${all[i].tagName} ${all[i].className}: ${one}`));
        }, later);
        assert.deepEqual(changed, [], String(width));
      }
      await close(page);
    }
  });

  it('is served with its policy and its tag', async () => {
    for (const name of [...await named(), ...SCRIPTS, ...Object.keys(LATER), ...languages]) {
      const plain = await rawGet(daemon, `/web/${name}`);
      assert.equal(plain.status, 200, name);
      assert.match(plain.headers['content-security-policy'], /^default-src 'self'/);
      assert.equal(plain.headers['x-content-type-options'], 'nosniff');
      const again = await rawGet(daemon, `/web/${name}`, { 'If-None-Match': plain.headers.etag });
      assert.equal(again.status, 304);
    }
    assert.equal((await rawGet(daemon, '/web/none.js')).status, 404);
    assert.equal((await rawGet(daemon, '/', { 'Accept-Encoding': 'gzip;q=0' })).headers['content-encoding'], undefined);
  });

  it('brings its libraries only to what wants them, each with its licence', async (test) => {
    for (const [name, library] of Object.entries(LATER)) {
      const bundle = await rawGet(daemon, `/web/${name}`, { 'Accept-Encoding': 'gzip' });
      test.diagnostic(`${name}: ${bundle.body.length} bytes gzipped`);
      assert.doesNotMatch(String((await rawGet(daemon, `/web/${name}`)).body), /\bfrom ?"[@a-z]/, name);
      if (!library) continue;
      const served = async (each) => String((await rawGet(daemon, `/web/${each}`)).body);
      assert.match(await served(name), library);
      for (const first of (await named()).filter((each) => each.endsWith('.js'))) assert.doesNotMatch(await served(first), library, first);
    }
    const { body, headers } = await rawGet(daemon, '/web/licences.txt');
    assert.match(headers['content-type'], /^text\/plain/);
    const licences = String(body);
    for (const name of Object.keys(JSON.parse(fs.readFileSync(path.join(FOLDER, 'package.json'), 'utf8')).dependencies)) {
      assert.match(licences, new RegExp(`^${name} \\d+\\.\\d+\\.\\d+ \\(MIT\\)$`, 'm'));
    }
    assert.equal(licences.match(/Permission is hereby granted/g).length, licences.match(/^\S+ \d+\.\d+\.\d+ \(MIT\)$/gm).length);
  });

  it('names its files below the name of the build, where they may be kept for ever', async () => {
    const page = String((await rawGet(daemon, '/')).body);
    const targets = [...page.matchAll(/(?:href|src)="(\/web\/[^"]+)"/g)].map((match) => match[1]);
    const build = /^\/web\/([0-9a-f]{12})\//.exec(targets[0])[1];
    for (const target of targets) {
      assert.ok(target.startsWith(`/web/${build}/`), target);
      const kept = await rawGet(daemon, target);
      assert.equal(kept.headers['cache-control'], 'public, max-age=31536000, immutable', target);
      assert.deepEqual(kept.body, (await rawGet(daemon, target.replace(`/web/${build}/`, '/web/'))).body, target);
    }
    assert.equal((await rawGet(daemon, '/')).headers['cache-control'], 'no-cache');
    assert.equal((await rawGet(daemon, '/web/app.js')).headers['cache-control'], 'no-cache');
    assert.equal((await rawGet(daemon, '/web/000000000000/app.js')).status, 404);
  });

  it('asks for all it begins with at once, in one round trip', async () => {
    const needed = new Set();
    const follow = async (name) => {
      if (needed.has(name)) return;
      needed.add(name);
      const text = String((await rawGet(daemon, `/web/${name}`)).body);
      for (const [, other] of text.matchAll(/\b(?:from|import) ?"(\.[^"]+)"/g)) await follow(path.join(path.dirname(name), other));
    };
    for (const name of ['first_keys.js', 'app.js']) await follow(name);
    assert.ok(needed.size > 2);
    const first = await named();
    assert.deepEqual(first.filter((name) => name.endsWith('.js')).sort(), [...needed].sort());
    assert.ok(first.length <= AT_ONCE, first.join());
  });

  it('has every text in every language, with the same places', async () => {
    const texts = {};
    for (const code of ['en', 'de', 'nl', 'it']) {
      const own = await Promise.all([code, `plans_${code}`, `desk_${code}`, `figures_${code}`].map((name) => import(path.resolve(FOLDER, `lang/${name}.js`))));
      texts[code] = Object.assign({}, ...own.map((each) => each.default));
    }
    const places = (text) => (text.match(/\{\w+\}/g) ?? []).sort();
    for (const [code, own] of Object.entries(texts)) {
      assert.deepEqual(Object.keys(own), Object.keys(texts.en), code);
      for (const name of Object.keys(own)) assert.deepEqual(places(own[name]), places(texts.en[name]), `${code} ${name}`);
    }
    const used = files.flatMap((name) =>
      [...fs.readFileSync(path.join(FOLDER, name), 'utf8').matchAll(/\bt\('([^']+)'/g)].map((match) => match[1]));
    assert.ok(used.length > 100);
    assert.deepEqual(used.filter((name) => !(name in texts.en)), []);
  });

  for (const view of Object.keys(VIEWS)) {
    it(`${view}: axe-core finds nothing, fingers and the tabulator reach everything`, async () => {
      const page = await openView(view);
      for (const width of WIDTHS) {
        await page.setViewportSize({ width, height: 800 });
        for (const [mode, media] of Object.entries(MODES)) {
          if (mode !== 'light' && !looksAt(view, width, mode)) continue;
          await page.emulateMedia(media);
          await page.waitForFunction((wanted) => document.documentElement.scrollWidth === wanted, width)
            .catch(async () => assert.equal(await page.evaluate(() => document.documentElement.scrollWidth), width, mode));
          if (!looksAt(view, width, mode)) continue;
          assert.deepEqual(await findings(page), [], `${width} ${mode}`);
          if (isPictured(view, width, mode)) await picture(page, `${view}-${width}-${mode}`, { fullPage: true });
        }
      }
      assert.deepEqual(await smallTargets(page), []);
      assert.deepEqual(await unreached(page), []);
      await page.emulateMedia({ media: 'print', ...MODES.light });
      assert.equal(await page.isVisible('#views'), false);
      await picture(page, `${view}-print`, { fullPage: true });
      await close(page);
    });
  }

  /** What can be used but is smaller than a finger. */
  const smallTargets = (page) => page.evaluate((smallest) => [...document.querySelectorAll('a, button, input, select, summary, textarea')]
    .map((element) => element.closest('label:has([type="radio"], [type="checkbox"])') ?? element)
    .filter((element) => !element.matches('.unseen, .skip') && element.checkVisibility())
    .map((element) => ({ element, box: element.getBoundingClientRect() }))
    .filter(({ box }) => box.height < smallest || box.width < smallest)
    .map(({ element, box }) => `${element.outerHTML.slice(0, 90)} ${box.width} x ${box.height}`), SMALLEST_TARGET);

  /** What the tabulator key does not reach. */
  async function unreached(page) {
    await page.evaluate(() => {
      document.activeElement.blur();
      globalThis.reached = new Set();
      document.addEventListener('focusin', ({ target }) => globalThis.reached.add(target));
    });
    const count = await page.$$eval('a, button, input, select, summary, textarea', (elements) => elements.length);
    for (let i = 0; i < count + 10; ++i) await page.keyboard.press('Tab');
    return page.evaluate(() => [...document.querySelectorAll('a, button, input, select, summary, textarea')]
      .filter((element) => element.checkVisibility() && !element.disabled && element.tabIndex >= 0)
      // Of a group of choices the chosen one is a stop; the arrows reach the others.
      .filter((element) => element.type !== 'radio' || element.checked)
      .filter((element) => !globalThis.reached.has(element)).map((element) => element.outerHTML.slice(0, 90)));
  }

  it('speaks the language of the browser, and another by the switch', async () => {
    for (const [locale, word] of [['de-DE', 'Gut'], ['nl-NL', 'Goed'], ['it-IT', 'Buono'], ['fr-FR', 'Good']]) {
      const page = await openView('gauge', { locale });
      assert.equal(await page.textContent('.verdict .word'), word);
      assert.equal(await page.getAttribute('html', 'lang'), locale === 'fr-FR' ? 'en' : locale.slice(0, 2));
      if (locale === 'de-DE') {
        assert.equal(await page.textContent('.verdict .measured'), '25,0131 mm');
        // The language that the page names is never that of a view still to come.
        await page.evaluate(() => {
          const before = document.getElementById('main').firstElementChild;
          new MutationObserver(() => { globalThis.named = before.isConnected ? 'too early' : document.documentElement.lang; }).observe(document.documentElement, { attributeFilter: ['lang'] });
        });
        await page.selectOption('#language', 'it');
        assert.equal(await (await page.waitForFunction(() => globalThis.named)).jsonValue(), 'it');
        await page.reload();
        await page.waitForFunction(() => document.querySelector('#views [aria-current]')?.textContent === 'Misura');
        assert.equal(await page.inputValue('#designation'), '25H7');
      }
      await close(page);
    }
  });

  it('tells verdicts and the state of the service to those who listen', async () => {
    const page = await openView('gauge');
    assert.equal(await page.getAttribute('.verdict', 'role'), 'status');
    assert.equal(await page.getAttribute('#link', 'role'), 'status');
    assert.equal(await page.getAttribute('#entry-note', 'role'), 'alert');
    await close(page);
  });

  it('asks for a key where the service wants one, and uses it for events too', async () => {
    const locked = await new Daemon('--auth', 'read-open').start();
    const key = await locked.key('station', 'operator');
    const page = await open(browser, locked, '#/gauge/25H7');
    await page.waitForSelector('.echo .figures');
    await page.keyboard.type('25.0131\n');
    await page.waitForSelector('dialog');
    const asked = [];
    page.on('request', (request) => { if (request.method() === 'POST') asked.push(request.url()); });
    await page.keyboard.press('Escape');
    await timer(page, 1000); // who wants no key is not asked again and again, but with the next value
    assert.equal(await page.$('dialog'), null);
    assert.deepEqual(asked, []);
    await page.focus('#value');
    await page.keyboard.type('25.0132\n');
    await page.fill('dialog input', 'fg_wrong');
    await page.click('dialog .primary');
    await page.waitForFunction(() => document.querySelector('dialog input')?.value === '');
    await picture(page, 'key');
    await page.fill('dialog input', key);
    await page.press('dialog input', 'Enter');
    await page.waitForSelector('.verdict[data-verdict="good"]:not([data-provisional])');
    await page.click('#views a[href^="#/trend"]');
    await untilPoints(page, 2);
    const stored = await page.evaluate(() => [Object.values(localStorage), Object.values(sessionStorage)].map((values) => values.join()));
    assert.ok(!stored[0].includes(key) && stored[1].includes(key));
    const answer = await fetch(`${locked.url}/v1/measurements`, {
      method: 'POST', body: '{"designation":"25 H7","measured_mm":25.02}',
      headers: { 'Content-Type': 'application/json', Authorization: `Bearer ${key}` },
    });
    assert.equal(answer.status, 201);
    await untilPoints(page, 3);
    await close(page);
  });
});
