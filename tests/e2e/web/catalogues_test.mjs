/** Catalogues of causes and actions on the page. */

import assert from 'node:assert/strict';
import { describe, it } from 'node:test';

import { findings, hashOf, picture } from './support/browser.mjs';
import { Daemon } from './support/daemon.mjs';
import { holdAll } from './support/hold.mjs';
import { openAt, page, visit } from './support/plans.mjs';
import { answer } from './support/reactions.mjs';
import { scan } from './support/scanner.mjs';
import { daemon } from './support/stage.mjs';

describe('catalogues of causes and actions', () => {
  const catalogue = (name) => daemon.json(`/v1/catalogues/${name}`);
  const entries = (list) => page.$$eval(`.catalogues [aria-label="${list}"] input`, (all) => all.map(({ value }) => value));
  const entry = (list, number) => page.locator(`.catalogues [aria-label="${list}"] > li:nth-child(${number})`);
  const tell = (text) => page.waitForFunction((wanted) => [...document.querySelectorAll('.catalogues :is(.done, .note)')].some((one) => one.textContent.includes(wanted)), text);
  const storeIt = () => page.click('.catalogues button[type="submit"]');

  it('are written, put in order, renamed and deleted, and the station offers them', async () => {
    await visit();
    await page.getByRole('button', { name: 'New catalogue' }).click();
    await storeIt();
    await tell('needs a name');
    await entry('Causes', 1).locator('.remove').click();
    assert.equal(await page.evaluate(() => document.activeElement.textContent), 'Add a cause');
    await page.keyboard.press('Enter');
    await page.fill('[name="catalogue-name"]', 'c-turning');
    await entry('Causes', 1).locator('input').fill('Insert worn');
    await entry('Causes', 1).locator('input').press('Enter');
    await entry('Causes', 2).locator('input').fill('Wrong offset');
    await page.getByRole('button', { name: 'Add an action' }).click();
    await entry('Actions', 1).locator('input').fill('Insert changed');
    await entry('Actions', 2).locator('input').evaluate((input) => {
      const paste = new Event('paste', { bubbles: true, cancelable: true });
      Object.defineProperty(paste, 'clipboardData', { value: { getData: () => 'Offset corrected\r\nPart scrapped\n' } });
      input.dispatchEvent(paste);
    });
    assert.deepEqual(await entries('Actions'), ['Insert changed', 'Offset corrected', 'Part scrapped']);
    await entry('Causes', 2).locator('.grip').focus();
    await page.keyboard.press('ArrowUp');
    assert.deepEqual(await findings(page), []);
    await storeIt();
    await tell('Catalogue c-turning is stored: 2 causes, 3 actions.');
    assert.deepEqual(await catalogue('c-turning'), { causes: ['Wrong offset', 'Insert worn'], measures: ['Insert changed', 'Offset corrected', 'Part scrapped'] });
    await picture(page, 'plans-catalogue', { fullPage: true });
    await page.waitForFunction(() => [...document.querySelectorAll('datalist[id^="plan-catalogue"] option')].map(({ value }) => value).join() === 'c-turning'); // a plan offers it without a reload
    await entry('Actions', 3).locator('.remove').click();
    await entry('Causes', 2).locator('input').fill('Wrong offset');
    await storeIt();
    await page.waitForSelector('.catalogues [aria-invalid]'); // twice the same is no choice
    assert.equal((await catalogue('c-turning')).measures.length, 3);
    await entry('Causes', 2).locator('input').fill('Insert broken');
    await page.fill('[name="catalogue-name"]', 'c-milling');
    await storeIt();
    await tell('Catalogue c-milling is stored: 2 causes, 2 actions.');
    assert.deepEqual((await daemon.json('/v1/catalogues')).catalogues.map(({ name }) => name).filter((name) => name.startsWith('c-')), ['c-milling']);
    await daemon.send('PUT', '/v1/plans/C-1', { characteristics: [{ name: 'c-bore', designation: '25 H7', catalogue: 'c-milling' }] });
    await page.getByRole('button', { name: 'Delete', exact: true }).last().click();
    await page.click('dialog .primary');
    await page.waitForFunction(() => document.querySelector('.catalogues .note').textContent !== ''); // a plan names it
    await page.evaluate(() => { location.hash = '#/gauge?plan=C-1&part_id=SN-C1'; });
    await page.waitForSelector('.echo .figures');
    await scan(page, '25.040');
    await answer(page, 'Wrong offset');
    await page.waitForSelector('.catalogue >> text=Offset corrected');
  });

  it('are not overwritten by who read them before, and what was typed comes back', async () => {
    await daemon.send('PUT', '/v1/catalogues/c-two', { causes: ['A'], measures: [] });
    await visit('#/plans?catalogue=c-two');
    await page.waitForSelector('.catalogues form:not([hidden]) [aria-label="Causes"] input');
    await daemon.send('PUT', '/v1/catalogues/c-two', { causes: ['B'], measures: [] });
    await entry('Causes', 1).locator('input').fill('C');
    const goAndComeBack = async () => {
      await page.click('#views a[href^="#/tables"]');
      await page.waitForSelector('.grid');
      await page.click('#views a[href^="#/plans"]');
      await page.waitForFunction(() => document.querySelector('.catalogues [aria-label="Causes"] input')?.value === 'C');
      assert.equal(await page.textContent('.catalogues form .aside'), 'not stored yet');
    };
    await goAndComeBack();
    await goAndComeBack();
    await daemon.send('PUT', '/v1/catalogues/c-other', { causes: ['X'], measures: [] });
    for (const [name, cause] of [['c-other', 'X'], ['c-two', 'C']]) { // another that is looked at takes no draft away
      await page.evaluate((opened) => { location.hash = `#/plans?catalogue=${opened}`; }, name);
      await page.waitForFunction((wanted) => document.querySelector('.catalogues [aria-label="Causes"] input')?.value === wanted, cause);
    }
    await daemon.send('PUT', '/v1/plans/C-2', { characteristics: [{ name: 'c-bore', designation: '25 H7' }] });
    await page.evaluate(() => { location.hash = '#/plans/C-2'; });
    await page.waitForSelector('.editor:not([hidden]) .characteristic');
    await page.waitForFunction(() => document.querySelector('.catalogues [aria-label="Causes"] input')?.value === 'C');
    assert.equal(hashOf(page), '#/plans/C-2');
    await page.getByRole('button', { name: 'All plans' }).click();
    await storeIt();
    await tell('Somebody has changed c-two');
    assert.deepEqual((await catalogue('c-two')).causes, ['B']);
    await page.getByRole('button', { name: 'Read the stored version' }).click();
    await page.waitForFunction(() => document.querySelector('.catalogues [aria-label="Causes"] input')?.value === 'B');
    await entry('Causes', 1).locator('input').fill('D');
    await storeIt();
    await tell('is stored');
    assert.deepEqual((await catalogue('c-two')).causes, ['D']);
    await page.getByRole('button', { name: 'Delete', exact: true }).last().click();
    await page.click('dialog .primary');
    await tell('Catalogue c-two is deleted.');
  });

  it('are stored once however often it is asked for, and go on with what is typed meanwhile', async () => {
    await daemon.send('PUT', '/v1/catalogues/c-slow', { causes: ['A'], measures: [] });
    await visit('#/plans?catalogue=c-slow');
    await page.waitForSelector('.catalogues form:not([hidden]) [aria-label="Causes"] input');
    await entry('Causes', 1).locator('input').fill('B');
    const go = await holdAll(page, '**/v1/catalogues/c-slow');
    await page.dblclick('.catalogues button[type="submit"]');
    await entry('Causes', 1).locator('input').fill('C');
    go();
    await tell('Catalogue c-slow is stored');
    assert.deepEqual([await entries('Causes'), await page.textContent('.catalogues .note'), await page.textContent('.catalogues form .aside')], [['C'], '', 'not stored yet']);
    await daemon.send('DELETE', '/v1/catalogues/c-slow');
  });

  it('are read by everybody and written with a key of their role', async () => {
    const locked = await new Daemon('--auth', 'read-open').start();
    const key = await locked.key('hall', 'operator');
    await openAt(locked, '#/plans');
    await page.fill('dialog input', key);
    await page.press('dialog input', 'Enter');
    await page.getByRole('button', { name: 'New catalogue' }).click();
    await page.fill('[name="catalogue-name"]', 'c-locked');
    await storeIt();
    await page.waitForFunction(() => document.querySelector('.catalogues .note').textContent !== '');
    assert.equal((await fetch(`${locked.url}/v1/catalogues/c-locked`, { headers: { Authorization: `Bearer ${key}` } })).status, 404);
    assert.equal(await page.inputValue('[name="catalogue-name"]'), 'c-locked'); // nothing of it is lost
  });
});
