/** The path of a run: in space where the browser draws in three dimensions, else, and when it is wanted, as a drawing. */

import { h } from '../dom.js';
import { t } from '../i18n.js';
import { pathFigure, pathLegend } from './path_figure.js';

/** {element, show, destroy}. @param radius of the stylus' ball, in mm */
export async function pathView(moves, features, radius) {
  const scene = await sceneOf(moves, features, radius);
  const legend = pathLegend(moves);
  if (!scene) {
    const { element, show } = pathFigure(moves, features);
    return { element: h('div.path', element, legend), show, destroy() {} };
  }
  const place = h('div', scene.element);
  let drawing;
  let last = moves.at(-1);
  const choices = ['space', 'drawing'].map((name) => h('button', { type: 'button', 'aria-pressed': String(name === 'space'), onclick: () => choose(name) }, t(`programs.${name}`)));

  function choose(name) {
    choices.forEach((button, i) => button.setAttribute('aria-pressed', (i === 1) === (name === 'drawing')));
    if (name === 'drawing' && !drawing) {
      drawing = pathFigure(moves, features);
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

/** Nothing where there is no WebGL, or the library does not load. */
async function sceneOf(moves, features, radius) {
  const canvas = h('canvas');
  const context = canvas.getContext('webgl2', { antialias: true, preserveDrawingBuffer: true });
  if (!context) return null;
  try {
    const { pathScene } = await import('./path_scene.js');
    return pathScene(moves, features, { canvas, context, radius });
  } catch {
    return null;
  }
}
