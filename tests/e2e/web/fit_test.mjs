/**
 * Fits and the tables of deviations.
 *
 * Tried, and held here:
 * - A column of one's own named `H7`: asked, hatched in the table, listed with its way back
 * - `25 g6` among the holes: *g6 is a shaft class*
 * - Store a column while a station is open: every screen changes
 * - Store a column: in plain ink
 * - `25 H7/` after a fit: nothing
 * - Choose another fit on a slow connection: nothing until they are its own
 */

import assert from 'node:assert/strict';
import { afterEach, describe, it } from 'node:test';

import { close, drawn, hashOf, open, openIn, pasted, picture } from './support/browser.mjs';
import { hold, holdAll, waits } from './support/hold.mjs';
import { browser, daemon } from './support/stage.mjs';

let page;

afterEach(() => close(page));

const hash = () => hashOf(page);

describe('the fit', () => {
  it('shows the zones, the clearances and a measured pair, and the URL is the state', async () => {
    page = await open(browser, daemon, '#/fit/25H7/g6?hole=25.013&shaft=24,985');
    await page.waitForSelector('.limits .mark-of');
    assert.equal(await page.textContent('.fit .headline'), 'Clearance fit');
    assert.deepEqual(await page.$$eval('.zones .um', (texts) => texts.map((text) => text.textContent)), ['+21', '0', '−7', '−20']);
    assert.deepEqual(await page.$$eval('.fit dd', (values) => values.map((value) => value.textContent)), ['41 µm', '7 µm', '11.7 … 36.3 µm', '28 µm']);
    assert.equal((await page.$$('.zones .measured')).length, 2);
    const gaps = await page.$$eval('.limits td:last-child', (cells) => cells.map((cell) => {
      const [mark, copy] = ['.mark-of', '.quiet'].map((name) => cell.querySelector(name).getBoundingClientRect());
      return copy.top >= mark.bottom || copy.left - mark.right;
    }));
    assert.ok(gaps.length === 2 && gaps.every((gap) => gap === true || gap > 7), `Copy is ${gaps} px from the verdict`);
    await page.click('.preferred button:has-text("H7/s6")');
    await page.waitForFunction(() => document.querySelector('.fit .headline')?.textContent === 'Interference fit');
    assert.equal(hash(), '#/fit/25H7/s6?hole=25.013&shaft=24,985');
    await page.goBack();
    await page.waitForFunction(() => document.querySelector('.fit .headline')?.textContent === 'Clearance fit');
  });

  it('takes the envelope requirement of both sizes, in the address too, and says what it means', async () => {
    page = await open(browser, daemon, '#/fit/25H7/g6');
    await page.waitForFunction(() => /form also counts/.test(document.querySelector('.fit .result')?.textContent));
    await page.fill('#fit', '25 H7 Ⓔ/g6(E)');
    await page.press('#fit', 'Enter');
    await page.waitForFunction(() => /hold for every form/.test(document.querySelector('.fit .result').textContent));
    assert.equal(await page.inputValue('#fit'), '25 H7(E)/g6(E)');
    assert.equal(hashOf(page), '#/fit/25H7(E)/g6(E)');
    await page.reload();
    await page.waitForFunction(() => /hold for every form/.test(document.querySelector('.fit .result')?.textContent));
    await page.fill('#fit', '25H7(E)/g6'); // one alone is not enough
    await page.press('#fit', 'Enter');
    await page.waitForFunction(() => /form also counts/.test(document.querySelector('.fit .result').textContent));
    const assumed = await Promise.all(['25H7/g6', '25H7(E)/g6', '25H7/g6(E)', '25H7(E)/g6(E)'].map(async (fit) => (await daemon.json(`/v1/fits/${fit}`)).assumes_envelope));
    assert.deepEqual(assumed, [true, true, true, false]);
  });

  it('takes the bore or the outer ring of a bearing, with blanks at the stroke, in the address too, and judges it', async () => {
    page = await open(browser, daemon, '#/fit/25H7/g6');
    await page.waitForSelector('.limits');
    for (const [typed, shown, address, limits] of [
      ['52 H7 / ISO 492-P6', '52 H7/ISO 492-P6', '#/fit/52H7/ISO 492-P6', /^hole H7.*shaft ISO 492-P6.*0 \/ −11 µm/],
      ['25 iso 492-p6/k6', '25 ISO 492-P6/k6', '#/fit/25ISO 492-P6/k6', /^hole ISO 492-P6.*0 \/ −8 µm.*shaft k6/],
      ['25 ISO 492 - Normal / k6', '25 ISO 492-normal/k6', '#/fit/25ISO 492-normal/k6', /^hole ISO 492-normal.*0 \/ −10 µm.*shaft k6/]]) {
      await page.fill('#fit', typed);
      await page.press('#fit', 'Enter');
      await page.waitForFunction((wanted) => document.querySelector('#fit').value === wanted && !document.querySelector('.result').ariaBusy, shown);
      assert.match(await page.textContent('.limits'), limits);
      assert.equal(hash(), address);
    }
    await page.reload();
    await page.waitForFunction(() => /ISO 492-normal/.test(document.querySelector('.limits')?.textContent));
    await page.fill('#measured-hole', '24.989');
    await page.press('#measured-hole', 'Enter');
    await page.waitForSelector('.limits [data-verdict="rework"]');
  });

  it('is found by the clearance it must have, and copied for a drawing', async () => {
    page = await open(browser, daemon, '#/fit/25H7/k6');
    await page.waitForSelector('.limits');
    await page.fill('#find-least', '5');
    await page.fill('#find-greatest', '45');
    await page.click('.finder button[type="submit"]');
    // ISO 286-2: of 25 mm, H7 is 0 to +21 and g6 -20 to -7, so their clearance is 7 to 41.
    await page.waitForFunction(() => /^H7\/g6\+7 … \+41 µm/.test([...document.querySelectorAll('.found li')].find((item) => /^H7\/g6/.test(item.textContent))?.textContent ?? ''));
    await page.click('.found button:text-is("H7/g6")');
    await page.waitForFunction(() => document.querySelector('.headline')?.textContent === 'Clearance fit');
    assert.match(hash(), /25H7\/g6/);
    // Tolerances 21 and 13 about a mean of 24: their root of squares is 24.7.
    assert.match(await page.textContent('.result dl'), /Probable, 99.73 %11\.7 … 36\.3 µm/);
    for (const [feature, text] of [['H7', '⌀25 H7 (+0.021/0)'], ['g6', '⌀25 g6 (-0.007/-0.020)']]) {
      await page.click(`.limits button[aria-label="Copy 25 ${feature} for a drawing"]`);
      await page.waitForFunction((wanted) => document.querySelector('.side .note')?.textContent === `${wanted} is copied.`, text);
      assert.equal(await pasted(page), text);
    }
    await page.fill('#find-greatest', 'wide');
    await page.click('.finder button[type="submit"]');
    await page.waitForFunction(() => /Type two numbers/.test(document.querySelector('.found-note')?.textContent));
    await picture(page, 'fit-found', { fullPage: true });
  });

  it('leaves nothing of the last fit below one that cannot be read', async () => {
    page = await open(browser, daemon, '#/fit/25H7/g6');
    await page.waitForSelector('.limits');
    await page.fill('.fit .designation', '25 H7/');
    await page.press('.fit .designation', 'Enter');
    await page.waitForFunction(() => (document.querySelector('.fit .note')?.textContent ?? '') !== '');
    assert.equal(await page.$('.fit .limits'), null);
    assert.equal(await page.$('.fit .zones'), null);
    assert.equal(await page.$('.fit .headline'), null);
  });

  it('shows nothing of the last fit while the next one is on its way', async () => {
    page = await open(browser, daemon, '#/fit/25H7/g6');
    await page.waitForSelector('.limits');
    const go = await hold(page, '**/v1/fits/25H7/s6');
    await page.click('.preferred button:has-text("H7/s6")');
    await page.waitForSelector('.limits', { state: 'hidden' });
    assert.equal(await page.isVisible('.zones'), false);
    assert.equal(await page.inputValue('.fit .designation'), '25 H7/s6');
    await go();
    await page.waitForSelector('.limits', { state: 'visible' });
    assert.equal(await page.textContent('.fit .headline'), 'Interference fit');
  });

  it('gives up the fit on its way when the next one cannot be read', async () => {
    page = await open(browser, daemon, '#/fit/25H7/g6');
    await page.waitForSelector('.limits');
    await holdAll(page, '**/v1/fits/25H7/s6');
    await page.click('.preferred button:has-text("H7/s6")');
    await page.waitForSelector('.limits', { state: 'hidden' });
    await waits(page);
    await page.fill('#fit', '25 H7/');
    await page.press('#fit', 'Enter');
    await waits(page, false);
    assert.notEqual(await page.textContent('.fit .note'), '');
    // Nor does a change of the tables bring it back.
    const asked = [];
    page.on('request', (request) => request.url().includes('/v1/fits/') && asked.push(request.url()));
    const other = await openIn(page.context(), daemon, '#/fit/25H10/h6');
    await other.waitForSelector('.limits');
    await daemon.send('PUT', '/v1/tables/hole/classes/H10', { rows: [{ over_mm: 18, up_to_mm: 30, upper_um: 100, lower_um: -100 }] });
    await other.waitForFunction(() => /\+100 \/ −100/.test(document.querySelector('.result').textContent));
    await drawn(page);
    assert.deepEqual([asked, await page.$('.limits')], [[], null]);
    await daemon.send('DELETE', '/v1/tables/hole/classes/H10');
  });

  it('draws a zone where the deviations say, to scale', async () => {
    page = await open(browser, daemon, '#/fit/25H7/k6');
    await page.waitForSelector('.zones .shaft rect');
    const [hole, shaft, zero] = await page.$$eval('.zones .hole rect, .zones .shaft rect, .zones .zero',
      (shapes) => shapes.map((shape) => shape.getBBox()).map(({ y, height }) => ({ y, height })));
    assert.ok(Math.abs(hole.y + hole.height - zero.y) < 0.2); // H begins at zero
    assert.ok(Math.abs(shaft.height / hole.height - 13 / 21) < 0.01);
    assert.ok(Math.abs((zero.y - shaft.y - shaft.height) / hole.height - 2 / 21) < 0.01);
  });

  const bothMaps = () => page.waitForFunction(() => document.querySelectorAll('.class-zones :checked').length === 2);
  const chosen = () => page.$$eval('.class-zones label:has(:checked)', (zones) => zones.map((zone) => [...zone.querySelectorAll('span')].map((each) => each.textContent).join()));

  it('offers the classes of the size that was typed last, however late the answer for another comes', async () => {
    page = await open(browser, daemon, '#/fit/25H7/g6');
    await bothMaps();
    const shafts = '**/v1/tables/shaft?*';
    const type = async (fit) => {
      await page.fill('#fit', fit);
      await page.press('#fit', 'Enter');
    };
    let go;
    await page.route(shafts, async (route) => {
      if (!go) await new Promise((resolve) => { go = resolve; });
      await route.continue();
    });
    const asked = page.waitForRequest(shafts);
    await type('132,5 H7/g6');
    const first = await asked;
    const [second] = await Promise.all([page.waitForRequest(shafts), type('25 H7/g6')]);
    await second.response();
    const late = page.waitForResponse((answer) => answer.request() === first);
    go();
    await late;
    await drawn(page);
    assert.deepEqual(await chosen(), ['H,+21,0', 'g,−7,−20']);
  });

  it('says why it does not offer those of another grade, and offers them once the service answers', async () => {
    page = await open(browser, daemon, '#/fit/25H7/g6');
    await page.waitForSelector('.class-map:first-child .class-zones :checked');
    await page.route('**/v1/tables/hole?*', (route) => route.abort());
    await page.selectOption('.class-map:first-child select', '6');
    const noted = (is) => page.waitForFunction((wanted) => (document.querySelector('.fit .note').textContent !== '') === wanted, is);
    await noted(true);
    await page.unroute('**/v1/tables/hole?*');
    await noted(false);
    await page.selectOption('.class-map:first-child select', '6');
    await page.waitForFunction(() => document.querySelector('.class-map:first-child [value="H6"]'));
  });

  it('offers every class of the size, also by the arrow keys', async () => {
    page = await open(browser, daemon, '#/fit/25H7/g6');
    await bothMaps();
    // Each zone with its deviations, in letters one can read.
    assert.deepEqual(await chosen(), ['H,+21,0', 'g,−7,−20']);
    assert.ok(await page.$$eval('.class-zones .um', (texts) => texts.every((text) => parseFloat(getComputedStyle(text).fontSize) >= 12)));
    await page.focus('.class-map:nth-child(2) input:checked');
    await page.keyboard.press('ArrowRight');
    await page.waitForFunction(() => decodeURIComponent(location.hash) === '#/fit/25H7/h6');
    await page.waitForFunction(() => document.activeElement.value === 'h6');
    await page.fill('#fit', '132,5 P7/h6');
    await page.press('#fit', 'Enter');
    await page.waitForFunction(() => document.querySelector('.fit .headline')?.textContent === 'Interference fit');
    assert.equal(hash(), '#/fit/132.5P7/h6');
    await page.fill('#fit', '25 H7');
    await page.press('#fit', 'Enter');
    assert.notEqual(await page.textContent('.fit .note'), '');
  });
});

describe('the tables', () => {
  it('are searched by size and class, and copied as CSV', async () => {
    page = await open(browser, daemon, '#/tables/hole?find=25+H7');
    await page.waitForSelector('.grid td');
    assert.deepEqual(await page.$$eval('.grid tbody tr', (rows) => rows.map((row) => row.textContent)), ['2430+210']);
    await page.click('text=Copy as CSV');
    await page.waitForFunction(() => (document.querySelector('.tables .note')?.textContent ?? '') !== '');
    assert.equal(await pasted(page), 'over_mm,up_to_mm,H7_upper_um,H7_lower_um\n24,30,21,0\n');
    await page.fill('#find', 'JS');
    await page.waitForFunction(() => document.querySelectorAll('.grid thead th').length === 22);
    assert.equal((await page.$$('.grid tbody tr')).length, 41);
    await page.fill('#find', 'Q9');
    await page.waitForFunction(() => !document.querySelector('.grid'));
  });

  it('name the word that is no class, and too many classes', async () => {
    page = await open(browser, daemon, '#/tables/hole?find=25+H7');
    const note = () => page.textContent('.tables .note');
    await page.waitForSelector('.grid td');
    for (const [search, said] of [['25 H7 Q9', 'This table does not have Q9.'], ['25 H JS', '40 classes are too many. Name at most 24.'],
      ['M10-6H', 'This table does not have M10-6H.']]) {
      await page.fill('#find', search);
      await page.waitForFunction(() => !document.querySelector('.grid'));
      assert.equal(await note(), said);
      // A size, its sign and unit, both sides of a fit, and a list with commas.
      await page.fill('#find', 'Ø 25 mm H7, JS7; K7/g6 132,5/P9');
      await page.waitForSelector('.grid td');
      assert.equal(await note(), '');
      assert.deepEqual(await page.$$eval('.grid thead th', (heads) => heads.slice(2).map((head) => head.textContent)), ['H7', 'JS7', 'K7', 'P9']);
    }
  });

  for (const [address, where, table, copy] of [
    ['#/tables/hole?find=25+H7', /\/v1\/tables\/hole\?classes=H7$/, '.grid', 'text=Copy as CSV'],
    ['#/fit/25H7/g6', '**/v1/fits/25H7/g6', '.limits', '.limits button[aria-label="Copy 25 H7 for a drawing"]'],
  ]) {
    it(`say at ${address} that they were copied also when they are asked for anew`, async () => {
      page = await open(browser, daemon, address);
      await page.waitForSelector(table);
      const go = await holdAll(page, where);
      const asked = page.waitForRequest(where);
      await daemon.send('PUT', '/v1/tables/hole/classes/COPY', { rows: [{ over_mm: 18, up_to_mm: 30, upper_um: 9, lower_um: 1 }] });
      await asked;
      await page.click(copy);
      const said = await page.waitForFunction(() => /copied/.test(document.querySelector('.desk .note').textContent) && document.querySelector('.desk .note').textContent);
      await page.$eval(table, (old) => old.setAttribute('data-before', ''));
      go();
      await page.waitForSelector(`${table}:not([data-before])`);
      assert.equal(await page.textContent('.desk .note'), await said.jsonValue());
      await daemon.send('DELETE', '/v1/tables/hole/classes/COPY');
    });
  }

  it('keep the case of a class: g6 is no hole', async () => {
    page = await open(browser, daemon, '#/tables/hole?find=25g6');
    await page.waitForFunction(() => /g6 is a shaft class/.test(document.querySelector('.tables .note')?.textContent));
    assert.equal(await page.$('.grid'), null);
    await page.click('text=Shafts');
    await page.waitForSelector('.grid td');
    assert.deepEqual(await page.$$eval('.grid tbody tr', (rows) => rows.map((row) => row.textContent)), ['2430−7−20']);
  });

  it('ask before a class of the standard is replaced, and mark it afterwards', async () => {
    page = await open(browser, daemon, '#/tables/hole?find=25+H8');
    await page.waitForSelector('.own-list');
    await page.click('.own summary');
    await page.fill('.own input', 'H8');
    await page.fill('.own textarea', '18; 30; +100; -100');
    await page.click('.own button[type="submit"]');
    await page.click('dialog button:has-text("Cancel")');
    assert.equal((await daemon.json('/v1/limits/25H8')).basis, 'iso286');
    await page.click('.own button[type="submit"]');
    await page.click('dialog button:has-text("Replace the ISO class")');
    await page.waitForSelector('.own-list >> text=H8');
    await page.waitForSelector('.grid .own-column');
    assert.equal((await daemon.json('/v1/limits/25H8')).basis, 'custom');
    await page.click('.own-list [aria-label]');
    await page.waitForFunction(() => document.querySelector('.own-list') && !/H8/.test(document.querySelector('.own-list').textContent));
    assert.equal((await daemon.json('/v1/limits/25H8')).basis, 'iso286');
  });

  it('change on every screen when a column is stored elsewhere', async () => {
    const screens = [
      ['#/gauge/25H9', () => /25\.000 to 25\.052/.test(document.querySelector('.echo')?.textContent), () => /24\.900 to 25\.100/.test(document.querySelector('.echo')?.textContent)],
      ['#/fit/25H9/h6', () => /\+52 \/ 0/.test(document.querySelector('.result')?.textContent), () => /\+100 \/ −100/.test(document.querySelector('.result')?.textContent)],
      ['#/tables/hole?find=25+H9', () => document.querySelector('.grid td span')?.textContent === '+52', () => document.querySelector('.grid td span')?.textContent === '+100'],
    ];
    const pages = [];
    for (const [address, standard] of screens) {
      pages.push(await open(browser, daemon, address));
      await pages.at(-1).waitForFunction(standard);
    }
    const column = { rows: [{ over_mm: 18, up_to_mm: 30, upper_um: 100, lower_um: -100 }] };
    await daemon.send('PUT', '/v1/tables/hole/classes/H9', column);
    for (const [i, [, , changed]] of screens.entries()) await pages[i].waitForFunction(changed);
    await daemon.send('DELETE', '/v1/tables/hole/classes/H9');
    for (const [i, [, standard]] of screens.entries()) await pages[i].waitForFunction(standard);
    page = pages.pop();
    for (const other of pages) await close(other);
  });

  it('take columns of the shop’s own and give them back', async () => {
    page = await open(browser, daemon, '#/tables/shaft');
    await page.waitForSelector('.own-list');
    await page.click('.own summary');
    await page.fill('.own input', 'press1');
    await page.fill('.own textarea', '18; 30; -3,5; -10\n30; 50; oops; 1');
    await page.click('.own button[type="submit"]');
    await page.waitForFunction(() => /oops/.test(document.querySelector('.own .note')?.textContent));
    await page.fill('.own textarea', '18; 30; -3,5; -10\n30\t50\t-4\t-12');
    await page.click('.own button[type="submit"]');
    await page.waitForSelector('.own-list >> text=press1');
    // What went well is not said in the colour of errors.
    assert.match(await page.textContent('.own .note[role="status"]'), /press1 is stored/);
    assert.equal(await page.$eval('.own .note', (note) => getComputedStyle(note).color), await page.$eval('.own h2', (title) => getComputedStyle(title).color));
    const limits = await daemon.json('/v1/limits/25press1');
    assert.deepEqual([limits.upper_deviation_um, limits.lower_deviation_um, limits.basis], [-3.5, -10, 'custom']);
    await page.click('.own-list [aria-label]');
    await page.waitForFunction(() => document.querySelector('.own-list') && !/press1/.test(document.querySelector('.own-list').textContent));
    assert.equal((await fetch(`${daemon.url}/v1/limits/25press1`)).status, 404);
  });
});
