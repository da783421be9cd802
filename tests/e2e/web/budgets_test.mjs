/** Uncertainty budgets as a table: evaluated as they are typed, with a model, stored, and shown with what is wrong at its cell. */

import assert from 'node:assert/strict';
import { before, describe, it } from 'node:test';

import { uncertaintyOf } from '../../../clients/web/gauges/budgets.js';
import { close, findings, hashOf, open, picture } from './support/browser.mjs';
import { holdAll } from './support/hold.mjs';
import { browser, daemon } from './support/stage.mjs';

const BORE = { contributions: [{ name: 'ring', standard_uncertainty: 0.3, degrees_of_freedom: 50 }, { name: 'repeatability', standard_uncertainty: 0.4, degrees_of_freedom: 9 },
  { name: 'temperature', half_width: 1.5, distribution: 'rectangular' }] };
const BLOCK = { model: 'L*(1 + a*(20 - t))', contributions: [{ name: 'L', value: 50.0012, standard_uncertainty: 0.0001 }, { name: 'a', value: 11.5e-6, half_width: 1e-6 }, { name: 't', value: 20.8, standard_uncertainty: 0.2 }] };

const evaluated = async (budget) => (await daemon.send('POST', '/v1/uncertainty', budget)).json();
const shown = (value) => String(Number(value.toPrecision(4)));
const tiles = (page) => page.$$eval('.budgets .tiles dd', (all) => all.map(({ textContent }) => textContent));

describe('an uncertainty budget', () => {
  before(() => daemon.send('PUT', '/v1/uncertainties/bore-gauge', { ...BORE, contributions: [...BORE.contributions.slice(0, 2), { ...BORE.contributions[2], limits_half_width: 0.3 }] }));

  it('is a table that is evaluated as it is typed, and stored', async () => {
    const page = await open(browser, daemon, '#/gauges', { viewport: { width: 1366, height: 768 } });
    await page.waitForFunction(() => document.querySelector('[name="stored-budget"]').options.length === 2);
    const fill = async (row, name, value) => { await page.fill(`.budgets tbody tr:nth-child(${row}) [name="${name}"]`, value); await page.press(`.budgets tbody tr:nth-child(${row}) [name="${name}"]`, 'Tab'); };
    await page.click('.budgets .actions >> text=Add a contribution');
    for (const [i, one] of BORE.contributions.entries()) {
      for (const [name, value] of Object.entries(one)) if (name !== 'distribution') await fill(i + 1, name, String(value).replace('.', ','));
    }
    await page.selectOption('.budgets tbody tr:nth-child(3) [name="distribution"]', 'rectangular');
    const answer = await evaluated(BORE);
    await page.waitForFunction((wanted) => document.querySelector('.budgets .tiles')?.textContent.includes(wanted), `± ${shown(answer.expanded_uncertainty)}`);
    assert.deepEqual(await tiles(page), [shown(answer.combined_standard_uncertainty), shown(answer.effective_degrees_of_freedom), answer.coverage_factor.toFixed(2), `± ${shown(answer.expanded_uncertainty)}`]);
    const shares = await page.$$eval('.budgets .share', (all) => all.map(({ textContent }) => parseInt(textContent, 10)));
    assert.ok(Math.abs(shares.reduce((sum, one) => sum + one, 0) - 100) <= 1, shares.join());
    await page.fill('[name="budget-name"]', 'own');
    await page.click('.budgets .primary');
    await page.waitForFunction(() => /own is stored/.test(document.querySelector('.budgets [role="status"]').textContent));
    assert.deepEqual((await daemon.json('/v1/uncertainties/own')).contributions, BORE.contributions);
    assert.match(hashOf(page), /budget=own/);
    assert.deepEqual(await findings(page), []);
    await page.$eval('.budgets', (section) => section.scrollIntoView());
    await picture(page, 'budgets');
    await close(page);
  });

  it('is kept while it is not stored: over a reload and another view, also a new one', async () => {
    const page = await open(browser, daemon, '#/gauges?budget=bore-gauge');
    const ring = '.budgets tbody tr:first-child';
    await page.waitForFunction((row) => document.querySelector(`${row} [name="name"]`)?.value === 'ring', ring);
    await page.fill(`${ring} [name="standard_uncertainty"]`, '0.7');
    const goesOn = async (name, value) => {
      await page.waitForFunction(([row, wanted]) => document.querySelector(`${row} [name="standard_uncertainty"]`)?.value === wanted, [ring, value]);
      assert.equal(await page.inputValue('[name="budget-name"]'), name);
    };
    const elsewhere = async () => {
      await page.click('#views a[href^="#/tables"]');
      await page.waitForSelector('.grid');
      await page.goBack();
    };
    await elsewhere();
    await goesOn('bore-gauge', '0.7');
    await page.reload();
    await goesOn('bore-gauge', '0.7');
    await page.fill('[name="budget-name"]', 'bore-kept');
    await elsewhere();
    await goesOn('bore-kept', '0.7');
    await page.click('.budgets .primary');
    await page.waitForFunction(() => /bore-kept is stored/.test(document.querySelector('.budgets [role="status"]').textContent));
    const [ours, theirs] = await Promise.all(['bore-kept', 'bore-gauge'].map((name) => daemon.json(`/v1/uncertainties/${name}`)));
    assert.deepEqual([ours, theirs].map(({ contributions: [{ standard_uncertainty: u }] }) => u), [0.7, 0.3]);
    assert.equal(ours.contributions[2].limits_half_width, 0.3); // what the table has no column for
    await elsewhere();
    await goesOn('bore-kept', '0.7');
    assert.deepEqual(await page.evaluate(() => Object.keys(sessionStorage).filter((key) => key.includes('budget-draft/'))), []);
    await close(page);
  });

  it('has a model, whose sensitivities the service finds; a mistake is marked at its cell', async () => {
    await daemon.send('PUT', '/v1/uncertainties/block', BLOCK);
    const page = await open(browser, daemon, '#/gauges?budget=block', { viewport: { width: 1024, height: 768 }, locale: 'it-IT' });
    const answer = await evaluated(BLOCK);
    await page.waitForFunction(() => document.querySelectorAll('.budgets .tiles dd').length === 5);
    assert.equal((await tiles(page))[0], answer.value.toFixed(5).replace('.', ','));
    const own = await page.$$eval('.budgets .u', (all) => all.map(({ textContent }) => textContent.replace(',', '.')));
    assert.deepEqual(own.map(Number), answer.sensitivities.map(({ contribution }) => Number(Math.abs(contribution).toPrecision(4))));
    await page.$eval('.budgets', (section) => section.scrollIntoView());
    await picture(page, 'budgets-it');
    await page.fill('.budgets tbody tr:nth-child(2) [name="standard_uncertainty"]', '1');
    await page.press('.budgets tbody tr:nth-child(2) [name="standard_uncertainty"]', 'Tab');
    await page.waitForSelector('.budgets tbody tr:nth-child(2) [name="half_width"][aria-invalid]');
    assert.notEqual(await page.textContent('.budgets .note'), '');
    assert.deepEqual(await tiles(page), []);
    await page.setViewportSize({ width: 390, height: 844 });
    await page.waitForFunction(() => document.documentElement.scrollWidth <= innerWidth);
    assert.deepEqual(await findings(page), []);
    await picture(page, 'budgets-390', { fullPage: true });
    await close(page);
  });

  it('keeps what the table has no column for', async () => {
    const page = await open(browser, daemon, '#/gauges?budget=bore-gauge');
    await page.waitForFunction(() => document.querySelectorAll('.budgets .tiles dd').length === 4);
    const { combined_standard_uncertainty: combined } = await evaluated(await daemon.json('/v1/uncertainties/bore-gauge'));
    assert.equal((await tiles(page))[0], shown(combined));
    await page.click('.budgets .primary');
    await page.waitForFunction(() => /is stored/.test(document.querySelector('.budgets [role="status"]').textContent));
    assert.equal((await daemon.json('/v1/uncertainties/bore-gauge')).contributions[2].limits_half_width, 0.3);
    await close(page);
  });

  it('replaces no other and is not lost before somebody says so, also while it is being stored', async () => {
    const before = await daemon.json('/v1/uncertainties/bore-gauge');
    await daemon.send('PUT', '/v1/uncertainties/second', BORE);
    const page = await open(browser, daemon, '#/gauges');
    const name = (text) => page.waitForFunction((wanted) => document.querySelector('[name="budget-name"]').value === wanted, text);
    const note = (pattern) => page.waitForFunction((text) => new RegExp(text).test(document.querySelector('.budgets .note').textContent), pattern);
    await page.waitForSelector('.budgets option[value="second"]', { state: 'attached' });
    await page.fill('.budgets tbody tr:nth-child(1) [name="name"]', 'mine');
    await page.fill('.budgets tbody tr:nth-child(1) [name="standard_uncertainty"]', '0.7');
    await page.fill('[name="budget-name"]', 'bore-gauge');
    await page.click('.budgets .primary');
    await note('bore-gauge already exists');
    assert.deepEqual(await daemon.json('/v1/uncertainties/bore-gauge'), before);
    await page.selectOption('[name="stored-budget"]', 'second');
    await page.click('dialog >> text=Cancel');
    assert.deepEqual([await page.inputValue('[name="stored-budget"]'), await page.inputValue('.budgets tbody [name="name"]')], ['', 'mine']);
    await page.selectOption('[name="stored-budget"]', 'second');
    await page.click('dialog .primary');
    await name('second');
    await page.click('.budgets tbody tr:nth-child(2) .quiet');
    assert.equal(await page.evaluate(() => document.activeElement.value), 'temperature');
    const go = await holdAll(page, '**/v1/uncertainties/second');
    await page.dblclick('.budgets .primary');
    await page.fill('.budgets tbody tr:nth-child(1) [name="name"]', 'typed meanwhile');
    go();
    await page.waitForFunction(() => /second is stored/.test(document.querySelector('.budgets [role="status"]').textContent));
    assert.deepEqual([await page.inputValue('.budgets tbody [name="name"]'), await page.textContent('.budgets .note')], ['typed meanwhile', '']);
    assert.equal((await daemon.json('/v1/uncertainties/second')).contributions.length, 2);
    await daemon.send('PUT', '/v1/uncertainties/second', BORE);
    await page.click('.budgets .primary');
    await note('Somebody has changed second');
    await page.click('.budgets .note >> text=Read the stored version');
    await page.click('dialog .primary');
    await page.waitForFunction(() => document.querySelectorAll('.budgets tbody tr').length === 3);
    await close(page);
  });

  it('has the standard uncertainty of its half widths', () => {
    assert.equal(uncertaintyOf({ standard_uncertainty: 0.3 }), 0.3);
    assert.ok(Math.abs(uncertaintyOf({ half_width: 3 }) - Math.sqrt(3)) < 1e-12);
    assert.ok(Math.abs(uncertaintyOf({ half_width: 3, distribution: 'triangular' }) - 3 / Math.sqrt(6)) < 1e-12);
    assert.ok(Math.abs(uncertaintyOf({ half_width: 3, limits_half_width: 0.6 }) - Math.sqrt(3) * Math.sqrt(1 + 0.04 / 3)) < 1e-12);
  });
});
