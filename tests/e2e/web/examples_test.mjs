/** Programs to try on a fresh install, and the workpiece as a form. */

import assert from 'node:assert/strict';
import fs from 'node:fs';
import { afterEach, describe, it } from 'node:test';

import { close, findings, hashOf, open, picture } from './support/browser.mjs';
import { browser, daemon } from './support/stage.mjs';

const EXAMPLE = 'clients/nc/8255';

let page;

afterEach(() => close(page));

const hash = () => hashOf(page);

describe('the examples', () => {
  for (const [name, done] of Object.entries({
    8255: /STATUS OF THE FIT: GOOD/, 8210: /Q\d+/, 8025: /Q\d+/, 444: /TCHPR444/, 451: /TCHPR451/,
  })) {
    it(`${name} is on the control, run and shown by one tap`, async () => {
      page = await open(browser, daemon, '#/programs');
      await page.click(`.empty button:has-text("${name}")`);
      await page.waitForSelector('.report .headline:has-text("Completed")');
      await page.waitForFunction((source) => new RegExp(source).test(document.querySelector('.report').textContent), done.source);
      assert.match(hash(), new RegExp(`^#/programs/nc_prog/${name}/${name}.h\\?.*run=r`));
      assert.notEqual(await page.inputValue('.run select'), '');
      if (name === '8255') await picture(page, 'programs-example', { fullPage: true });
    });
  }

  it('are not put over what somebody has changed', async () => {
    const file = `${daemon.url}/v1/files/nc_prog/8025/8025.h`;
    const changed = (await (await fetch(file)).text()).replace('Q4 = +8', 'Q4 = +4');
    await fetch(file, { method: 'PUT', body: changed });
    const setup = '/v1/setups/8025-cutter';
    const own = await daemon.json(setup);
    own.machine.tools[0].length_mm = 81;
    await daemon.send('PUT', setup, own);
    page = await open(browser, daemon, '#/programs');
    await page.click('.empty button:has-text("8025")');
    await page.waitForSelector('.report .headline:has-text("Completed")');
    assert.equal(await (await fetch(file)).text(), changed);
    assert.deepEqual(await daemon.json(setup), own);
    page.errors.length = 0;
  });
});

describe('the workpiece of a setup', () => {
  it('is a form: its features are changed, added and removed, and what is run is what the form says', async () => {
    await daemon.send('PUT', '/v1/setups/form', fs.readFileSync(`${EXAMPLE}/setups/hole-good.json`, 'utf8'));
    for (const name of ['8255.h', '82551.h', '82552.a']) await daemon.send('PUT', `/v1/files/nc_prog/form/${name}`, fs.readFileSync(`${EXAMPLE}/${name}`, 'utf8'), 'text/plain');
    page = await open(browser, daemon, '#/programs/nc_prog/form/8255.h?setup=form');
    await page.waitForFunction(() => document.querySelector('.run select')?.value === 'form');
    await page.click('.run summary');
    await page.waitForSelector('.feature');
    assert.deepEqual(await page.$$eval('.feature legend', (all) => all.map((one) => one.textContent)), ['1. Block', '2. Bore']);
    const diameter = page.locator('.feature').nth(1).getByLabel('Diameter');
    assert.equal(await diameter.inputValue(), '25.013');
    assert.deepEqual(await findings(page), []);
    await picture(page, 'programs-workpiece', { fullPage: true });
    await diameter.fill('25,0299'); // a decimal comma is one
    assert.equal(await page.inputValue('.run select'), ''); // what is written below is run
    await page.click('.run button[type="submit"]');
    await page.waitForFunction(() => /STATUS OF THE FIT: REJECT/.test(document.querySelector('.report')?.textContent ?? ''));

    await page.selectOption('.workpiece select', 'boss');
    await page.click('.workpiece > .line button');
    await page.locator('.feature').nth(0).getByRole('button', { name: 'Remove 1. Block' }).click();
    const text = () => page.$eval('.run details details textarea', (area) => JSON.parse(area.value).workpiece.features);
    assert.deepEqual((await text()).map(({ type }) => type), ['bore', 'boss']);
    assert.equal((await text())[0].diameter_mm, 25.0299);
    await page.click('.run details details summary'); // and the text is the same thing
    await page.fill('.run details details textarea', '{"workpiece":{"features":[{"type":"plane"}]}}');
    await page.waitForFunction(() => document.querySelectorAll('.feature').length === 1);
    assert.equal(await page.textContent('.feature legend'), '1. Plane');
    await page.click('.run button:has-text("Store the setup")');
    await page.click('dialog >> text=Cancel');
    assert.equal((await daemon.json('/v1/setups/form')).workpiece.features.length, 2);
    page.errors.length = 0;
  });
});
