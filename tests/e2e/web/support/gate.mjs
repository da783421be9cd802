/** A way to the daemon that sees what passes: how many event streams a browser holds open. */

import http from 'node:http';

export class Gate {
  streams = 0;

  constructor(daemon) {
    this.server = http.createServer((asked, answer) => {
      const isStream = asked.url.startsWith('/v1/events');
      const onward = http.request(`${daemon.url}${asked.url}`, { method: asked.method, headers: { ...asked.headers, host: new URL(daemon.url).host } }, (answered) => {
        answer.writeHead(answered.statusCode, answered.headers);
        answered.pipe(answer);
      });
      if (isStream) this.streams += 1;
      answer.on('close', () => {
        if (isStream) this.streams -= 1;
        onward.destroy();
      });
      onward.on('error', () => answer.destroy());
      asked.pipe(onward);
    });
  }

  async open() {
    await new Promise((resolve) => { this.server.listen(0, '127.0.0.1', resolve); });
    this.url = `http://127.0.0.1:${this.server.address().port}`;
    return this;
  }

  close() {
    this.server.closeAllConnections();
    this.server.close();
  }
}
