/** The stream of events: who follows it without an id reads its lists anew once it has begun, and not before. */

import assert from 'node:assert/strict';
import { it } from 'node:test';

import { followStream } from '../../../clients/web/stream.js';

it('says to read anew when the stream has begun: its answer may come before', async () => {
  const told = [];
  const ending = new AbortController();
  let body;
  const stream = new ReadableStream({ start(controller) { body = controller; } });
  globalThis.fetch = async () => new Response(stream.pipeThrough(new TextEncoderStream()), { status: 200 });
  const end = followStream('/v1/events', { signal: ending.signal, onEvent: ({ type, id }) => told.push([type, id]) });
  body.enqueue(': the answer is there\n\n');
  body.enqueue('id: m7.e3\n\nevent: note.added\nid: m7.e4\ndata: {}\n\n');
  while (told.length < 2) await new Promise((resolve) => { setTimeout(resolve, 5); });
  assert.deepEqual(told, [['resync', 'm7.e3'], ['note.added', 'm7.e4']]);
  ending.abort();
  body.close();
  await end;
});
