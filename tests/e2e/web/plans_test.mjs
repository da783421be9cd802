/** Plans on the page, written in a form. */

import assert from 'node:assert/strict';
import { describe, it } from 'node:test';

import { toJson } from '../../../clients/web/exact.js';
import { sizeMembers, sizeTyped } from '../../../clients/web/plans/sizes.js';
import { findings, hashOf, picture } from './support/browser.mjs';
import { holdAll, waits } from './support/hold.mjs';
import { edit, field, names, noteOf, page, plan, row, says, stored, storePlan, visit } from './support/plans.mjs';
import { daemon } from './support/stage.mjs';

describe('sizes as people write them', () => {
  const CASES = [
    ['25 H7', '', { designation: '25 H7' }], ['M10-6H', 'hole', { designation: 'M10-6H' }], ['25 ISO 2768-m', 'hole', { designation: '25 ISO 2768-m', feature: 'hole' }],
    ['8 +0.036/0', 'hole', { nominal_mm: 8, upper_um: 36, lower_um: 0, feature: 'hole' }, '8 +0.036/0'],
    ['Ø 8 0 +0,036', 'hole', { nominal_mm: 8, upper_um: 36, lower_um: 0, feature: 'hole' }, '8 +0.036/0'],
    ['40 ±0.1', 'distance', { nominal_mm: 40, upper_um: 100, lower_um: -100, quantity: 'distance' }, '40 ±0.1'],
    ['12 ≥ 11.9', 'hole', { nominal_mm: 12, lower_um: -100, feature: 'hole' }, '12 ≥ 11.9'],
    ['<= 0.05', 'deviation', { nominal_mm: 0, upper_um: 50, quantity: 'deviation' }, '0 ≤ 0.05'],
    ['-50 ±0.1 mm', 'position', { nominal_mm: -50, upper_um: 100, lower_um: -100, quantity: 'position' }, '−50 ±0.1'],
    ['−50 ≤ −49.9', 'position', { nominal_mm: -50, upper_um: 100, quantity: 'position' }, '−50 ≤ −49.9'],
    ['12 ≥ −0.1', 'distance', { nominal_mm: 12, lower_um: -12100, quantity: 'distance' }, '12 ≥ −0.1'],
    ['25 -0.02/-0.041', 'shaft', { nominal_mm: 25, upper_um: -20, lower_um: -41, feature: 'shaft' }, '25 −0.02/−0.041'],
    ['8 +0.00000001/0', 'hole', { nominal_mm: 8, upper_um: 0.00001, lower_um: 0, feature: 'hole' }], // nothing is rounded on the way
    ['gibberish', '', { designation: 'gibberish' }],
  ];
  for (const [typed, kind, members, again] of CASES) {
    it(`${typed} ${kind}`, () => {
      const found = JSON.parse(toJson(sizeMembers(typed, kind)));
      assert.deepEqual(found, members);
      if (again) assert.equal(sizeTyped(found), again);
    });
  }
});

describe('the form of a plan', () => {
  it('makes a plan, and says what is wrong at its field', async () => {
    await visit();
    await page.waitForSelector('.plan-list .empty:not([hidden])');
    await page.click('.plan-list >> text=New plan');
    await storePlan();
    assert.match(await page.textContent('.plan-form .pair .note'), /part number/);
    await page.fill('[name="part"]', 'F/1');
    await page.fill('[name="name"]', 'Flange');
    await page.fill('[name="part_pattern"]', 'F-####');
    await field(1, 'name').fill('bore');
    await field(1, 'size').fill('25 H77');
    await page.click('text=Add a characteristic');
    await field(2, 'name').fill('bore');
    await field(2, 'size').fill('8 +0,036/0');
    await row(2).locator('.icon.more').click();
    await field(2, 'subgroup_size').fill('99');
    await row(2).locator('.icon.more').click();
    await storePlan();
    await page.waitForFunction(() => document.querySelectorAll('.characteristics [aria-invalid]').length === 4);
    assert.match(await noteOf(1, 'size'), /no class of ISO 286|tolerance class does not exist/);
    assert.match(await noteOf(2, 'name'), /another characteristic/);
    assert.match(await noteOf(2, 'kind'), /feature/);
    assert.match(await noteOf(2, 'subgroup_size'), /1 to 25/);
    assert.ok(await field(2, 'subgroup_size').isVisible());
    await picture(page, 'plans-wrong', { fullPage: true });
    assert.equal((await plan('F%2F1')).code, 'plan.unknown');
    await field(1, 'size').fill('25 H7');
    await page.waitForFunction(() => document.querySelector('.limits-said')?.textContent === '25.000 to 25.021 mm');
    await field(2, 'name').fill('slot');
    await field(2, 'kind').selectOption('width_hole');
    await field(2, 'subgroup_size').fill('5');
    await field(2, 'frequency').fill('each hour');
    await field(2, 'reaction').fill('Stop, tell the setter');
    await storePlan();
    await stored('F/1');
    assert.deepEqual(await plan('F%2F1'), { part: 'F/1', name: 'Flange', part_pattern: 'F-####', characteristics: [
      { name: 'bore', designation: '25 H7' },
      { name: 'slot', nominal_mm: 8, upper_um: 36, lower_um: 0, feature: 'hole', quantity: 'width', frequency: 'each hour', subgroup_size: 5, reaction: 'Stop, tell the setter' }] });
    assert.equal(hashOf(page), '#/plans/F/1');
    assert.deepEqual(await findings(page), []);
    await picture(page, 'plans-form', { fullPage: true });
    await page.click('text=All plans');
    await page.waitForSelector('.plans-there tbody tr');
    assert.match(await page.textContent('.plans-there tbody'), /F\/1\s*Flange\s*2/);
    await picture(page, 'plans-list');
  });

  it('keeps what it has no field for, and changes nothing that was not touched', async () => {
    const whole = { part: 'K', name: 'K', drawing: { digest: 'a'.repeat(64), part: 'K' }, characteristics: [
      { name: 'a', nominal_mm: 25, tolerance_class: 'H7', quantity: 'diameter', count: 4, entity: '#120', gauge: 'G-07' }, { name: 'b', designation: '30 k6 (E)', rule: 'guard_band', uncertainty_um: 1.5 }] };
    await daemon.send('PUT', '/v1/plans/K', whole);
    await edit('K');
    assert.ok(await page.isDisabled('.editor button[type="submit"]'));
    await page.fill('[name="name"]', 'Kappa');
    await storePlan();
    await stored('K');
    assert.deepEqual(await plan('K'), { ...whole, name: 'Kappa' });
  });

  it('is put in order by the keys of a grip and by dragging it; rows are copied, deleted and brought back', async () => {
    await daemon.send('PUT', '/v1/plans/ORDER', { characteristics: ['a', 'b', 'c', 'd'].map((name) => ({ name, designation: '25 H7' })) });
    await edit('ORDER');
    await page.waitForFunction(() => [...document.querySelectorAll('.limits-said')].every(({ textContent }) => textContent)); // the rows stand where they stay
    await row(1).locator('.grip').focus();
    await page.keyboard.press('ArrowDown');
    assert.deepEqual(await names(), ['b', 'a', 'c', 'd']);
    assert.match(await page.textContent('.said-of-order'), /a is number 2 of 4/);
    await page.keyboard.press('End'); // the grip has kept the focus
    assert.deepEqual(await names(), ['b', 'c', 'd', 'a']);
    const middle = async (number) => {
      const box = await row(number).locator('.grip').boundingBox();
      return [box.x + box.width / 2, box.y + box.height / 2];
    };
    await page.mouse.move(...await middle(1));
    await page.mouse.down();
    const [x, y] = await middle(3);
    await page.mouse.move(x, y + 10, { steps: 5 });
    await page.mouse.up();
    assert.deepEqual(await names(), ['c', 'd', 'b', 'a']);
    await row(3).locator('.icon.copy').click();
    assert.deepEqual(await names(), ['c', 'd', 'b', 'b (2)', 'a']);
    await row(1).locator('.icon.remove').click();
    assert.deepEqual(await names(), ['d', 'b', 'b (2)', 'a']);
    await page.click('.said-of-order button');
    assert.deepEqual(await names(), ['c', 'd', 'b', 'b (2)', 'a']);
    await storePlan();
    await stored('ORDER');
    assert.deepEqual((await plan('ORDER')).characteristics.map(({ name }) => name), ['c', 'd', 'b', 'b (2)', 'a']);
  });

  it('replaces nothing that somebody else has changed, before somebody says so', async () => {
    await daemon.send('PUT', '/v1/plans/TWO', { characteristics: [{ name: 'a', designation: '25 H7' }] });
    await edit('TWO');
    await field(1, 'gauge').fill('G-1');
    await daemon.send('PUT', '/v1/plans/TWO', { characteristics: [{ name: 'a', designation: '25 H8' }] });
    await storePlan();
    await page.waitForFunction(() => /Somebody has changed TWO/.test(document.querySelector('.editor > .note').textContent));
    assert.equal((await plan('TWO')).characteristics[0].designation, '25 H8');
    await picture(page, 'plans-changed');
    await page.click('.editor > .note >> text=Store my version anyway');
    await stored('TWO');
    assert.deepEqual((await plan('TWO')).characteristics, [{ name: 'a', designation: '25 H7', gauge: 'G-1' }]);
    // A number that is given away already is another plan.
    await page.fill('[name="part"]', 'K');
    await storePlan();
    await page.waitForFunction(() => /K already exists/.test(document.querySelector('.editor > .note').textContent));
    assert.equal((await plan('K')).characteristics.length, 2);
  });

  it('is stored once however often it is asked for, and goes on with what is typed meanwhile', async () => {
    await daemon.send('PUT', '/v1/plans/SLOW', { characteristics: [{ name: 'a', designation: '25 H7' }] });
    await edit('SLOW');
    await page.fill('[name="name"]', 'Slow');
    const go = await holdAll(page, '**/v1/plans/SLOW');
    for (let i = 0; i < 2; ++i) await page.press('[name="name"]', 'Enter');
    await page.fill('[name="name"]', 'Slower');
    go();
    await stored('SLOW');
    assert.deepEqual([await page.textContent('.editor > .note'), await page.textContent('.editor .aside')], ['', 'not stored yet']);
    assert.equal(await page.evaluate(() => document.activeElement.name), 'name');
    for (let i = 0; i < 2; ++i) {
      await page.keyboard.press('Enter');
      await page.waitForFunction(() => document.querySelector('.editor .aside').textContent === '');
    }
    assert.deepEqual([(await plan('SLOW')).name, hashOf(page)], ['Slower', '#/plans/SLOW']);
    await daemon.send('DELETE', '/v1/plans/SLOW');
  });

  it('is there again after another view and a reload; what is not stored is not lost', async () => {
    await edit('TWO');
    await field(1, 'name').fill('changed');
    await page.click('#views a[href^="#/tables"]');
    await page.waitForSelector('.grid');
    await page.click('#views a[href^="#/plans"]');
    await page.waitForSelector('.editor:not([hidden]) .characteristic');
    assert.deepEqual(await names(), ['changed']);
    await says('are back');
    for (const [part, name] of [['K', 'a'], ['TWO', 'changed']]) { // another that is looked at takes no draft away
      await page.evaluate((opened) => { location.hash = `#/plans/${opened}`; }, part);
      await page.waitForFunction((wanted) => document.querySelector('.characteristics .of-name input')?.value === wanted, name);
    }
    await page.reload();
    await page.waitForSelector('.editor:not([hidden]) .characteristic');
    assert.deepEqual(await names(), ['changed']);
    await page.click('text=Discard changes');
    await page.click('dialog .primary');
    await page.waitForFunction(() => document.querySelector('.characteristics .of-name input')?.value === 'a');
  });

  it('stays at what was opened last, a plan or a catalogue, and gives up what was opened before', async () => {
    for (const name of ['L-1', 'L-2']) {
      await daemon.send('PUT', `/v1/plans/${name}`, { characteristics: [{ name: `of ${name}`, designation: '25 H7' }] });
      await daemon.send('PUT', `/v1/catalogues/${name}`, { causes: [`of ${name}`], measures: [] });
    }
    await visit();
    for (const [address, what, field] of [['#/plans/', 'plans', '.characteristics .of-name input'], ['#/plans?catalogue=', 'catalogues', '.catalogues [aria-label="Causes"] input']]) {
      const go = (name) => page.evaluate((hash) => { location.hash = hash; }, `${address}${name}`);
      await holdAll(page, `**/v1/${what}/L-1`);
      await go('L-1');
      await waits(page);
      await go('L-2');
      await page.waitForFunction((selector) => document.querySelector(selector)?.value === 'of L-2', field);
      await waits(page, false);
      assert.equal(hashOf(page), `${address}L-2`);
    }
    for (const name of ['L-1', 'L-2']) for (const what of ['plans', 'catalogues']) await daemon.send('DELETE', `/v1/${what}/${name}`);
  });

  it('copies and deletes plans from their list', async () => {
    await visit();
    await page.click('[aria-label="Copy plan K"]');
    await page.waitForSelector('.editor:not([hidden]) .characteristic');
    await page.fill('[name="part"]', 'K-2');
    await storePlan();
    await stored('K-2');
    assert.equal((await plan('K-2')).characteristics.length, 2);
    await page.click('text=All plans');
    await page.click('[aria-label="Delete plan K-2"]');
    await page.click('dialog .primary');
    await says('Plan K-2 is deleted');
    assert.equal((await plan('K-2')).code, 'plan.unknown');
  });

  it('takes a picture for a characteristic', async () => {
    await edit('K');
    await row(1).locator('.icon.more').click();
    const png = Buffer.from('iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAYAAAAfFcSJAAAADUlEQVR42mP8z8BQDwAEhQGAhKmMIQAAAABJRU5ErkJggg==', 'base64');
    await row(1).locator('input[type="file"]').setInputFiles({ name: 'bore.png', mimeType: 'image/png', buffer: png });
    await page.waitForFunction(() => document.querySelector('.more-of img')?.naturalWidth === 1);
    await storePlan();
    await stored('K');
    assert.equal((await plan('K')).characteristics[0].picture, 'pictures/bore.png');
    await row(1).locator('input[type="file"]').setInputFiles({ name: 'bore.png', mimeType: 'image/png', buffer: Buffer.from('another') });
    await page.click('dialog >> text=Cancel'); // of another plan, it may be
    assert.deepEqual(Buffer.from(await (await fetch(`${daemon.url}/v1/files/pictures/bore.png`)).arrayBuffer()), png);
  });
});
