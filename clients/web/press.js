/** The press of a finger or a mouse button, under which nothing is redrawn: a button that is replaced gets no click. */

let lifted = Promise.resolve();
addEventListener('pointerdown', () => {
  lifted = new Promise((resolve) => {
    for (const type of ['pointerup', 'pointercancel']) addEventListener(type, () => setTimeout(resolve), { once: true, capture: true });
  });
}, { capture: true });
/** Until nothing is pressed and the click is told. */
export const untilLifted = () => lifted;
