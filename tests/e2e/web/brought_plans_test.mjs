/** Plans on the page, brought by tables and drawings, and measured by. */

import assert from 'node:assert/strict';
import fs from 'node:fs';
import { describe, it } from 'node:test';

import { findings, picture, saved } from './support/browser.mjs';
import { drawingOf, dropFile, housing, workbookOf } from './support/drawing.mjs';
import { edit, field, names, page, plan, says, stored, storePlan, visit } from './support/plans.mjs';
import { daemon } from './support/stage.mjs';

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

  it('is read below a title whatever separates its cells, and no row and no word of it is passed over', async () => {
    await visit();
    await dropFile(page, 'mac.csv', 'Housing; made in spring\rname,designation,kind\rbore,25 H7,\r,30 H7,\redge,R2 ISO 2768-m,Fase\r');
    await says('3 characteristics from mac.csv');
    await page.fill('[name="part"]', 'T-M');
    await storePlan();
    await page.waitForFunction(() => document.querySelector('.characteristics > li:nth-child(2) .of-name .note')?.textContent);
    await field(2, 'name').fill('seat');
    await storePlan();
    await page.waitForFunction(() => document.querySelector('.characteristics > li:nth-child(3) .of-kind .note')?.textContent);
    await field(3, 'kind').selectOption('radius');
    await storePlan();
    await stored('T-M');
    assert.deepEqual(await found('T-M'), [{ name: 'bore', designation: '25 H7' }, { name: 'seat', designation: '30 H7' }, { name: 'edge', designation: 'R2 ISO 2768-m', quantity: 'radius' }]);
  });

  it('keeps every digit, and a size that is too fine is refused at its row', async () => {
    await visit();
    await dropFile(page, 'fine.csv', 'name;size;kind\nfirst;25.00000000000000001 +0.1/0;hole\nsecond;12 ≥ 11.9000001;distance\n');
    await says('2 characteristics from fine.csv');
    await page.fill('[name="part"]', 'T-D');
    await page.click('.characteristics > li:first-child [aria-label^="Copy"]');
    await storePlan();
    await page.waitForFunction(() => [1, 2, 3].every((number) => document.querySelector(`.characteristics > li:nth-child(${number}) .of-size .note`)?.textContent));
    await daemon.json('/v1/plans').then(({ plans }) => assert.ok(!plans.some(({ part }) => part === 'T-D')));
  });

  it('that has no names, no rows, or is none at all, says so', async () => {
    await visit();
    for (const [name, text, answer] of [['a.csv', 'x;y\n1;2\n', /no column of names/], ['b.csv', 'name;size\n', /no row/], ['c.csv', 'part,name,size\nA,x,25 H7\nB,y,25 H7\n', /several part numbers: A, B/],
      ['f.csv', 'name,upper_um,lower_um,nominal_mm\nbore,21,0,25,5\n', /without a heading in this row: bore · 21 · 0 · 25 · 5/], ['g.csv', 'name;designation;Name\nbore;25 H7;B\n', /a column twice: name, Name/],
      ['h.csv', 'name;size;designation;kind\nbore;25 H7;30 H7;hole\n', /a column twice: size, designation\./], ['i.csv', 'name;size;upper_um;upper_mm\nbore;25;21;0.03\n', /a column twice: upper_um, upper_mm\./],
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
