/** A fitgauged of one's own: the binary of $FITGAUGED on a free port, its data in a new folder. */

import { execFileSync, spawn } from 'node:child_process';
import fs from 'node:fs';
import net from 'node:net';
import os from 'node:os';
import path from 'node:path';

import { atEnd } from './ending.mjs';

const FITGAUGED = path.resolve(process.env.FITGAUGED ?? 'build/release/bin/fitgauged');
const LONGEST_START_MS = 120000;
/** Without the settings of the service, so that it starts with its defaults. */
const ENVIRONMENT = Object.fromEntries(Object.entries(process.env).filter(([name]) => !name.startsWith('FITGAUGE_')));

const listens = (server, port) => new Promise((resolve) => {
  server.once('error', () => resolve(false));
  server.listen(port, '127.0.0.1', () => resolve(true));
});

/** A port that nobody gets by chance while its service is away: the system gives it to no connection and to no port 0. */
async function lastingPort() {
  const [first, last] = fs.readFileSync('/proc/sys/net/ipv4/ip_local_port_range', 'utf8').split(/\s+/).map(Number);
  // Browsers refuse 10080; where the system gives all, it gives this one.
  const own = Array.from({ length: 55000 }, (_, i) => 10100 + i).filter((port) => port < first || port > last);
  for (;;) {
    const probe = net.createServer();
    if (!await listens(probe, own.length ? own[Math.floor(Math.random() * own.length)] : 0)) continue;
    const { port } = probe.address();
    await new Promise((resolve) => { probe.close(resolve); });
    return port;
  }
}

export const sleep = (milliseconds) => new Promise((resolve) => setTimeout(resolve, milliseconds));

export class Daemon {
  constructor(...flags) {
    this.folder = fs.mkdtempSync(path.join(os.tmpdir(), 'fitgauge-web-'));
    this.flags = flags;
    this.port = 0;
    atEnd(() => this.cleanup());
  }

  get url() {
    return `http://127.0.0.1:${this.port}`;
  }

  /** Starts it; again on the port it had. */
  async start() {
    this.port ||= await lastingPort();
    const portFile = path.join(this.folder, 'port');
    fs.rmSync(portFile, { force: true });
    this.process = spawn(FITGAUGED, ['--listen', `127.0.0.1:${this.port}`, '--data', path.join(this.folder, 'data'),
      '--port-file', portFile, '--log-level', 'error', ...this.flags], { stdio: ['ignore', 'ignore', 'inherit'], env: ENVIRONMENT });
    const ended = new Promise((resolve) => this.process.once('exit', resolve));
    this.ended = ended;
    for (const until = Date.now() + LONGEST_START_MS; !fs.existsSync(portFile); await sleep(10)) {
      if (this.process.exitCode !== null || Date.now() > until) throw new Error('fitgauged does not start');
    }
    return this;
  }

  async stop(signal = 'SIGTERM') {
    this.process.kill(signal);
    await this.ended;
  }

  kill() {
    return this.stop('SIGKILL');
  }

  get isRunning() {
    return this.process?.exitCode === null && this.process.signalCode === null;
  }

  /** Ends it if it runs, and removes its data. */
  async cleanup() {
    if (this.isRunning) await this.kill();
    fs.rmSync(this.folder, { recursive: true, force: true });
  }

  /** The output of a command beside the service. */
  command(...args) {
    return execFileSync(FITGAUGED, [...args, '--data', path.join(this.folder, 'data')], { encoding: 'utf8', env: ENVIRONMENT }).trim();
  }

  /** A new API key, which the service has taken up. */
  async key(name, role) {
    const key = this.command('key', 'create', '--name', name, '--role', role).split(/\s/).at(-1);
    const known = async () => (await fetch(`${this.url}/v1/measurements`, { headers: { Authorization: `Bearer ${key}` } })).ok;
    for (const until = Date.now() + LONGEST_START_MS; !await known(); await sleep(50)) {
      if (Date.now() > until) throw new Error('the service does not take up a new key');
    }
    return key;
  }

  async json(target) {
    return (await fetch(this.url + target)).json();
  }

  async send(method, target, body, type = 'application/json') {
    const answer = await fetch(this.url + target, {
      method, body: typeof body === 'string' ? body : JSON.stringify(body), headers: { 'Content-Type': type },
    });
    if (!answer.ok) throw new Error(`${method} ${target}: ${answer.status} ${await answer.text()}`);
    return answer;
  }

  /** Every measurement, in the order of storage. */
  async stored(query = 'history=all') {
    const text = await (await fetch(`${this.url}/v1/measurements?${query}`, { headers: { Accept: 'application/x-ndjson' } })).text();
    return text.split('\n').filter(Boolean).map((line) => JSON.parse(line));
  }
}
