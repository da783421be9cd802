/** A way to the daemon, as a reverse proxy is: it sees how many event streams a browser holds open, and says 502 where there is no daemon. */

import http from 'node:http';

import { atEnd } from './ending.mjs';

export class Gate {
  streams = 0;

  constructor(daemon) {
    this.server = http.createServer((asked, answer) => {
      const isStream = asked.url.startsWith('/v1/events');
      const onward = http.request(`${daemon.url}${asked.url}`, { method: asked.method, headers: { ...asked.headers, host: new URL(daemon.url).host, ...(asked.headers.origin && { origin: daemon.url }) } }, (answered) => {
        answer.writeHead(answered.statusCode, answered.headers);
        answered.pipe(answer);
      });
      if (isStream) this.streams += 1;
      answer.on('close', () => {
        if (isStream) this.streams -= 1;
        onward.destroy();
      });
      onward.on('error', () => (answer.headersSent ? answer.destroy() : answer.writeHead(502).end()));
      asked.pipe(onward);
    });
  }

  async open() {
    await new Promise((resolve) => { this.server.listen(0, '127.0.0.1', resolve); });
    atEnd(() => this.close());
    this.url = `http://127.0.0.1:${this.server.address().port}`;
    return this;
  }

  close() {
    this.server.closeAllConnections();
    this.server.close();
  }
}
