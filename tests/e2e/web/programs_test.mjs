/** NC programs: stored, checked, run. */

import assert from 'node:assert/strict';
import fs from 'node:fs';
import { after, afterEach, before, describe, it } from 'node:test';

import { close, launch, open, openIn, picture } from './support/browser.mjs';
import { Daemon } from './support/daemon.mjs';

const EXAMPLE = 'clients/nc/8255';
const PROGRAM = 'nc_prog/8255/8255.h';
const LOGGING = `BEGIN PGM LOG MM
TOOL CALL 30 Z
TCH PROBE 444 PROBING IN 3-D ~
    Q263=+50 ~
    Q264=+40 ~
    Q294=+0 ~
    Q581=+0 ~
    Q582=+0 ~
    Q583=+1 ~
    Q320=+0 ~
    Q260=+50 ~
    QS400="0.1-0.1" ~
    Q309=+0
END PGM LOG MM
`;
const PLATE = { workpiece: { features: [{ type: 'block', min_mm: [0, 0, -40], max_mm: [100, 80, 0.02] }] } };

let browser;
let daemon;
let page;

before(async () => {
  browser = await launch();
  daemon = await new Daemon().start();
});
after(async () => {
  await browser.close();
  await daemon.cleanup();
});
afterEach(() => close(page));

const hash = () => decodeURIComponent(new URL(page.url()).hash);

describe('the programs', () => {
  before(() => daemon.send('PUT', '/v1/setups/hole-good', fs.readFileSync(`${EXAMPLE}/setups/hole-good.json`, 'utf8')));

  it('are uploaded, checked and run, and show what they did', async () => {
    page = await open(browser, daemon, '#/programs');
    await page.waitForSelector('.files .aside');
    await page.fill('.upload input[type="text"]', 'nc_prog/8255');
    await page.setInputFiles('.upload input[type="file"]', ['8255.h', '82551.h', '82552.a'].map((name) => `${EXAMPLE}/${name}`));
    await page.waitForFunction(() => document.querySelectorAll('.source li').length > 10);
    const stored = await (await fetch(`${daemon.url}/v1/files/${PROGRAM}`)).text();
    assert.equal(stored, fs.readFileSync(`${EXAMPLE}/8255.h`, 'utf8'));
    await page.click('.program .actions button');
    await page.waitForFunction(() => document.querySelector('.program .note').textContent !== '');
    assert.equal((await page.$$('.finding')).length, 0);
    await page.selectOption('.run select', 'hole-good');
    await page.fill('.run .pair textarea', 'Q1 = 25\nQS1 = H7');
    await page.click('.run button[type="submit"]');
    await page.waitForSelector('.path-view .contact');
    assert.match(await page.textContent('.screen'), /STATUS OF THE FIT: GOOD/);
    assert.equal(await page.textContent('.report .mark-of'), 'Good');
    assert.equal((await page.$$('.path-view:first-of-type .contact')).length, 8); // four touches, in two views
    assert.match(hash(), /run=r\d+/);
    // The slider goes through the moves, a line of the program goes to its move, and an earlier run comes back.
    const { moves } = await daemon.json(`/v1/runs/${/run=([^&]+)/.exec(hash())[1]}/trace`);
    const first = moves.findIndex((move) => move.contact_mm);
    await page.$eval('.moves input', (slider, at) => { slider.value = at; slider.dispatchEvent(new Event('input')); }, first);
    const said = () => page.textContent('.moves output');
    assert.match(await said(), new RegExp(`^${first + 1} of ${moves.length} · .*line ${moves[first].line} · Probing · X .*F .*Contact X`));
    assert.equal((await page.$$('.path-view .here circle')).length, 2);
    const own = moves.findIndex((move) => /8255\.h$/i.test(move.program));
    if (own >= 0) {
      await page.click(`.source li:nth-child(${moves[own].line})`);
      assert.match(await said(), new RegExp(`8255\\.h line ${moves[own].line} `, 'i'));
      assert.equal(await page.$eval('.source .here', (row) => [...row.parentNode.children].indexOf(row) + 1), moves[own].line);
    }
    const ran = hash();
    await page.click('.run button[type="submit"]');
    await page.waitForFunction(() => document.querySelectorAll('.earlier button').length === 2);
    assert.notEqual(hash(), ran);
    await page.click('.earlier li:last-child button');
    await page.waitForSelector('.earlier li:last-child [aria-current]');
    assert.equal(hash(), ran);
    await page.waitForSelector('.path-view .contact');
    const again = await openIn(page.context(), daemon, new URL(page.url()).hash);
    await again.waitForSelector('.path-view .contact');
    await picture(again, 'programs', { fullPage: true });
    await again.close();
  });

  it('are not deleted or replaced without a question, and say why an upload is refused', async () => {
    const text = 'BEGIN PGM KEEP MM\nEND PGM KEEP MM\n';
    await daemon.send('PUT', '/v1/files/nc_prog/keep.h', text, 'text/plain');
    page = await open(browser, daemon, '#/programs/nc_prog/keep.h');
    await page.waitForFunction(() => document.querySelectorAll('.source li').length === 2);
    const there = async () => (await fetch(`${daemon.url}/v1/files/nc_prog/keep.h`)).text();
    await page.click('button:has-text("Delete")');
    await page.click('dialog button:has-text("Cancel")');
    assert.equal(await there(), text);
    await page.setInputFiles('.upload input[type="file"]', { name: 'KEEP.H', mimeType: 'text/plain', buffer: Buffer.from('new') });
    await page.click('dialog button:has-text("Cancel")');
    assert.equal(await there(), text);
    await page.click('button:has-text("Delete")');
    await page.click('dialog button:has-text("Delete")');
    await page.waitForSelector('.empty:not([hidden])');
    await page.setInputFiles('.upload input[type="file"]', { name: 'big.h', mimeType: 'text/plain', buffer: Buffer.alloc(8 * 1024 * 1024 + 1, 32) });
    await page.waitForFunction(() => document.querySelector('.program .note').textContent !== '');
    assert.ok(await page.isVisible('.program .note'));
  });

  it('carry what a check finds in their text', async () => {
    await daemon.send('PUT', '/v1/files/nc_prog/bad.h', 'BEGIN PGM BAD MM\n1 CALL LBL 7\n2 FOO\nEND PGM BAD MM\n', 'text/plain');
    page = await open(browser, daemon, '#/programs/nc_prog/bad.h');
    await page.waitForFunction(() => document.querySelectorAll('.source li').length === 4);
    await page.click('.run button[type="submit"]'); // a run is refused for the same reasons
    await page.waitForSelector('.finding');
    const found = () => page.$$eval('.source li.error', (lines) => lines.map((line) => line.querySelector('code').textContent));
    assert.deepEqual(await found(), ['1 CALL LBL 7', '2 FOO']);
    await page.click('.program .actions button');
    await page.waitForFunction(() => /2/.test(document.querySelector('.program .note').textContent));
    assert.deepEqual(await found(), ['1 CALL LBL 7', '2 FOO']);
    assert.equal((await page.textContent('.source li:nth-child(3) .caret')).indexOf('^'), 2);
  });

  it('show the log of cycle 444 in a frame that may do nothing', async () => {
    await daemon.send('PUT', '/v1/files/nc_prog/log.h', LOGGING, 'text/plain');
    await daemon.send('PUT', '/v1/setups/plate', PLATE);
    page = await open(browser, daemon, '#/programs/nc_prog/log.h?setup=plate');
    await page.waitForFunction(() => document.querySelector('.run select')?.value === 'plate');
    await page.click('.run button[type="submit"]');
    await page.click('.report .actions button');
    const frame = await (await page.waitForSelector('.report iframe')).contentFrame();
    await frame.waitForSelector('table');
    assert.equal(await page.getAttribute('.report iframe', 'sandbox'), '');
    assert.match(await page.getAttribute('.report iframe', 'src'), /^\/v1\/runs\/r\d+-[0-9a-f]{16}\/files\/TCHPR444/i);
    await picture(page, 'programs-444', { fullPage: true });
  });
});
