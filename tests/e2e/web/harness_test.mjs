/** The tests of the page themselves: one that fails in the middle ends its file, and leaves nothing running. */

import assert from 'node:assert/strict';
import { spawn } from 'node:child_process';
import fs from 'node:fs';
import os from 'node:os';
import path from 'node:path';
import { after, describe, it } from 'node:test';

const LONGEST_MS = 200000;
const FOLDER = fs.mkdtempSync(path.join(os.tmpdir(), 'fitgauge-harness-'));
const support = (name) => path.resolve(`tests/e2e/web/support/${name}.mjs`);
const FAILING = `
import { it } from 'node:test';
import { launch, open } from '${support('browser')}';
import { Daemon } from '${support('daemon')}';
it('fails with a browser, a page and a service of its own', async () => {
  const daemon = await new Daemon().start();
  console.log('data ' + daemon.folder + ' process ' + daemon.process.pid + ' ');
  await open(await launch(), daemon);
  throw new Error('in the middle');
});
`;

after(() => fs.rmSync(FOLDER, { recursive: true }));

describe('a file of tests', () => {
  it('ends at once when one fails, and leaves no service and no data', { timeout: 2 * LONGEST_MS }, async () => {
    const file = path.join(FOLDER, 'failing_test.mjs');
    fs.writeFileSync(file, FAILING);
    const { NODE_TEST_CONTEXT: _, ...env } = process.env;
    const run = spawn('node', ['--test', file], { env, stdio: ['ignore', 'pipe', 'inherit'], detached: true });
    let ended = '';
    const late = setTimeout(() => {
      ended = 'it had to be ended';
      process.kill(-run.pid, 'SIGKILL');
    }, LONGEST_MS);
    let said = '';
    for await (const piece of run.stdout) said += piece;
    clearTimeout(late);
    assert.equal(ended, '');
    assert.match(said, /in the middle/);
    const [, data, pid] = /data (\S+) process (\d+) /.exec(said);
    assert.throws(() => process.kill(Number(pid), 0), { code: 'ESRCH' });
    assert.equal(fs.existsSync(data), false);
  });
});
