/**
 * The press of a finger or the first mouse button, under which nothing is redrawn: a button that is replaced gets no click.
 * Only on what a click acts on: a browser may not tell of the release of a scroll bar, of a menu or of its own list.
 */

/** What comes again within this time, an Enter or a tap, is the second of a pair and no answer. */
export const PAIR_MS = 300;

const CLICKED = 'a, button, input, label, summary';
/** A release that is never told holds back no news for longer. */
const LONGEST_MS = 30_000;

let lifted = Promise.resolve();
addEventListener('pointerdown', ({ button, target }) => {
  if (button !== 0 || !target.closest?.(CLICKED)) return;
  lifted = new Promise((resolve) => {
    for (const type of ['pointerup', 'pointercancel']) addEventListener(type, () => setTimeout(resolve), { once: true, capture: true });
    addEventListener('blur', resolve, { once: true });
    setTimeout(resolve, LONGEST_MS);
  });
}, { capture: true });
/** Until nothing is pressed and the click is told. */
export const untilLifted = () => lifted;
