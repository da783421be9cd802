/**
 * How long from Enter to the colour of the verdict, as a multiple of a raw POST from the same page, in turns (asked: 2):
 * to the colour by the limits held, on its hatched ground, and to the plain one of the stored record; beside a POST to its
 * answer and to the frame that shows this answer, since a frame of the screen is waited for by both. Then the stored one
 * while 64 other clients post as fast as they can (asked: 100 ms).
 * FITGAUGED=build/release/bin/fitgauged tests/e2e/web/run tests/bench/web/enter_to_colour.mjs [VALUES]
 * Prints milliseconds from the key to the frame that shows the colour.
 */

import http from 'node:http';
import { isMainThread, parentPort, Worker, workerData } from 'node:worker_threads';

const CLIENTS = 64;
const BODY = JSON.stringify({ designation: '25 H7', measured_mm: '25.0131', characteristic: 'load' });

/** The other clients: each posts its next value when the last is answered. */
function load({ port }) {
  const agent = new http.Agent({ keepAlive: true, maxSockets: CLIENTS });
  let answered = 0;
  const post = () => {
    const request = http.request({
      port, host: '127.0.0.1', agent, method: 'POST', path: '/v1/measurements',
      headers: { 'Content-Type': 'application/json', 'Content-Length': BODY.length },
    }, (response) => {
      answered += response.statusCode === 201 ? 1 : 0;
      response.resume().on('end', post);
    });
    request.on('error', () => process.exit(0)); // the service was stopped
    request.end(BODY);
  };
  for (let i = 0; i < CLIENTS; ++i) post();
  parentPort.on('message', () => parentPort.postMessage(answered));
}

/** In the page: notes the time of each Enter, and of the frames after its verdict stood there hatched and plain. */
function watch() {
  globalThis.times = { judged: [], stored: [] };
  let entered = 0;
  document.getElementById('value').addEventListener('keydown', (event) => {
    if (event.key === 'Enter') entered = event.timeStamp;
  });
  /** Calls back after the next frame. */
  globalThis.afterFrame = (then) => requestAnimationFrame(() => {
    const shown = new MessageChannel();
    shown.port1.onmessage = then;
    shown.port2.postMessage('');
  });
  const panel = document.querySelector('.verdict');
  new MutationObserver(() => {
    if (!['good', 'rework', 'reject'].includes(panel.dataset.verdict)) return;
    const state = panel.dataset.provisional ? 'judged' : 'stored';
    const begin = entered;
    globalThis.afterFrame(() => globalThis.times[state].push(performance.now() - begin));
  }).observe(panel, { childList: true });
}

/** In the page: milliseconds from a raw POST to its answer, and to the frame that shows it. */
async function rawPost() {
  const begin = performance.now();
  const answer = await fetch('/v1/measurements', { method: 'POST', headers: { 'Content-Type': 'application/json' }, body: '{"designation":"25 H7","measured_mm":25.0131,"characteristic":"raw"}' });
  const { verdict } = await answer.json();
  const answered = performance.now() - begin;
  document.getElementById('printed').textContent = verdict;
  await new Promise((resolve) => { globalThis.afterFrame(resolve); });
  return { answered, shown: performance.now() - begin };
}

const sorted = (numbers) => [...numbers].sort((one, other) => one - other);
const at = (numbers, share) => sorted(numbers)[Math.min(numbers.length - 1, Math.floor(share * numbers.length))];

const type = async (page, i) => {
  await page.keyboard.type(`25.0${String(100 + (i % 150))}\n`);
  await page.waitForFunction((done) => globalThis.times.stored.length === done, i + 1);
};

/** One value typed, one posted, again and again. */
async function compare(page, count) {
  const raw = [];
  for (let i = 0; i < count; ++i) {
    await type(page, i);
    raw.push(await page.evaluate(rawPost));
  }
  const { judged, stored } = await page.evaluate(() => globalThis.times);
  await page.evaluate(() => { globalThis.times = { judged: [], stored: [] }; });
  const answered = raw.map((one) => one.answered);
  const shown = raw.map((one) => one.shown);
  const median = (numbers) => at(numbers, 0.5).toFixed(1);
  console.log(`enter to colour, ${count} values alone: median ${median(judged)} ms by the limits held, ${median(stored)} ms as stored; `
    + `a raw POST ${median(answered)} ms to its answer, ${median(shown)} ms to the frame that shows it`);
  const ratio = (one, other) => (at(one, 0.5) / at(other, 0.5)).toFixed(1);
  console.log(`  by the limits held ${ratio(judged, answered)} times a raw POST; as stored ${ratio(stored, answered)} times, ${ratio(stored, shown)} times one that is shown; `
    + `95 %: ${[judged, stored, answered, shown].map((numbers) => at(numbers, 0.95).toFixed(1)).join(', ')} ms`);
}

async function measure(count) {
  const { close, launch, open } = await import('../../e2e/web/support/browser.mjs');
  const { Daemon, sleep } = await import('../../e2e/web/support/daemon.mjs');
  const browser = await launch();
  const daemon = await new Daemon().start();
  const page = await open(browser, daemon, '#/gauge/25H7');
  await page.waitForSelector('.echo .figures');
  await page.evaluate(watch);
  await compare(page, count);
  const others = new Worker(new URL(import.meta.url), { workerData: { port: daemon.port } });
  await sleep(1000);
  const answered = () => new Promise((resolve) => {
    others.once('message', resolve);
    others.postMessage('');
  });
  const before = await answered();
  const begun = Date.now();
  for (let i = 0; i < count; ++i) await type(page, i);
  const rate = (await answered() - before) / (Date.now() - begun) * 1000;
  const times = await page.evaluate(() => globalThis.times.stored);
  await close(page);
  await others.terminate();
  await browser.close();
  await daemon.cleanup();
  console.log(`enter to the stored colour, ${count} values, ${CLIENTS} clients posting ${rate.toFixed(0)} values a second: `
    + `median ${at(times, 0.5).toFixed(1)} ms, 95 % ${at(times, 0.95).toFixed(1)} ms, longest ${at(times, 1).toFixed(1)} ms`);
}

if (isMainThread) await measure(Number(process.argv[2] ?? 100));
else load(workerData);
