/** Connections to the world outside, made, tried and ended on the page. */

import assert from 'node:assert/strict';
import fs from 'node:fs';
import http from 'node:http';
import net from 'node:net';
import os from 'node:os';
import path from 'node:path';
import { after, afterEach, before, describe, it } from 'node:test';

import { close, findings, launch, open, picture } from './support/browser.mjs';
import { Daemon } from './support/daemon.mjs';

const FOLDER = fs.mkdtempSync(path.join(os.tmpdir(), 'fitgauge-folders-'));

let browser;
let daemon;
let page;

before(async () => {
  browser = await launch();
  daemon = await new Daemon('--connection-folders', FOLDER, '--allow-private-addresses').start();
});
after(() => fs.rmSync(FOLDER, { recursive: true }));
afterEach(() => close(page));

const field = (name) => page.locator('.schema-fields > .field').filter({ has: page.locator(`code:text-is("${name}")`) });
const fill = (name, text) => field(name).locator('input, textarea').first().fill(text);
const kinds = () => page.$$eval('[name="kind"] option', (all) => all.map(({ value }) => value).sort());
const stored = async (name) => (await fetch(`${daemon.url}/v1/connections/${name}`)).json();

async function begin(kind, name) {
  await page.selectOption('[name="kind"]', kind);
  await page.fill('[name="name"]', name);
}
const store = () => page.click('form.sheet button[type="submit"]');
const says = (pattern) => page.waitForFunction((text) => new RegExp(text).test(document.querySelector('.tried')?.textContent), pattern);

describe('the connections', () => {
  it('are behind the state of the service, and there is a form for every kind', async () => {
    page = await open(browser, daemon, '#/tables');
    await page.click('#link a');
    await page.waitForSelector('.schema-fields');
    assert.deepEqual(await kinds(), ['folder_in', 'folder_out', 'lsv2', 'mqtt', 'sparkplug', 'webhook']);
    for (const kind of await kinds()) {
      await page.selectOption('[name="kind"]', kind);
      assert.ok(await page.$$eval('.schema-fields .label', (all) => all.length) >= 5, kind);
      assert.deepEqual(await findings(page), [], kind);
    }
    await page.waitForFunction(() => document.querySelector('.connections > .note').textContent === 'No connections yet.');
  });

  it('are asked for again after an outage, with the form of each kind, but for a key only once', async () => {
    page = await open(browser, daemon, '#/tables');
    await page.route(/openapi\.json/, (route) => route.abort());
    await page.click('#link a');
    await page.waitForFunction(() => /cannot be reached/.test(document.querySelector('.connections > .note')?.textContent));
    await page.route(/\/v1\/connections/, (route) => route.fulfill({ status: 401, contentType: 'application/problem+json', body: '{"code":"auth.missing"}' }));
    await page.unroute(/openapi\.json/);
    await page.waitForSelector('.schema-fields');
    await page.click('dialog button:not(.primary)');
    const asked = () => page.waitForResponse((answer) => answer.status() === 401);
    for (let again = 0; again < 2; ++again) await asked();
    assert.equal(await page.$('dialog'), null);
    await page.unroute(/\/v1\/connections/);
    await page.waitForFunction(() => document.querySelector('.connections > .note').textContent === 'No connections yet.');
  });

  it('tell what is wrong at its field, and store nothing', async () => {
    page = await open(browser, daemon, '#/connections');
    await page.waitForSelector('.schema-fields');
    await begin('folder_in', 'wrong');
    await fill('folder', 'not/absolute');
    await fill('interval_s', 'often');
    await store();
    await page.waitForFunction(() => [...document.querySelectorAll('.schema-fields .note')].filter((note) => note.textContent).length === 2);
    assert.match(await field('folder').locator('.note').textContent(), /absolute/);
    assert.match(await field('interval_s').locator('.note').textContent(), /./);
    await picture(page, 'connections-wrong');
    assert.equal((await stored('wrong')).code, 'connection.unknown');
    await page.fill('[name="name"]', 'two words');
    await store();
    assert.match(await page.textContent('form.sheet > .note'), /1 to 63 letters/);
    page.errors.length = 0;
  });

  it('of folders bring values in and take them out, seen in the list', async () => {
    const folders = ['in', 'out'].map((name) => path.join(FOLDER, name));
    for (const folder of folders) fs.mkdirSync(folder);
    page = await open(browser, daemon, '#/connections');
    await page.waitForSelector('.schema-fields');
    await begin('folder_out', 'caq');
    await fill('folder', folders[1]);
    await field('start').locator('select').selectOption('beginning');
    await fill('every_s', '1');
    await store();
    await says('caq is stored');
    await begin('folder_in', 'machine');
    await fill('folder', folders[0]);
    await fill('interval_s', '1');
    await fill('rest_s', '1');
    await fill('map', 'Istwert = measured_mm\nTeil = part_id');
    await fill('set', 'designation = 25 H7');
    await store();
    await says('machine is stored');
    assert.deepEqual((await stored('machine')).map, { Istwert: 'measured_mm', Teil: 'part_id' });
    await page.click('form.sheet >> text=Test');
    await says('Reached: ');
    fs.writeFileSync(path.join(folders[0], 'a.csv'), 'Teil,Istwert\nSN-1,25.01\nSN-2,25.03\n');
    await page.waitForFunction(() => /2 measurements/.test(document.querySelector('.records tbody')?.textContent ?? ''));
    await page.waitForFunction(() => [...document.querySelectorAll('.records tr[data-state="ok"]')].length === 2);
    assert.deepEqual(await findings(page), []);
    await picture(page, 'connections');
    await page.click('.records >> text=machine'); // what is stored can be changed
    assert.equal(await field('map').locator('textarea').inputValue(), 'Istwert = measured_mm\nTeil = part_id');
    await page.click('.records tr:has-text("machine") >> text=Delete');
    await page.click('dialog button.primary');
    await page.waitForFunction(() => document.querySelectorAll('.records tbody tr').length === 1);
    assert.equal((await stored('machine')).code, 'connection.unknown');
    page.errors.length = 0;
  });

  it('to a receiver are tried once, whether it is there or not', async () => {
    const received = [];
    const receiver = http.createServer((request, response) => {
      received.push(request.headers['webhook-id']);
      request.resume().on('end', () => response.end());
    });
    await new Promise((resolve) => receiver.listen(0, '127.0.0.1', resolve));
    try {
      page = await open(browser, daemon, '#/connections');
      await page.waitForSelector('.schema-fields');
      await begin('webhook', 'mes');
      await fill('url', `http://127.0.0.1:${receiver.address().port}/hook`);
      await fill('secrets', `whsec_${Buffer.alloc(24, 7).toString('base64')}`);
      await field('filter').locator('summary').click();
      await page.getByLabel('Reject').check();
      await page.click('form.sheet >> text=Test');
      await says('Reached: ');
      const settings = await stored('mes');
      assert.deepEqual([settings.filter.verdict, settings.secret_count, settings.secrets], [['reject'], 1, undefined]);
      assert.equal(received.length, 1);
    } finally {
      receiver.close();
    }
    const taken = net.createServer((socket) => socket.destroy());
    await new Promise((resolve) => taken.listen(0, '127.0.0.1', resolve));
    const nobody = `127.0.0.1:${taken.address().port}`;
    try {
      for (const [kind, fields] of Object.entries({
        mqtt: { broker: `mqtt://${nobody}`, topic: 'plant/{machine}' }, sparkplug: { broker: `mqtt://${nobody}`, group: 'hall', node: 'gauge' },
        lsv2: { address: nobody, paths: 'TNC:\\nc_prog\\TCHPR*.TXT' },
      })) {
        await begin(kind, kind);
        for (const [name, text] of Object.entries(fields)) await fill(name, text);
        await page.click('form.sheet >> text=Test');
        await says('Not reached: ');
        assert.equal((await stored(kind)).kind, kind);
        await page.waitForSelector(`.records tr:has-text("${kind}")`);
      }
    } finally {
      taken.close();
    }
    await page.waitForSelector('.records tr[data-state="failing"]');
    page.errors.length = 0;
  });
});
