/** Touching a chart picks a point; drawing across it, with a finger too, chooses a stretch. */

/** Shorter than this, in pixels, a stroke is a touch. */
const SHORTEST = 8;

/** @param onPick takes an index; @param onStretch takes the first and the last index */
export function brush(plot, { onPick, onStretch }) {
  const { over } = plot;
  let start = null;
  const band = ([left, right]) => plot.setSelect({ left, width: right - left, top: 0, height: over.clientHeight }, false);
  const strokeTo = ({ clientX }) => {
    const { left, width } = over.getBoundingClientRect();
    return [start, clientX].map((x) => Math.min(Math.max(x - left, 0), width)).sort((one, other) => one - other);
  };
  over.addEventListener('pointerdown', (event) => {
    if (event.button) return;
    start = event.clientX;
    over.setPointerCapture(event.pointerId);
  });
  over.addEventListener('pointermove', (event) => {
    if (start !== null && Math.abs(event.clientX - start) >= SHORTEST) band(strokeTo(event));
  });
  over.addEventListener('pointerup', (event) => {
    if (start === null) return;
    const touched = Math.abs(event.clientX - start) < SHORTEST;
    const stretch = strokeTo(event).map((x) => plot.posToIdx(x));
    start = null;
    band([0, 0]);
    if (touched) onPick(stretch[0]);
    else onStretch(...stretch);
  });
  over.addEventListener('pointercancel', () => {
    start = null;
    band([0, 0]);
  });
}
