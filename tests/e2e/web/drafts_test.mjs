/**
 * Programs and plans that are not stored, while the stored ones change elsewhere.
 *
 * Tried, and held here:
 * - A program is deleted elsewhere while its text is changed here: the text is there, and can be stored
 * - Begin a program, open another before it is stored: both are in the list
 * - Go on typing where a file is stored that the view before had sent: nothing of it is lost, and it can be stored again
 * - A program that cannot be opened: nothing of the one before stands, or runs, under its name
 * A plan is deleted elsewhere and the changes to it are discarded here: the list, and why
 */

import assert from 'node:assert/strict';
import { afterEach, describe, it } from 'node:test';

import { close, open } from './support/browser.mjs';
import { holdNext } from './support/hold.mjs';
import { browser, daemon } from './support/stage.mjs';

let page;

afterEach(() => close(page));

const textOf = (name) => `BEGIN PGM ${name.toUpperCase()} MM\nEND PGM ${name.toUpperCase()} MM\n`;
const put = (name) => daemon.send('PUT', `/v1/files/nc_prog/${name}.h`, textOf(name), 'text/plain');
const there = async (name) => (await fetch(`${daemon.url}/v1/files/nc_prog/${name}.h`)).text();
const shown = (name) => page.waitForSelector(`.cm-line:has-text("END PGM ${name.toUpperCase()} MM")`);
async function begin(name) {
  page = await open(browser, daemon, `#/programs/nc_prog/${name}.h`);
  await shown(name);
}
const pick = (name) => page.click(`.files button:text-is("${name}.h")`);
const store = () => page.click('.program .actions button:has-text("Store")');
const isStored = () => page.waitForFunction(() => document.querySelector('.title .aside').textContent === '');

async function type(text) {
  await page.click('.cm-line >> nth=0');
  await page.keyboard.press('End');
  await page.keyboard.type(text);
  await page.waitForFunction(() => document.querySelector('.title .aside').textContent !== '');
}

describe('a program that is not stored', () => {
  it('is kept where its file is deleted elsewhere, and is stored anew', async () => {
    await put('gone');
    await put('other');
    await begin('gone');
    await type(' ; mine');
    await daemon.send('DELETE', '/v1/files/nc_prog/gone.h', '');
    await pick('other');
    await shown('other');
    await pick('gone');
    await page.waitForSelector('.cm-line:has-text("; mine")');
    assert.match(await page.textContent('.title'), /^gone\.h.*not stored yet/);
    await store();
    await isStored();
    assert.equal(await there('gone'), textOf('gone').replace('MM\n', 'MM ; mine\n'));
  });

  it('is kept where the view before stores the text that it was', async () => {
    await put('sent');
    await begin('sent');
    await type(' ; first');
    const { asked, go } = await holdNext(page.context(), '**/v1/files/nc_prog/sent.h');
    await store();
    await asked;
    await page.click('#views a[href^="#/tables"]');
    await page.waitForSelector('.grid');
    await page.goBack();
    await page.waitForSelector('.cm-line:has-text("; first")');
    await type(', second');
    const answered = page.waitForResponse((answer) => answer.request().method() === 'PUT');
    go();
    await answered;
    await page.waitForFunction(() => document.getElementById('loading').textContent === '');
    assert.match(await page.textContent('.title'), /^sent\.h.*not stored yet/);
    await store();
    await isStored();
    assert.equal(await there('sent'), textOf('sent').replace('MM\n', 'MM ; first, second\n'));
  });

  it('is in the list from its beginning until it is discarded', async () => {
    await put('other');
    await begin('other');
    await page.fill('.begin input', 'begun');
    await page.click('.begin button');
    await shown('begun');
    await type(' ; mine');
    await pick('other');
    await shown('other');
    await pick('begun');
    await page.waitForSelector('.cm-line:has-text("; mine")');
    await page.click('button:has-text("Discard changes")');
    await page.click('dialog button:has-text("Discard changes")');
    await page.waitForSelector('.empty:not([hidden])');
    assert.equal(await page.$('.files button:text-is("begun.h")'), null);
  });
});

describe('a program that cannot be opened', () => {
  it('leaves nothing of the one before under its name', async () => {
    await put('first');
    await put('second');
    await begin('first');
    await type(' ; mine');
    await page.route('**/v1/files/nc_prog/second.h', (route) => route.abort());
    await pick('second');
    await page.waitForFunction(() => document.querySelector('.program > .note').textContent !== '');
    assert.equal(await page.isVisible('.run button[type="submit"]'), false);
    assert.equal(await page.isVisible('.title'), false);
    await pick('first');
    await page.waitForSelector('.cm-line:has-text("; mine")');
    assert.match(await page.textContent('.title'), /^first\.h.*not stored yet/);
    await page.unroute('**/v1/files/nc_prog/second.h');
    await pick('second');
    await shown('second');
    assert.equal(await page.textContent('.title'), 'second.h');
  });
});

describe('a plan whose changes are discarded', () => {
  it('leaves no form behind where it is deleted elsewhere', async () => {
    await daemon.send('PUT', '/v1/plans/GONE', { characteristics: [{ name: 'bore', designation: '25 H7' }] });
    page = await open(browser, daemon, '#/plans/GONE');
    await page.waitForSelector('.editor:not([hidden]) .characteristic');
    await page.fill('.editor [name="name"] >> nth=0', 'changed');
    await daemon.send('DELETE', '/v1/plans/GONE', '');
    await page.click('.editor button:has-text("Discard changes")');
    await page.click('dialog button:has-text("Discard changes")');
    await page.waitForSelector('.plan-list:not([hidden])');
    await page.waitForFunction(() => document.querySelector('.plans .done').textContent !== '');
    assert.equal(await page.isVisible('.editor'), false);
  });
});
