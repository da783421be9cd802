/** A barcode scanner with a keyboard interface. */

/** A second Enter within this time is the second of a pair, where nothing was typed between them. */
export const PAIR_MS = 310;

/** Between two keys of a hand, in ms: slower than any scanner. */
const HAND_MS = 45;

/** How long a test waits for what is being asked of the service; one that holds the answer back goes on meanwhile. */
const ANSWER_MS = 1000;

/** All keys of a line at once: the page gets them without a gap, however busy the machine is. */
export const scan = (page, text) => keys(page, text, 0);

/** The same, with keys that say they came as slowly as from a hand: nobody waits for them. */
export const typeSlowly = (page, text) => keys(page, text, HAND_MS);

/** Until it is known what is measured: its plan, and whether a line is a size or the number of a part. */
const known = (page) =>
  page.waitForSelector(':is(.plan, .entry)[aria-busy]', { state: 'detached', timeout: ANSWER_MS }).catch(() => {});

async function keys(page, text, gap) {
  await known(page);
  await page.evaluate(({ line, pace }) => {
    let at = performance.now();
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
    for (const key of [...line, 'Enter']) type(key);
  }, { line: text, pace: gap });
  await known(page);
}
