/** Touching a chart picks a point; drawing across it, with a finger too, chooses a stretch. */

/** Shorter than this, in pixels, a stroke is a touch. */
const SHORTEST = 8;

/** @param onPick takes an index; @param onStretch takes the first and the last index */
export function brush(plot, { onPick, onStretch }) {
  const { over } = plot;
  let start = null;
  const band = (left, right) => plot.setSelect({ left, width: right - left, top: 0, height: over.clientHeight }, false);
  const strokeTo = ({ clientX }) => [start, clientX].map((x) => x - over.getBoundingClientRect().left).sort((one, other) => one - other);
  const isTouch = ({ clientX }) => Math.abs(clientX - start) < SHORTEST;
  const end = () => {
    start = null;
    band(0, 0);
  };
  over.addEventListener('pointerdown', (event) => {
    if (event.button) return;
    start = event.clientX;
    over.setPointerCapture(event.pointerId);
  });
  over.addEventListener('pointermove', (event) => {
    if (start !== null && !isTouch(event)) band(...strokeTo(event));
  });
  over.addEventListener('pointerup', (event) => {
    if (start === null) return;
    const [from, to] = strokeTo(event).map((x) => plot.posToIdx(x));
    const tell = isTouch(event) ? () => onPick(from) : () => onStretch(from, to);
    end();
    tell();
  });
  over.addEventListener('pointercancel', end);
}
