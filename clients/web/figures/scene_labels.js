/** What is written over the part in space: the axes, the scale, the diameter of each bore. */

import { Vector3 } from '../bundled/three.js';
import { h } from '../dom.js';
import { number } from '../i18n.js';

/** The scale is about so long, in pixels. */
const SCALE_PIXELS = 120;

/** 1, 2 or 5 times a power of ten, at most so much. */
export function roundLength(most) {
  const power = 10 ** Math.floor(Math.log10(most));
  return [5, 2, 1].find((factor) => factor * power <= most) * power;
}

export class SceneLabels {
  /** @param labels {text, at: [x, y, z] in mm} */
  constructor(labels) {
    this.placed = labels.map(({ text, at }) => ({ at: new Vector3(...at), element: h('span', text) }));
    this.length = h('span');
    this.scale = h('span.scale', this.length);
    this.element = h('div.scene-labels', { 'aria-hidden': 'true' }, this.placed.map(({ element }) => element), this.scale);
  }

  /** Puts each where its point is seen. @param camera an orthographic one; @param size of the canvas in pixels */
  draw(camera, { width, height }) {
    for (const { at, element } of this.placed) {
      const { x, y } = at.clone().project(camera);
      element.style.transform = `translate(${((x + 1) * width / 2).toFixed(1)}px, ${((1 - y) * height / 2).toFixed(1)}px) translate(-50%, -50%)`;
    }
    const perMm = height * camera.zoom / (camera.top - camera.bottom);
    const length = roundLength(SCALE_PIXELS / perMm);
    this.scale.style.width = `${length * perMm}px`;
    this.length.textContent = `${number(String(length))} mm`;
  }
}
