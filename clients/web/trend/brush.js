/** Touching a figure picks a point; drawing across it chooses a stretch. */

import { s } from '../dom.js';

/** Shorter than this, in pixels, a stroke is a touch. */
const SHORTEST = 8;

/**
 * @param indexAt gives the index of a point for an x in CSS pixels of the screen
 * @param onPick takes an index; @param onStretch takes the first and the last index
 */
export function brush(svg, { indexAt, top, height, onPick, onStretch }) {
  let start = null;
  const band = s('rect.brush', { y: top, height });
  const place = (event) => {
    const { left, width } = svg.getBoundingClientRect();
    const scale = svg.viewBox.baseVal.width / width;
    return [start, event.clientX].map((x) => (x - left) * scale).sort((one, other) => one - other);
  };
  const end = () => {
    start = null;
    band.remove();
  };
  svg.addEventListener('pointerdown', (event) => {
    if (event.button) return;
    start = event.clientX;
    svg.setPointerCapture(event.pointerId);
  });
  svg.addEventListener('pointermove', (event) => {
    if (start === null || Math.abs(event.clientX - start) < SHORTEST) return;
    const [from, to] = place(event);
    band.setAttribute('x', from);
    band.setAttribute('width', to - from);
    if (!band.parentNode) svg.append(band);
  });
  svg.addEventListener('pointerup', (event) => {
    if (start === null) return;
    const stretch = [start, event.clientX].sort((one, other) => one - other).map(indexAt);
    const touched = Math.abs(event.clientX - start) < SHORTEST;
    end();
    if (touched) onPick(stretch[0]);
    else onStretch(...stretch);
  });
  svg.addEventListener('pointercancel', end);
  return svg;
}
