/** Plans on the page: written in a form, brought by tables and drawings, and measured by. */

import assert from 'node:assert/strict';
import fs from 'node:fs';
import { afterEach, describe, it } from 'node:test';

import { toJson } from '../../../clients/web/exact.js';
import { sizeMembers, sizeTyped } from '../../../clients/web/plans/sizes.js';
import { close, findings, hashOf, open, picture, saved } from './support/browser.mjs';
import { Daemon } from './support/daemon.mjs';
import { drawingOf, dropFile, housing, workbookOf } from './support/drawing.mjs';
import { holdAll, waits } from './support/hold.mjs';
import { scan } from './support/scanner.mjs';
import { browser, daemon } from './support/stage.mjs';

let page;
afterEach(async () => {
  if (page) await close(page);
  page = null;
});

const plan = (part) => daemon.json(`/v1/plans/${part}`);
const row = (number) => page.locator(`.characteristics > li:nth-child(${number})`);
const field = (number, name) => row(number).locator(`.of-${name} :is(input, select, textarea)`);
const noteOf = (number, name) => row(number).locator(`.of-${name} .note`).textContent();
const names = () => page.$$eval('.characteristics .of-name input', (all) => all.map(({ value }) => value));
const storePlan = () => page.click('.editor button[type="submit"]');
const says = (text) => page.waitForFunction((wanted) => document.querySelector('.done')?.textContent.includes(wanted), text);
const stored = (part) => says(`Plan ${part} is stored`);
const visit = async (address = '#/plans', options = {}) => {
  page = await open(browser, daemon, address, options);
  await page.waitForSelector('.drop');
};
const edit = async (part) => {
  await visit(`#/plans/${part}`);
  await page.waitForSelector('.editor:not([hidden]) .characteristic');
};

describe('sizes as people write them', () => {
  const CASES = [
    ['25 H7', '', { designation: '25 H7' }], ['M10-6H', 'hole', { designation: 'M10-6H' }], ['25 ISO 2768-m', 'hole', { designation: '25 ISO 2768-m', feature: 'hole' }],
    ['8 +0.036/0', 'hole', { nominal_mm: 8, upper_um: 36, lower_um: 0, feature: 'hole' }, '8 +0.036/0'],
    ['Ø 8 0 +0,036', 'hole', { nominal_mm: 8, upper_um: 36, lower_um: 0, feature: 'hole' }, '8 +0.036/0'],
    ['40 ±0.1', 'distance', { nominal_mm: 40, upper_um: 100, lower_um: -100, quantity: 'distance' }, '40 ±0.1'],
    ['12 ≥ 11.9', 'hole', { nominal_mm: 12, lower_um: -100, feature: 'hole' }, '12 ≥ 11.9'],
    ['<= 0.05', 'deviation', { nominal_mm: 0, upper_um: 50, quantity: 'deviation' }, '0 ≤ 0.05'],
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
    await page.waitForFunction(() => /Somebody has changed plan TWO/.test(document.querySelector('.editor > .note').textContent));
    assert.equal((await plan('TWO')).characteristics[0].designation, '25 H8');
    await picture(page, 'plans-changed');
    await page.click('.editor > .note >> text=Store my plan anyway');
    await stored('TWO');
    assert.deepEqual((await plan('TWO')).characteristics, [{ name: 'a', designation: '25 H7', gauge: 'G-1' }]);
    // A number that is given away already is another plan.
    await page.fill('[name="part"]', 'K');
    await storePlan();
    await page.waitForFunction(() => /Plan K already exists/.test(document.querySelector('.editor > .note').textContent));
    assert.equal((await plan('K')).characteristics.length, 2);
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
  });
});

describe('a table', () => {
  const found = async (name) => JSON.parse(JSON.stringify((await plan(name)).characteristics));

  it('as CSV brings its rows into the form, with a comma or a point, and says which columns it has not read', async () => {
    await visit();
    await dropFile(page, 'table.csv', 'Part;Characteristic;Size and limits;Measured;Gauge;upper_mm;lower_mm;Colour\nT-1;bore;25 H7;;G-07;;;red\nT-1;slot;8;width, inside;;+0,036;0;\nT-1;length;40 ±0,1;distance;;;;\n');
    await says('3 characteristics from table.csv');
    await says('Columns not read: Colour');
    assert.equal(await page.inputValue('[name="part"]'), 'T-1');
    await storePlan();
    await stored('T-1');
    assert.deepEqual(await found('T-1'), [{ name: 'bore', designation: '25 H7', gauge: 'G-07' },
      { name: 'slot', nominal_mm: 8, upper_um: 36, lower_um: 0, feature: 'hole', quantity: 'width' }, { name: 'length', nominal_mm: 40, upper_um: 100, lower_um: -100, quantity: 'distance' }]);
    const [name, bytes] = await saved(page, () => page.click('text=Save as CSV'));
    assert.equal(name, 'T-1.csv');
    await page.click('text=All plans');
    await dropFile(page, 'again.csv', String(bytes));
    await says('3 characteristics');
    await page.fill('[name="part"]', 'T-2');
    await storePlan();
    await stored('T-2');
    assert.deepEqual(await found('T-2'), await found('T-1'));
    await daemon.send('PUT', '/v1/plans/T-E', { characteristics: [{ name: 'seat', nominal_mm: 25, upper_um: 21, lower_um: 0, feature: 'hole', envelope: 'required', size_operator: 'GX', entity: '#120' }] });
    await edit('T-E');
    const [, whole] = await saved(page, () => page.click('text=Save as CSV'));
    await page.click('text=All plans');
    await dropFile(page, 'whole.csv', String(whole));
    await says('1 characteristic');
    await page.fill('[name="part"]', 'T-F');
    await storePlan();
    await stored('T-F');
    assert.deepEqual(await found('T-F'), await found('T-E'));
  });

  it('as a workbook does too, and adds to a plan that is open', async () => {
    await edit('T-1');
    await page.setInputFiles('#plan-file', { name: 'more.xlsx', mimeType: '', buffer: workbookOf([
      ['Housing, made in spring', null], ['name', 'nominal_mm', 'upper_um', 'lower_um', 'feature', 'reaction'], ['seat & "more"', 30, 21.000000000000004, 0, 'hole', 'Stop'], [null, null]]) });
    await says('1 characteristics from more.xlsx');
    await storePlan();
    await stored('T-1');
    assert.deepEqual((await found('T-1')).slice(3), [{ name: 'seat & "more"', nominal_mm: 30, upper_um: 21, lower_um: 0, feature: 'hole', reaction: 'Stop' }]);
  });

  it('that has no names, no rows, or is none at all, says so', async () => {
    await visit();
    for (const [name, text, answer] of [['a.csv', 'x;y\n1;2\n', /no column of names/], ['b.csv', 'name;size\n', /no row/], ['c.csv', 'part,name,size\nA,x,25 H7\nB,y,25 H7\n', /several part numbers: A, B/],
      ['d.xlsx', 'PK\x03\x04', /not a workbook/], ['e.stp', 'ISO-10303-21;\nHEADER;', /cannot be read/]]) {
      await dropFile(page, name, text);
      await page.waitForFunction((pattern) => new RegExp(pattern).test(document.querySelector('.drop-zone > .note').textContent), answer.source);
    }
  });
});

describe('a drawing', () => {
  const HOUSING = fs.readFileSync('tests/fuzz/corpus/step/housing.stp', 'utf8');
  const review = () => page.waitForSelector('.review .read tbody tr[data-state]');

  it('shows what was read beside what was not, with the reason, and is taken row by row', async () => {
    await visit();
    await dropFile(page, 'housing.stp', HOUSING);
    await review();
    assert.match(await page.textContent('.read'), /Bore Ø A2 × · #100Ø 25 H7 \(E\)/);
    assert.match(await page.textContent('.read'), /the order is wrong there/);
    const left = await page.textContent('.not-read');
    assert.match(left, /Not read: 8/);
    assert.match(left, /25 H7 is \+21 0 µm of a hole, and the limits of the file are \+25 0 µm/); // both, neither is chosen
    assert.match(left, /flatness tolerance is not gauged here/);
    assert.equal(await page.inputValue('[name="drawing-part"]'), '4711-A');
    await page.waitForFunction(() => /25\.000 to 25\.021 mm/.test(document.querySelector('.read tbody').textContent));
    assert.deepEqual(await findings(page), []);
    await picture(page, 'plans-drawing', { fullPage: true });
    await page.uncheck('.read tbody tr:nth-child(2) input');
    await page.click('.review button[type="submit"]');
    await stored('4711-A');
    assert.deepEqual((await plan('4711-A')).characteristics, [
      { name: 'Bore Ø A', designation: '25 H7 (E)', quantity: 'diameter', count: 2, entity: '#100' },
      { name: 'width 8', nominal_mm: 8, upper_um: 0, lower_um: -36, feature: 'hole', quantity: 'width', entity: '#130' },
      { name: 'width 8.001', nominal_mm: 8.001, upper_um: -20, lower_um: -50, feature: 'shaft', quantity: 'width', entity: '#150' },
      { name: 'distance 40', nominal_mm: 40, upper_um: 100, lower_um: -100, quantity: 'distance', entity: '#170' }]);
    assert.equal((await plan('4711-A')).drawing.digest.length, 64);
  });

  it('goes on in the form with what somebody types in place of what was not read', async () => {
    await visit();
    await dropFile(page, 'housing.stp', HOUSING);
    await review();
    await page.fill('[name="drawing-part"]', 'HAND');
    await page.click('[aria-label="Type dimensional size (#191) yourself"]');
    assert.ok(await page.isDisabled('.review button[type="submit"]'));
    await page.click('text=Continue in the form');
    await page.waitForSelector('.editor:not([hidden]) .characteristic');
    assert.deepEqual([(await names()).at(-1), await page.evaluate(() => document.activeElement.closest('.of-size') !== null)], ['dimensional size', true]);
    await field(6, 'size').fill('25 H7');
    await storePlan();
    await stored('HAND');
    assert.deepEqual((await plan('HAND')).characteristics.at(-1), { name: 'dimensional size', designation: '25 H7', entity: '#191' });
  });

  it('of a plan that is there shows what is new, changed and gone; each change is taken or not', async () => {
    const sizes = housing(4);
    await visit();
    await dropFile(page, 'a.stp', drawingOf('REV', sizes));
    await review();
    await page.click('.review button[type="submit"]');
    await stored('REV');
    await field(1, 'gauge').fill('G-07');
    await page.click('text=Add a characteristic');
    await field(5, 'name').fill('by hand');
    await field(5, 'size').fill('10 H7');
    await storePlan();
    await page.waitForFunction(() => /5 characteristics/.test(document.querySelector('.done').textContent));
    await page.click('text=All plans');
    // Bore 1 and Journal 2 have other limits, Bore 3 is gone, Bore 5 is new.
    const next = [{ ...sizes[0], of: 'H8' }, { ...sizes[1], of: 'f7' }, sizes[3], housing(5)[4]];
    await dropFile(page, 'b.stp', drawingOf('REV', next));
    await review();
    await page.waitForFunction(() => /1 added, 2 changed, 1 gone, 1 as before/.test(document.querySelector('.against').textContent));
    assert.deepEqual(await page.$$eval('.read tbody tr', (all) => all.map((each) => each.dataset.state)), ['changed', 'changed', 'same', 'added', 'gone']);
    assert.match(await page.textContent('.read tbody tr:first-child'), /Ø 25 H8before: Ø 25 H7/);
    assert.match(await page.textContent('.review'), /stays: by hand/);
    assert.deepEqual(await findings(page), []);
    await picture(page, 'plans-revision', { fullPage: true });
    await page.uncheck('.read tbody tr:nth-child(2) input');
    await page.click('.review button[type="submit"]');
    await stored('REV');
    const { characteristics } = await plan('REV');
    assert.deepEqual(characteristics.map(({ name, tolerance_class: of, designation }) => [name, of ?? designation]),
      [['Bore 1', 'H8'], ['Journal 2', 'g6'], ['Journal 4', 'g6'], ['Bore 5', 'H7'], ['by hand', '10 H7']]);
    assert.equal(characteristics[0].gauge, 'G-07');
  });

  it('of 60 sizes leads to the first stored verdict in four steps, nothing typed but the value', async () => {
    await visit();
    let steps = 0;
    const step = (act) => { ++steps; return act(); };
    await step(() => dropFile(page, 'gear-housing.stp', drawingOf('GH-60', housing(60))));
    await review();
    await step(() => page.keyboard.press('Enter')); // the plan is stored
    await stored('GH-60');
    await step(() => page.keyboard.press('Enter')); // the station
    await page.waitForFunction(() => document.querySelector('.plan:not([aria-busy]) .progress')?.textContent === '1 of 60');
    await page.waitForSelector('.echo .figures');
    await step(() => page.keyboard.type('25.013\n'));
    await page.waitForSelector('.verdict[data-verdict="good"]:not([data-provisional])');
    await page.waitForSelector('.link[data-state="up"]');
    const [record] = (await daemon.stored()).filter(({ characteristic }) => characteristic === 'Bore 1');
    assert.deepEqual([record.verdict, record.measured_mm, record.designation], ['good', 25.013, '25 H7']);
    assert.equal(steps, 4);
    assert.equal((await plan('GH-60')).characteristics.length, 60);
  });
});

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
    await page.click('.catalogue >> text=Wrong offset');
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
    await tell('Somebody has changed catalogue c-two');
    assert.deepEqual((await catalogue('c-two')).causes, ['B']);
    await page.getByRole('button', { name: 'Read the stored catalogue' }).click();
    await page.waitForFunction(() => document.querySelector('.catalogues [aria-label="Causes"] input')?.value === 'B');
    await entry('Causes', 1).locator('input').fill('D');
    await storeIt();
    await tell('is stored');
    assert.deepEqual((await catalogue('c-two')).causes, ['D']);
    await page.getByRole('button', { name: 'Delete', exact: true }).last().click();
    await page.click('dialog .primary');
    await tell('Catalogue c-two is deleted.');
  });

  it('are read by everybody and written with a key of their role', async () => {
    const locked = await new Daemon('--auth', 'read-open').start();
    const key = await locked.key('hall', 'operator');
    page = await open(browser, locked, '#/plans');
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
