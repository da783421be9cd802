/** What is still open when the tests of a file are over, or one of them failed in the middle, is closed then. */

import { after } from 'node:test';

const open = [];

/** @param close is called at the end of the file, the newest first; to close twice does no harm */
export function atEnd(close) {
  open.push(close);
}

// Outside of a test there is no end.
if (process.env.NODE_TEST_CONTEXT) after(() => Promise.allSettled(open.reverse().map((close) => close())));
