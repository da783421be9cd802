/** The path of a run: in space where the browser draws in three dimensions, else, and when it is wanted, as a drawing. */

import { h } from '../dom.js';
import { t } from '../i18n.js';
import { pathFigure, pathLegend } from './path_figure.js';
import { drawnFeatures } from './workpiece_outline.js';

/** {element, show, destroy}. @param trace a Trace; @param space of prepareSpace; @param setup {radius, sphere}: of the stylus' ball in mm, and the calibration sphere */
export async function pathView(trace, given, space, setup) {
  const features = drawnFeatures(given);
  const scene = space && await sceneOf(trace, features, space, setup);
  const legend = pathLegend(trace);
  if (!scene) {
    const { element, show } = pathFigure(trace, features);
    return { element: h('div.path', element, legend), show, destroy() {} };
  }
  const place = h('div', scene.element);
  let drawing;
  let last = trace.at(trace.length - 1);
  const choices = ['space', 'drawing'].map((name) => h('button', { type: 'button', 'aria-pressed': String(name === 'space'), onclick: () => choose(name) }, t(`programs.${name}`)));

  function choose(name) {
    choices.forEach((button, i) => button.setAttribute('aria-pressed', (i === 1) === (name === 'drawing')));
    if (name === 'drawing' && !drawing) {
      drawing = pathFigure(trace, features);
      drawing.show(last);
    }
    place.replaceChildren(name === 'drawing' ? drawing.element : scene.element);
  }

  function show(move) {
    last = move;
    scene.show(move);
    drawing?.show(move);
  }
  return { element: h('div.path', h('div.switch', choices), place, legend), show, destroy: scene.destroy };
}

/** Begins to load what draws in space, so that it is there when the moves are; null where there is no WebGL. */
export function prepareSpace() {
  const canvas = h('canvas');
  const context = canvas.getContext('webgl2', { antialias: true, preserveDrawingBuffer: true });
  return context && { canvas, context, library: import('./path_scene.js').catch(() => null) };
}

/** Nothing where the library does not load. */
async function sceneOf(trace, features, { canvas, context, library }, setup) {
  try {
    const { pathScene } = await library;
    return pathScene(trace, features, { canvas, context, ...setup });
  } catch {
    return null;
  }
}
