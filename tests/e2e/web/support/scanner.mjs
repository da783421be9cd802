/** A barcode scanner with a keyboard interface. */

/** A second Enter within this time is the second of a pair, where nothing was typed between them. */
export const PAIR_MS = 310;

/** Between two keys of a hand, in ms: slower than any scanner. */
const HAND_MS = 45;

/** Until it is known what is measured: its plan, its size, and whether a line is a size or the number of a part. */
export const known = (page) => page.waitForSelector(':is(.plan, .entry, .echo)[aria-busy]', { state: 'detached' });

/**
 * All keys of a line at once: the page gets them without a gap, however busy the machine is. Waits for what they are
 * about, and for what they ask. Each line feed in it is one more Enter.
 */
export async function scan(page, text) {
  await known(page);
  await scanUnasked(page, text);
  await known(page);
}

/** The same without waiting, where a test holds the answer back. */
export const scanUnasked = (page, text) => keys(page, text, 0);

/** The same as `scan`, with keys that say they came as slowly as from a hand: nobody waits for them. */
export async function typeSlowly(page, text) {
  await known(page);
  await keys(page, text, HAND_MS);
  await known(page);
}

async function keys(page, text, gap) {
  await page.evaluate(({ line, pace }) => {
    let at = performance.now() - pace * (line.length + 1);
    const type = (key) => {
      const down = new KeyboardEvent('keydown', { key, bubbles: true, cancelable: true });
      Object.defineProperty(down, 'timeStamp', { value: at += pace });
      const target = document.activeElement ?? document.body;
      if (!target.dispatchEvent(down)) return;
      const now = document.activeElement;
      if (key.length === 1 && now.matches('input')) {
        now.setRangeText(key, now.selectionStart, now.selectionEnd, 'end');
        now.dispatchEvent(new InputEvent('input', { bubbles: true, data: key }));
      }
      if (key === 'Enter' && now.form) now.form.requestSubmit();
    };
    for (const key of [...line, '\n']) type(key === '\n' ? 'Enter' : key);
  }, { line: text, pace: gap });
}
