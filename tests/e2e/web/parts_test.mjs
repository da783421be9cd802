/**
 * Parts: their records, and what is saved of them.
 *
 * Tried, and held here:
 * - Press *Store* twice at a note; give it up while it is on its way; lose the answer and press again: one; nothing
 *   is given up before the answer; one
 */

import assert from 'node:assert/strict';
import { afterEach, describe, it } from 'node:test';

import { close, drawn, findings, hashOf, open, openIn, picture, saved, timer } from './support/browser.mjs';
import { Daemon } from './support/daemon.mjs';
import { holdAll } from './support/hold.mjs';
import { scan } from './support/scanner.mjs';
import { browser, daemon } from './support/stage.mjs';

let page;

afterEach(() => close(page));

const hash = () => hashOf(page);

describe('the parts', () => {
  it('answer show me part SN-17: every characteristic with its corrections', async () => {
    const record = await (await daemon.send('POST', '/v1/measurements', { designation: '25 H7', measured_mm: '25.05', part_id: 'SN-17', characteristic: 'bore-A', order: 'WO-9', gauge: 'G-07', uncertainty_um: '0.8' })).json();
    await daemon.send('POST', '/v1/measurements', Array.from({ length: 70 }, (_, i) => ({ designation: '25 H7', measured_mm: '25.01', part_id: `SN-1${i}x`, order: 'WO-9' })));
    await daemon.send('POST', `/v1/measurements/${record.id}/corrections`, { measured_mm: '25.005', reason: 'slipped' });
    await daemon.send('POST', '/v1/measurements', { nominal_mm: 8, feature: 'hole', upper_um: 36, lower_um: 0, measured_mm: '8.05', part_id: 'SN-17', characteristic: 'slot', order: 'WO-9' });
    page = await open(browser, daemon, '#/parts?order=WO-9');
    await page.waitForFunction(() => document.querySelectorAll('.records tbody tr').length === 50);
    await page.$eval('.records tbody tr:last-child', (row) => row.scrollIntoView()); // goes on where its end comes into sight
    await page.waitForFunction(() => document.querySelectorAll('.records tbody tr').length === 72);
    assert.match(await page.textContent('.records tbody tr'), /SN-17.*slot/); // the newest first
    await page.click('.records a:has-text("SN-17")');
    await page.waitForFunction(() => document.querySelectorAll('.records tbody tr').length === 3);
    assert.equal(hash(), '#/parts?part_id=SN-17&history=all');
    const history = await page.$$eval('.records tbody tr', (all) => all.map((row) => [row.className, row.textContent]));
    assert.deepEqual(history.map(([name]) => name), ['', '', 'corrected']);
    assert.match(history[1][1], /correction.*slipped/);
    assert.match(history[2][1], /Reject.*25\.050/);
  });

  it('have the runs that measured them in the same history, each with the way to it', async () => {
    const cycle = ['TCH PROBE 427 MEASURE COORDINATE', 'Q263=+50', 'Q264=+40', 'Q261=+0', 'Q320=+0', 'Q272=+3', 'Q267=-1', 'Q260=+50', 'Q281=+0', 'Q288=+0.1', 'Q289=-0.1', 'Q309=+0', 'Q330=+0'].join(' ~\n  ');
    await daemon.send('PUT', '/v1/files/nc_prog/427.h', `BEGIN PGM 427 MM\nTOOL CALL 30 Z\n${cycle}\nEND PGM 427 MM\n`, 'text/plain');
    await daemon.send('PUT', '/v1/setups/plate', { workpiece: { features: [{ type: 'block', min_mm: [0, 0, -40], max_mm: [100, 80, 0.02] }] } });
    await daemon.send('POST', '/v1/measurements', { designation: '25 H7', measured_mm: '25.01', part_id: 'SN-R', characteristic: 'by hand' });
    page = await open(browser, daemon, '#/programs/nc_prog/427.h?setup=plate');
    await page.waitForFunction(() => document.querySelector('.run select')?.value === 'plate');
    await page.click('.run .of-more summary');
    await page.fill('.run [name="part_id"]', ' SN-R');
    await page.fill('.run [name="order"]', 'WO-R');
    await page.click('.run button[type="submit"]');
    await page.waitForSelector('.report .headline:has-text("Completed")');
    const ran = /run=([^&]+)/.exec(hash())[1];
    const [{ run_id: run, order, source }] = await daemon.stored('part_id=SN-R&source=simulation');
    assert.deepEqual([run, order, source], [ran, 'WO-R', 'simulation']);
    await page.evaluate(() => { location.hash = '#/parts?part_id=SN-R&history=all'; });
    await page.waitForFunction(() => /427\.h · Completed/.test(document.querySelector('.records .run')?.textContent));
    const rows = await page.$$eval('.records tbody tr', (all) => all.map((each) => each.className || each.children[1].textContent));
    assert.deepEqual(rows, ['run', 'Coordinate', 'by handØ 25 H7']);
    assert.match(await page.textContent('.records tbody tr:nth-child(2)'), /simulated/);
    assert.deepEqual(await findings(page), []);
    await picture(page, 'parts-run', { fullPage: true });
    await page.click('.records .run a');
    await page.waitForSelector('.report .headline:has-text("Completed")');
    assert.match(await page.textContent('.title'), /427\.h/);
  });

  it('say what a part comes to by its plan, of the parts in sight alone, and what is still to be measured', async () => {
    await daemon.send('PUT', '/v1/plans/4713-A', { characteristics: [{ name: 'v-bore', designation: '25 H7', reaction: 'Stop, tell the setter' }, { name: 'v-slot', designation: '40 H8' }] });
    const of = (part_id, characteristic, measured_mm) => ({ designation: characteristic === 'v-bore' ? '25 H7' : '40 H8', characteristic, measured_mm, part_id, order: 'WO-V' });
    await daemon.send('POST', '/v1/measurements', [
      ...Array.from({ length: 40 }, (_, i) => [of(`V-OLD-${i}`, 'v-bore', '25.010'), of(`V-OLD-${i}`, 'v-slot', '40.010')]).flat(),
      of('V-GOOD', 'v-bore', '25.010'), of('V-GOOD', 'v-slot', '40.010'), of('V-BAD', 'v-bore', '25.040'), of('V-BAD', 'v-slot', '40.010'), of('V-HALF', 'v-bore', '25.010'),
    ]);
    page = await open(browser, daemon, '#/overview');
    const asked = [];
    page.on('request', (request) => { const part = /\/v1\/parts\/(.+)/.exec(request.url()); if (part) asked.push(part[1]); });
    await page.evaluate(() => { location.hash = '#/parts?order=WO-V'; });
    const said = (part) => page.waitForFunction((name) => [...document.querySelectorAll('.records tbody tr')].find((row) => row.cells[0].firstChild.textContent === name)?.querySelector('.of-part').textContent, part).then((text) => text.jsonValue());
    assert.equal(await said('V-HALF'), 'Not complete · 1 missing');
    assert.equal(await said('V-BAD'), 'Reject · 1 to be done');
    assert.equal(await said('V-GOOD'), 'Good');
    // Of the two rows of a part one says it; far rows are not asked for, near ones once.
    assert.deepEqual(await page.$$eval('.records tbody tr', (rows) => rows.slice(0, 5).map((row) => row.querySelector('.of-part').checkVisibility())), [true, true, false, true, false]);
    await page.waitForFunction(() => [...document.querySelectorAll('.records .of-part')].every((place) => {
      const { top, bottom } = place.getBoundingClientRect();
      const { bottom: end } = document.querySelector('.records').getBoundingClientRect();
      return !place.checkVisibility() || top > end || place.textContent || bottom < 0;
    }));
    assert.equal(new Set(asked).size, asked.length, asked.join());
    assert.ok(asked.length < 30 && !asked.includes('V-OLD-0'), asked.join());
    await picture(page, 'parts-verdicts');
    await page.click('.records a >> text=V-HALF');
    await page.waitForFunction(() => /V-HALF · Not complete/.test(document.querySelector('.part-verdict')?.textContent));
    assert.match(await page.textContent('.part-verdict'), /1 measured · checked against plan 4713-A.*Not measured yet: v-slot\..*Measure it/);
    assert.deepEqual(await findings(page), []);
    await page.fill('[name="part_id"]', 'V-BAD');
    await page.press('[name="part_id"]', 'Enter');
    await page.waitForFunction(() => /V-BAD · Reject.*v-bore Stop, tell the setter/.test(document.querySelector('.part-verdict')?.textContent));
    assert.equal(await page.getAttribute('.part-verdict', 'data-verdict'), 'reject');
    await picture(page, 'part-verdict');
    const [{ id }] = await daemon.stored('part_id=V-BAD&characteristic=v-bore');
    await page.getByRole('button', { name: 'Add a note to 25.040 mm of V-BAD' }).click();
    await page.fill('dialog [name="cause"]', 'Insert worn');
    await page.click('dialog .primary');
    await page.waitForFunction(() => !/Stop/.test(document.querySelector('.part-verdict')?.textContent), id);
    await page.fill('[name="part_id"]', 'V-HALF');
    await page.press('[name="part_id"]', 'Enter');
    await page.click('.part-verdict a');
    await page.waitForFunction(() => document.querySelector('.tiles-of-plan [aria-current]')?.textContent.includes('v-'));
    assert.match(decodeURIComponent(hashOf(page)), /^#\/gauge\b(?=.*part_id=V-HALF).*plan=4713-A/);
  });

  it('say beside a good verdict that no GO gauge has verified the envelope', async () => {
    await daemon.send('PUT', '/v1/plans/4716-A', { characteristics: [{ name: 'h-bore', designation: '25 H7(E)' }, { name: 'h-pin', designation: '25 H7(E)' }] });
    await daemon.send('POST', '/v1/measurements', ['H-1', 'H-2'].flatMap((part_id, i) => [['h-bore', i ? 'passes' : undefined], ['h-pin', 'passes']].map(([characteristic, go_gauge]) => ({ designation: '25 H7(E)', measured_mm: '25.01', part_id, characteristic, order: 'WO-H', go_gauge }))));
    page = await open(browser, daemon, '#/parts?order=WO-H');
    await page.waitForFunction(() => document.querySelector('.of-part[data-part="H-1"]')?.textContent === 'Good · envelope not verified' && document.querySelector('.of-part[data-part="H-2"]').textContent === 'Good');
    assert.deepEqual(await page.$$eval('.records tbody td:nth-child(3)', (all) => all.map(({ textContent }) => textContent)), ['Good', 'Good', 'Good', 'Goodenvelope not verified']);
    for (const [part, said] of [['H-1', 'No GO gauge has verified the envelope: h-bore.'], ['H-2', '']]) {
      await page.fill('[name="part_id"]', part);
      await page.press('[name="part_id"]', 'Enter');
      await page.waitForFunction((wanted) => document.querySelector('.part-verdict .headline')?.textContent === wanted, `${part} · Good`);
      assert.equal(await page.$$eval('.part-verdict .missing', ([line]) => line?.textContent ?? ''), said);
    }
  });

  it('let a GO gauge that does not pass stand beside a later value without it', async () => {
    for (const [characteristic, go_gauge] of [['h-bore', 'fails'], ['h-bore', undefined], ['h-pin', 'passes']]) await daemon.send('POST', '/v1/measurements', { designation: '25 H7(E)', measured_mm: '25.01', part_id: 'H-3', characteristic, go_gauge });
    page = await open(browser, daemon, '#/parts?part_id=H-3');
    await page.waitForFunction(() => document.querySelector('.part-verdict .headline')?.textContent === 'H-3 · Rework');
    assert.deepEqual(await page.$$eval('.part-verdict p:not(.headline, .aside)', (all) => all.map(({ textContent }) => textContent)), ['2 measured · checked against plan 4716-A', 'The GO gauge does not pass: h-bore.']);
  });

  it('show what is stored, corrected and noted elsewhere', async () => {
    await daemon.send('PUT', '/v1/plans/4717-A', { characteristics: [{ name: 'l-a', designation: '25 H7' }, { name: 'l-b', designation: '25 H7', reaction: 'Stop' }] });
    const measure = async (part_id, characteristic, measured_mm) => (await daemon.send('POST', '/v1/measurements', { designation: '25 H7', characteristic, measured_mm, part_id, order: 'WO-LIVE' })).json();
    const rows = (...wanted) => page.waitForFunction((texts) => {
      const shown = [...document.querySelectorAll('.records tbody tr')].map(({ cells }) => `${cells[0].textContent} ${cells[3].textContent}`);
      return shown.join() === texts.join();
    }, wanted);
    page = await open(browser, daemon, '#/parts?order=WO-LIVE');
    await page.waitForFunction(() => /No measurements match/.test(document.querySelector('.parts .note').textContent));
    await measure('L-1', 'l-a', '25.01');
    await rows('L-1Not complete · 1 missing 25.010');
    assert.equal(await page.textContent('.parts .note'), '');
    await page.evaluate(() => {
      const body = document.querySelector('.records tbody');
      globalThis.first = body.rows[0];
      globalThis.emptied = 0;
      new MutationObserver(() => { globalThis.emptied += body.rows.length ? 0 : 1; }).observe(body, { childList: true });
    });
    const bad = await measure('L-1', 'l-b', '25.04');
    await measure('L-2', 'l-a', '25.012');
    await rows('L-2Not complete · 1 missing 25.012', 'L-1Reject · 1 to be done 25.040', 'L-1Reject · 1 to be done 25.010');
    assert.ok(await page.evaluate(() => document.contains(globalThis.first)), 'rows that are there stay');
    await daemon.send('POST', `/v1/measurements/${bad.id}/notes`, { cause: 'Insert worn' });
    await page.waitForFunction(() => /Insert worn/.test(document.querySelector('.records tbody').textContent));
    await daemon.send('POST', `/v1/measurements/${bad.id}/corrections`, { measured_mm: '25.014', reason: 'misread' });
    await rows('L-1Good 25.014', 'L-2Not complete · 1 missing 25.012', 'L-1Good 25.010');
    assert.equal(await page.evaluate(() => globalThis.emptied), 0, 'the list is never empty while it is read again');
    await page.fill('.parts [name="part_id"]', 'L-2');
    await page.press('.parts [name="part_id"]', 'Enter');
    await page.waitForFunction(() => /L-2 · Not complete/.test(document.querySelector('.part-verdict')?.textContent));
    await measure('L-1', 'l-a', '25.02');
    await measure('L-2', 'l-b', '25.013');
    await page.waitForFunction(() => /L-2 · Good/.test(document.querySelector('.part-verdict')?.textContent));
    await page.waitForFunction(() => [...document.querySelectorAll('.records tbody td:nth-child(4)')].map(({ textContent }) => textContent).join() === '25.013,25.012');
  });

  it('are found by verdict, also those that are not judged', async () => {
    await daemon.send('POST', '/v1/measurements', [{ quantity: 'position', nominal_mm: 40, measured_mm: '40.01', part_id: 'N-1', order: 'WO-N' }, { designation: '25 H7', measured_mm: '25.01', part_id: 'N-2', order: 'WO-N' }]);
    page = await open(browser, daemon, '#/parts?order=WO-N');
    await page.waitForFunction(() => document.querySelectorAll('.records tbody tr').length === 2);
    await page.selectOption('[name="verdict"]', { label: 'Not judged' });
    await page.waitForFunction(() => /^N-1.*Not judged40\.010\+10 µm–/.test(document.querySelector('.records tbody tr')?.textContent) && document.querySelectorAll('.records tbody tr').length === 1);
    assert.match(hash(), /verdict=unjudged/);
    await page.reload();
    await page.waitForFunction(() => document.querySelectorAll('.records tbody tr').length === 1);
    assert.equal(await page.$eval('[name="verdict"]', ({ selectedOptions: [{ textContent }] }) => textContent), 'Not judged');
  });

  it('say what was noted and corrected between their reading and the begin of the stream', async () => {
    const send = async (path, body) => (await daemon.send('POST', path, body)).json();
    const [{ id: noted }, { id: corrected }] = [await send('/v1/measurements', { designation: '25 H7', measured_mm: '25.03', part_id: 'B-1', order: 'WO-B' }), await send('/v1/measurements', { designation: '25 H7', measured_mm: '25.04', part_id: 'B-2', order: 'WO-B' })];
    page = await open(browser, daemon, '#/style');
    await page.evaluate(() => { SharedWorker = undefined; }); // the driver holds no question of a worker
    for (const [path, body, text] of [[`${noted}/notes`, { text: 'by hand' }, /by hand/], [`${corrected}/corrections`, { measured_mm: '25.012', reason: 'slipped' }, /slipped/]]) {
      const go = await holdAll(page, '**/v1/events');
      await page.evaluate(() => { location.hash = '#/parts?order=WO-B'; });
      await page.waitForFunction(() => document.querySelectorAll('.records tbody tr').length === 2);
      await send(`/v1/measurements/${path}`, body);
      go();
      await page.waitForFunction((wanted) => new RegExp(wanted).test(document.querySelector('.records tbody')?.textContent) && document.querySelectorAll('.records tbody tr').length === 2, text.source);
      await page.unroute('**/v1/events');
      await page.evaluate(() => { location.hash = '#/style'; });
      await page.waitForSelector('.records', { state: 'detached' });
    }
  });

  it('wait for a cause where the plan names a catalogue alone', async () => {
    await daemon.send('PUT', '/v1/catalogues/k', { causes: ['Insert worn'], measures: ['Insert changed'] });
    await daemon.send('PUT', '/v1/plans/4714-A', { characteristics: [{ name: 'k-bore', designation: '25 H7', catalogue: 'k' }] });
    await daemon.send('POST', '/v1/measurements', { designation: '25 H7', characteristic: 'k-bore', measured_mm: '25.04', part_id: 'K-BAD' });
    page = await open(browser, daemon, '#/parts?part_id=K-BAD');
    await page.waitForFunction(() => /k-bore Give cause and action/.test(document.querySelector('.part-verdict ul')?.textContent));
  });

  it('come to nothing good without a plan, and are asked for again when there was no answer', async () => {
    const of = (part_id, characteristic, measured_mm) => ({ designation: '25 H7', characteristic, measured_mm, part_id, order: 'WO-F' });
    await daemon.send('POST', '/v1/measurements', [of('F-3', 'f-a', '25.010'), ...Array.from({ length: 40 }, (_, i) => of(`F-OLD-${i}`, 'f-a', '25.010')),
      of('F-3', 'f-b', '25.040'), of('F-2', 'f-a', '25.010'), of('F-2', 'f-b', '25.040'), of('F-1', 'f-a', '25.010'), of('F-1', 'f-b', '25.010')]);
    page = await open(browser, daemon, '#/overview');
    await page.route('**/v1/parts/F-2', (route) => route.abort());
    const answers = [page.waitForResponse(/\/v1\/parts\/F-1$/), page.waitForEvent('requestfailed', (request) => /\/v1\/parts\/F-2$/.test(request.url()))];
    await page.evaluate(() => { location.hash = '#/parts?order=WO-F'; });
    await Promise.all(answers);
    await page.unroute('**/v1/parts/F-2');
    await page.waitForFunction(() => document.querySelector('.of-part[data-part="F-3"]')?.textContent === 'Reject');
    // Its first place is seen to leave: a list that goes and comes back between two frames never moved.
    await page.$eval('.records', (list) => new Promise((left) => {
      list.scrollTo(0, list.scrollHeight);
      new IntersectionObserver(([{ isIntersecting }]) => !isIntersecting && left(), { root: list }).observe(list.querySelector('[data-part="F-2"]'));
    }));
    await page.waitForFunction(() => document.querySelector('.records tbody').lastElementChild.querySelector('.of-part[data-part="F-3"]')?.textContent === 'Reject');
    await page.$eval('.records', (list) => list.scrollTo(0, 0));
    const places = (part) => page.$$eval('.records .of-part', (all, name) => all.filter(({ dataset }) => dataset.part === name).map((place) => [place.textContent, place.querySelectorAll('.shape').length]), part);
    await page.waitForFunction(() => document.querySelector('.of-part[data-part="F-2"]')?.textContent === 'Reject');
    assert.deepEqual((await places('F-1'))[0], ['', 0]);
    await page.fill('[name="part_id"]', 'F-1');
    await page.press('[name="part_id"]', 'Enter');
    await page.waitForFunction(() => document.querySelector('.part-verdict .headline')?.textContent === 'F-1');
    assert.match(await page.textContent('.part-verdict'), /2 measured · not checked against a plan/);
    assert.equal(await page.$('.part-verdict > .shape'), null);
  });

  it('are corrected, value or part, with the reason, and not by mistake', async () => {
    await daemon.send('POST', '/v1/measurements', ['25.01', '25.012'].map((text) => ({ designation: '25 H7', measured_mm: text, part_id: 'SN-C', order: 'WO-C' })));
    page = await open(browser, daemon, '#/parts?order=WO-C');
    const said = (text) => page.waitForFunction((source) => new RegExp(source).test(document.querySelector('dialog .note')?.textContent), text);
    await page.getByRole('button', { name: 'Correct 25.010 mm of SN-C' }).click();
    await page.click('dialog .primary');
    await said('have not changed');
    await page.getByLabel('Measured value').fill('0.98');
    await page.click('dialog .primary');
    await said('Enter the reason');
    await page.getByLabel('Reason').fill('scanned twice');
    await page.click('dialog .primary');
    await said('far outside');
    await page.getByLabel('Measured value').fill('25.01x');
    await page.click('dialog .primary');
    await said('not a value');
    await page.getByLabel('Measured value').fill('25,01');
    await page.locator('dialog').getByLabel('Part').fill('SN-D');
    assert.deepEqual(await findings(page), []);
    await page.click('dialog .primary');
    await page.waitForSelector('.records a:has-text("SN-D")');
    const [old, , corrected] = await daemon.stored('order=WO-C&history=all');
    assert.deepEqual([corrected.part_id, corrected.measured_mm, corrected.correction_of, corrected.reason], ['SN-D', 25.01, old.id, 'scanned twice']);
    // The stream tells of the correction too: then the list is read once more.
    await page.waitForFunction(() => document.querySelectorAll('.records tbody tr').length === 2);
    await page.getByLabel('Also corrected values').check();
    await page.waitForFunction(() => document.querySelectorAll('.records tbody tr').length === 3);
    assert.equal(await page.locator('.records .corrected').getByRole('button', { name: 'Correct' }).count(), 0);
    await picture(page, 'parts-corrected', { fullPage: true });
  });

  it('take no value and no scan of something else as a reason or a part, and find a part by its scan', async () => {
    await daemon.send('POST', '/v1/measurements', { designation: '25 H7', measured_mm: '25.01', part_id: 'SN-W', order: 'WO-W' });
    page = await open(browser, daemon, '#/parts');
    for (const code of ['P:SN-W', ']C1SN-W', ']C1P:SN-W']) {
      await page.fill('.parts [name="part_id"]', code);
      await page.press('.parts [name="part_id"]', 'Enter');
      await page.waitForFunction(() => /^#\/parts\?part_id=SN-W/.test(location.hash) && document.querySelectorAll('.records tbody tr').length === 1);
      assert.equal(await page.inputValue('.parts [name="part_id"]'), 'SN-W');
      await page.fill('.parts [name="part_id"]', '');
      await page.press('.parts [name="part_id"]', 'Enter');
      await page.waitForFunction(() => !/part_id/.test(location.hash));
    }
    // A prefix of letters may be of the name.
    await page.evaluate(() => localStorage.setItem('fitgauge.prefixes', JSON.stringify({ part_id: 'S' })));
    await page.fill('.parts [name="part_id"]', 'SN-W');
    await page.press('.parts [name="part_id"]', 'Enter');
    await page.waitForFunction(() => /^#\/parts\?part_id=/.test(location.hash));
    assert.equal(await page.inputValue('.parts [name="part_id"]'), 'SN-W');
    await page.evaluate(() => localStorage.removeItem('fitgauge.prefixes'));
    await page.fill('.parts [name="part_id"]', '');
    await page.press('.parts [name="part_id"]', 'Enter');
    await page.fill('.parts [name="order"]', 'O:WO-W');
    await page.press('.parts [name="order"]', 'Enter');
    await page.waitForFunction(() => /order=WO-W/.test(location.hash) && document.querySelectorAll('.records tbody tr').length === 1);
    const refused = async (field, text, why) => {
      await page.locator('dialog').getByLabel(field).fill(text);
      await page.$eval('dialog .note', (note) => { note.textContent = ''; });
      await page.click('dialog .primary');
      await page.waitForFunction((source) => new RegExp(source).test(document.querySelector('dialog .note').textContent), why);
    };
    await page.click('.records tbody .quiet >> text=Correct');
    await refused('Part', '25.012', '“25\\.012” is a value, not a name');
    await refused('Part', 'O:WO-W', 'belongs to another field');
    await page.locator('dialog').getByLabel('Part').fill('P:SN-V');
    await refused('Reason', '25.012', 'is a value. Enter words');
    await refused('Reason', 'P:SN-W', 'belongs to another field');
    await page.locator('dialog').getByLabel('Reason').fill('scanned twice');
    await page.click('dialog .primary');
    await page.waitForFunction(() => /SN-V/.test(document.querySelector('.records tbody').textContent));
    await page.click('.records tbody .quiet >> text=Note');
    for (const label of ['Cause', 'Action', 'Text']) {
      await refused(label, '01A+00025.012', 'is a value. Enter words');
      await page.locator('dialog').getByLabel(label).fill('');
    }
    await page.$eval('dialog .note', (note) => { note.textContent = ''; });
    await page.focus('dialog [name="cause"]');
    await scan(page, 'SN-17');
    await page.waitForFunction(() => /belongs to another field/.test(document.querySelector('dialog .note').textContent));
    await page.fill('dialog [name="cause"]', 'Insert 3 worn');
    await refused('Operator', `fg_${'0'.repeat(64)}`, 'belongs to another field');
    await page.fill('dialog [name="operator"]', 'U:Kim');
    await page.click('dialog .primary');
    await page.waitForFunction(() => /Insert 3 worn · Kim/.test(document.querySelector('.records tbody').textContent));
    assert.deepEqual((await daemon.stored('order=WO-W&notes=shown')).map(({ part_id, reason, notes }) => [part_id, reason, notes?.map(({ cause, operator }) => [cause, operator])]), [['SN-V', 'scanned twice', [['Insert 3 worn', 'Kim']]]]);
  });

  it('keep the button that is pressed, whatever is noted elsewhere meanwhile', async () => {
    const record = await (await daemon.send('POST', '/v1/measurements', { designation: '25 H7', measured_mm: '25.01', part_id: 'SN-U', order: 'WO-U' })).json();
    page = await open(browser, daemon, '#/parts?order=WO-U');
    const elsewhere = (text) => daemon.send('POST', `/v1/measurements/${record.id}/notes`, { text });
    const isNoted = (one, text) => one.waitForFunction((noted) => document.querySelector('.records tbody tr')?.textContent.includes(noted), text);
    const other = await openIn(page.context(), daemon, '#/parts?order=WO-U');
    await other.waitForSelector('.records tbody tr');
    await page.locator('.records tbody tr').getByRole('button', { name: 'Correct' }).hover();
    await page.mouse.down();
    await elsewhere('seen elsewhere');
    await isNoted(other, 'seen elsewhere');
    await timer(page, 1500);
    await page.mouse.up();
    await page.waitForSelector('dialog');
    await page.keyboard.press('Escape');
    await isNoted(page, 'seen elsewhere');
    // Where no click acts, a press holds back nothing.
    await page.hover('.records thead');
    await page.mouse.down();
    await elsewhere('seen again');
    await isNoted(page, 'seen again');
    await page.mouse.up();
  });

  it('are corrected and noted once, however often it is asked for, and whatever becomes of the answer', async () => {
    const record = await (await daemon.send('POST', '/v1/measurements', { designation: '25 H7', measured_mm: '25.01', part_id: 'SN-O', order: 'WO-O' })).json();
    page = await open(browser, daemon, '#/parts?order=WO-O');
    let asked = 0;
    let go;
    const held = new Promise((resolve) => { go = resolve; });
    await page.route(/\/(notes|corrections)$/, async (route) => {
      asked += 1;
      if (asked > 1) return route.continue();
      // The service has it, and its answer is lost.
      const { 'idempotency-key': key } = route.request().headers();
      const stored = await fetch(route.request().url(), {
        method: 'POST', body: '{"text":"looked at"}', headers: { 'Content-Type': 'application/json', 'Idempotency-Key': key },
      });
      assert.equal(stored.status, 201);
      await held;
      return route.abort();
    });
    await page.click('.records tbody tr >> text=Note');
    await page.fill('dialog [name="text"]', 'looked at');
    const press = () => page.$eval('dialog form', (form) => { form.requestSubmit(); form.requestSubmit(); });
    await press();
    await page.waitForSelector('dialog[aria-busy]');
    await page.$eval('dialog button[type="button"]', (cancel) => cancel.click());
    assert.ok(await page.isVisible('dialog'), 'nobody gives up what is stored perhaps');
    go();
    await page.waitForFunction(() => (document.querySelector('dialog .note')?.textContent ?? '') !== '');
    await press();
    await page.waitForSelector('dialog', { state: 'detached' });
    await page.waitForFunction(() => /looked at/.test(document.querySelector('.records tbody tr')?.textContent));
    await page.click('.records tbody tr >> text=Correct');
    await page.locator('dialog').getByLabel('Part').fill('SN-P');
    await page.getByLabel('Reason').fill('misread');
    await press();
    await page.waitForSelector('dialog', { state: 'detached' });
    await page.waitForSelector('.records a:has-text("SN-P")');
    assert.equal(asked, 3);
    const [old, corrected, ...others] = await daemon.stored('order=WO-O&history=all&notes=shown');
    assert.deepEqual([old.notes.length, corrected.correction_of, others], [1, record.id, []]);
  });

  it('have the service’s own certificate, of the part or the order that is shown', async () => {
    page = await open(browser, daemon, '#/parts');
    await page.waitForSelector('.records tbody tr');
    assert.ok(await page.isHidden('.certificate')); // of everything there is none
    await page.fill('[name="order"]', 'WO-9');
    await page.press('[name="order"]', 'Enter');
    await page.click('.certificate summary');
    await page.getByLabel('Company').fill('Muster GmbH & Co.');
    await page.getByLabel('Customer').fill('ACME');
    await page.getByLabel('Paper').selectOption('letter');
    await picture(page, 'certificate');
    const [sheet] = await Promise.all([
      page.context().waitForEvent('response', (answer) => answer.url().includes('/v1/certificates')),
      page.click('.certificate a'),
    ]);
    assert.equal(sheet.headers()['content-type'], 'application/pdf');
    const asked = Object.fromEntries(new URL(sheet.url()).searchParams);
    assert.deepEqual(asked, { order: 'WO-9', title: 'Inspection report', company: 'Muster GmbH & Co.', customer: 'ACME', paper: 'letter' });
    await page.reload();
    await page.waitForSelector('.records tbody tr');
    await page.click('.certificate summary');
    assert.equal(await page.getByLabel('Company').inputValue(), 'Muster GmbH & Co.'); // typed once
  });

  it('have it one touch away at the station, and the next scan is a scan again', async () => {
    page = await open(browser, daemon, '#/gauge/25H7?part_id=SN-C');
    await page.waitForSelector('.echo .figures');
    await page.keyboard.type('25.01\n');
    await page.waitForSelector('.recent .stored .fix a');
    const [sheet, opened] = await Promise.all([
      page.context().waitForEvent('response', (answer) => answer.url().includes('/v1/certificates')),
      page.context().waitForEvent('page'),
      page.click('.recent .fix a'),
    ]);
    assert.deepEqual([sheet.headers()['content-type'], new URL(sheet.url()).searchParams.get('part_id')], ['application/pdf', 'SN-C']);
    await opened.close();
    await page.keyboard.type('25.02\n');
    await page.waitForFunction(() => document.querySelectorAll('.recent .stored .fix').length === 2);
    assert.equal(page.context().pages().length, 1);
    assert.deepEqual(await findings(page), []);
    await picture(page, 'station-certificate-link');
  });
});

describe('what is saved as a file', () => {
  it('is what is shown, in every form the service writes, and a refusal is said', async () => {
    await daemon.send('POST', '/v1/measurements', ['SAVED-1', 'SAVED-2'].map((part_id) => ({ designation: '25 H7', measured_mm: '25.0131', part_id, order: 'WO-S', characteristic: 'bore' })));
    page = await open(browser, daemon, '#/parts?part_id=SAVED-1', { timezoneId: 'Europe/Berlin' });
    await page.waitForSelector('.records tbody tr');
    const save = (form) => saved(page, () => page.getByText(`Save all as ${form}`).click({ noWaitAfter: true }));
    const isSaved = async (form, name, first) => {
      const [file, bytes] = await save(form);
      assert.equal(file, name);
      assert.equal(bytes.subarray(0, first.length).toString('latin1'), first, form);
      if (form !== 'Excel') assert.equal(bytes.toString().includes('SAVED-2'), false, form);
    };
    await isSaved('Excel', 'measurements.xlsx', 'PK\x03\x04');
    await isSaved('Q-DAS', 'measurements.dfq', 'K0100 1');
    await isSaved('QIF', 'measurements.qif', '<?xml');
    await page.route('**/v1/measurements?*format=xlsx*', (route) => route.fulfill({
      status: 400, contentType: 'application/problem+json', body: '{"code":"export.too_many","detail":"a file has at most 100,000 measurements"}' }));
    await page.getByText('Save all as Excel').click();
    const refused = () => /100,000/.test(document.querySelector('.parts .note[role="alert"]').textContent);
    await page.waitForFunction(refused);
    await daemon.send('POST', '/v1/measurements', { designation: '25 H7', measured_mm: '25.0141', part_id: 'SAVED-1' });
    await page.waitForFunction(() => /25\.0141/.test(document.querySelector('.records tbody').textContent));
    await drawn(page);
    assert.ok(await page.evaluate(refused), 'it stays while the list goes on');
    await isSaved('CSV', 'measurements.csv', 'id,'); // a link alone, after which the driver of Firefox waits for a page
  });

  it('is saved with the key where one is needed', async () => {
    const locked = await new Daemon('--auth', 'read-open').start();
    const key = await locked.key('quality', 'operator');
    await fetch(`${locked.url}/v1/measurements`, {
      method: 'POST', body: '{"designation":"25 H7","measured_mm":25.02,"part_id":"SN-1"}', headers: { 'Content-Type': 'application/json', Authorization: `Bearer ${key}` } });
    page = await open(browser, locked, '#/parts');
    await page.fill('dialog input', key);
    await page.press('dialog input', 'Enter');
    await page.waitForSelector('.records tbody tr');
    for (const [view, link, what] of [['parts', 'a:has-text("Save all as CSV")', /SN-1/], ['tables', '#whole-table', /H7/]]) {
      await page.click(`#views a[href^="#/${view}"]`);
      await page.waitForSelector('.records tbody tr, .grid td');
      const [, bytes] = await saved(page, () => page.click(link, { noWaitAfter: true }));
      assert.match(String(bytes), what);
    }
    await page.click('#views a[href^="#/parts"]');
    await page.fill('[name="part_id"]', 'SN-1');
    await page.press('[name="part_id"]', 'Enter');
    await page.click('.certificate summary');
    const asked = page.waitForResponse((answer) => answer.url().includes('/v1/certificates'));
    await page.click('.certificate a');
    assert.equal((await asked).headers()['content-type'], 'application/pdf');
  });
});
