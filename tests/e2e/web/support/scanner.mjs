/** A barcode scanner with a keyboard interface. */

/** A second Enter within this time is the second of a pair, where nothing was typed between them. */
export const PAIR_MS = 310;

/** All keys of a line at once: the page gets them without a gap, however busy the machine is. */
export function scan(page, text, end = 'Enter') {
  return page.evaluate(({ line, last }) => {
    const type = (key) => {
      const down = new KeyboardEvent('keydown', { key, bubbles: true, cancelable: true });
      const target = document.activeElement ?? document.body;
      if (!target.dispatchEvent(down)) return;
      const now = document.activeElement;
      if (key.length === 1 && now.matches('input')) {
        now.setRangeText(key, now.selectionStart, now.selectionEnd, 'end');
        now.dispatchEvent(new InputEvent('input', { bubbles: true, data: key }));
      }
      if (key === 'Enter' && now.form) now.form.requestSubmit();
    };
    for (const key of [...line, last]) type(key);
  }, { line: text, last: end });
}
