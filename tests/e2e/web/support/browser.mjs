/** A browser, Chromium or that of WEB_TEST_BROWSER, and pages in it. A page that logs an error fails its test. */

import assert from 'node:assert/strict';
import fs from 'node:fs';
import { createRequire } from 'node:module';
import os from 'node:os';
import path from 'node:path';

import { atEnd } from './ending.mjs';

const require = createRequire(path.join(process.env.WEB_TEST_MODULES, 'package.json'));
const playwright = require('playwright-core');
const AXE = fs.readFileSync(require.resolve('axe-core/axe.min.js'), 'utf8');
/** Where service workers are blocked, the driver asks for them in frames too, which a sandbox refuses. */
const OF_THE_DRIVER = /Failed to read the 'serviceWorker' property from 'Navigator'.*sandboxed/;
const SCREENSHOTS = path.resolve('build/screenshots');
/** How long a test waits for what it was promised: a minute, so that a busy machine is no failure. */
export const PATIENCE_MS = 60000;

const BROWSERS = {
  chromium: () => playwright.chromium.launch({
    timeout: PATIENCE_MS,
    executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium-headless-shell',
    args: ['--no-sandbox', '--disable-gpu', '--disable-quic', '--no-first-run', '--disable-background-networking',
      '--disable-component-update', '--disable-sync'],
  }),
  // Debian's own Firefox, by WebDriver BiDi, which tells of no downloads: they go into a folder.
  firefox: () => playwright._bidiFirefox.launch({
    timeout: PATIENCE_MS,
    executablePath: process.env.FIREFOX ?? '/usr/bin/firefox-esr', channel: 'moz-firefox',
    firefoxUserPrefs: { 'browser.download.folderList': 2, 'browser.download.dir': downloads(), 'browser.download.useDownloadDir': true,
      // One process for all pages, none begun before it is asked for.
      'fission.autostart': false, 'dom.ipc.processCount': 1, 'dom.ipc.processPrelaunch.enabled': false },
  }),
};
export const browserName = process.env.WEB_TEST_BROWSER ?? 'chromium';
/** Whether a page can be in another time zone: the driver of Firefox sets none. */
export const hasZones = browserName === 'chromium';

let folder;
/** Where Firefox saves files. */
function downloads() {
  if (!folder) {
    folder = fs.mkdtempSync(path.join(os.tmpdir(), 'fitgauge-saved-'));
    atEnd(() => fs.rmSync(folder, { recursive: true, force: true }));
  }
  return folder;
}

/** What `act` saves as a file: [name, bytes]. */
export async function saved(page, act) {
  if (browserName === 'chromium') {
    const [download] = await Promise.all([page.waitForEvent('download'), act()]);
    return [download.suggestedFilename(), fs.readFileSync(await download.path())];
  }
  await act();
  for (const until = Date.now() + PATIENCE_MS; Date.now() < until; await page.waitForTimeout(50)) {
    const names = fs.readdirSync(downloads());
    const [name] = names;
    // A file that is not whole yet has another beside it, and may be renamed before it is looked at.
    const file = names.length === 1 && !name.endsWith('.part') && fs.statSync(path.join(folder, name), { throwIfNoEntry: false });
    if (file && file.size > 0) {
      const bytes = fs.readFileSync(path.join(folder, name));
      fs.rmSync(path.join(folder, name));
      return [name, bytes];
    }
  }
  throw new Error(`nothing was saved: ${fs.readdirSync(folder)}`);
}

/** What is on the clipboard, as a paste shows it: to read it otherwise would need a permission. */
export async function pasted(page) {
  await page.evaluate(() => {
    const area = document.body.appendChild(document.createElement('textarea'));
    area.id = 'pasted';
    area.focus();
  });
  await page.keyboard.press('ControlOrMeta+v');
  const text = await page.inputValue('#pasted');
  await page.$eval('#pasted', (area) => area.remove());
  return text;
}

/** A browser, which is closed at the end of the file, whatever becomes of its tests. */
export async function launch() {
  const browser = await BROWSERS[browserName]();
  atEnd(() => browser.close());
  return browser;
}

/** The driver of Firefox fills a field with keys that come as fast as those of a scanner, which the page reads as a scan. */
function fillAsChromium(page) {
  page.fill = async (selector, text) => {
    const there = await page.waitForSelector(selector);
    // A date is no text that could be inserted.
    if (await there.evaluate(({ type }) => type === 'date')) return page.locator(selector).fill(text);
    await page.focus(selector);
    return page.$eval(selector, (field, wanted) => {
      field.select();
      document.execCommand(wanted ? 'insertText' : 'delete', false, wanted);
    }, text);
  };
}

/**
 * A page at a state, in a browser context of its own; `errors` holds what it logged.
 * @param at the time at which its clock begins to go; the service tells it no other then
 */
export async function open(browser, daemon, fragment = '', { at, ...options } = {}) {
  const context = await browser.newContext({ viewport: { width: 1280, height: 800 }, locale: 'en-GB', reducedMotion: 'reduce', serviceWorkers: 'block', ...options });
  if (at) {
    await context.clock.install({ time: at });
    await context.route('**/livez', async (route) => {
      const answer = await route.fetch().catch(() => null);
      await (answer ? route.fulfill({ status: answer.status(), body: '{}' }) : route.abort());
    });
  }
  return openIn(context, daemon, fragment);
}

export async function openIn(context, daemon, fragment = '') {
  // Without a window nobody can be asked: a copy needs the permission before.
  if (browserName === 'chromium') await context.grantPermissions(['clipboard-write']);
  const page = await context.newPage();
  page.setDefaultTimeout(PATIENCE_MS);
  if (browserName === 'firefox') fillAsChromium(page);
  page.errors = [];
  page.foreign = [];
  page.on('pageerror', (error) => {
    if (!OF_THE_DRIVER.test(error)) page.errors.push(String(error));
  });
  page.on('console', (message) => {
    // A service that is away or refuses is the test's doing.
    if (message.type() === 'error' && !message.text().startsWith('Failed to load resource')) page.errors.push(message.text());
  });
  page.on('request', (request) => {
    if (!request.url().startsWith(daemon.url) && !request.url().startsWith('about:')) page.foreign.push(request.url());
  });
  await page.goto(`${daemon.url}/${fragment}`);
  await page.waitForSelector('main h1');
  return page;
}

/** Until what changes with the window, the colours or the paper is drawn anew: a frame sees the change, and the next one has drawn it. */
export const drawn = (page) => page.evaluate(() => new Promise((resolve) => { requestAnimationFrame(() => requestAnimationFrame(() => setTimeout(resolve))); }));

/** Until a timer of the page has rung: whatever the page put off for a shorter time has come before. */
export const timer = (page, milliseconds) => page.evaluate((wait) => new Promise((resolve) => { setTimeout(resolve, wait); }), milliseconds);

/** The state that a page's address names. */
export const hashOf = (page) => decodeURIComponent(new URL(page.url()).hash);

/** Closes a context; an answer that a test still holds back is none any more. */
export async function closeContext(context) {
  for (const each of [context, ...context.pages()]) await each.unrouteAll({ behavior: 'ignoreErrors' });
  await context.close();
}

/** Closes a page's context, and checks that it logged no error and asked nobody else. */
export async function close(page) {
  await closeContext(page.context());
  assert.deepEqual(page.errors, []);
  assert.deepEqual(page.foreign, []);
}

/** Writes a picture for people to look at into build/screenshots. */
export async function picture(page, name, options = {}) {
  fs.mkdirSync(SCREENSHOTS, { recursive: true });
  await page.screenshot({ path: path.join(SCREENSHOTS, `${name}.png`), ...options });
}

/** What axe-core finds, as readable lines. */
export async function findings(page) {
  // Evaluated by the debugger, so that the page's own policy need not allow it; half a megabyte, sent once.
  if (!await page.evaluate(() => 'axe' in globalThis)) await page.evaluate(AXE);
  const { violations } = await page.evaluate(() => globalThis.axe.run(document, {
    runOnly: ['wcag2a', 'wcag2aa', 'wcag21a', 'wcag21aa', 'wcag22aa', 'best-practice'],
  }));
  return violations
    .flatMap(({ id, nodes }) => nodes.map((node) => `${id}: ${node.html.slice(0, 160)} ${node.failureSummary}`));
}
