/** The part, the stylus, the path of a run and its contacts in space. Drawn only when something changes. */

import {
  BackSide, BufferAttribute, BufferGeometry, CanvasTexture, Color, DirectionalLight, HemisphereLight, LineBasicMaterial, LineDashedMaterial, LineSegments,
  MeshLambertMaterial, OrbitControls, OrthographicCamera, Points, PointsMaterial, Scene, Vector3, WebGLRenderer,
} from '../bundled/three.js';
import { h } from '../dom.js';
import { number, t } from '../i18n.js';
import { boundsOf } from './path_bounds.js';
import { SceneLabels } from './scene_labels.js';
import { ball, boresOf, solidsOf, stylusOf, tableOf } from './scene_solids.js';
import { poseName, touchedSpheres } from './touched_sphere.js';

/** What is drawn in which colour of the page. */
const COLOURS = { rapid: '--edge', feed: '--ink', arc: '--ink', probe: '--focus', contact: '--focus', here: '--alarm', axes: '--ink', part: '--line', hole: '--edge', ghost: '--line', stylus: '--reject' };
const STYLUS_RADIUS_MM = 2;
const CONTACT_PIXELS = 11;
const AXES = ['X', 'Y', 'Z'];
/** From where the part is seen. */
const VIEWS = { corner: [0.45, -0.75, 0.5], top: [0, -1e-4, 1], front: [0, -1, 0], right: [1, 0, 0] };
const SEEN = 1.2; // of the size of what matters

/**
 * {element, show, destroy}: `show` puts the stylus to the end of a move.
 * @param trace a Trace; @param context of WebGL; @param radius of the stylus' ball, in mm
 * @param sphere {center_mm, radius_mm} of the calibration sphere on the table, if there is one
 */
export function pathScene(trace, features, { canvas, context, radius = STYLUS_RADIUS_MM, sphere }) {
  const bounds = boundsOf(trace, features);
  const size = Math.max(extentOf(bounds), 1);
  const materials = materialsOf(size);
  const scene = new Scene();
  scene.add(new HemisphereLight(0xffffff, 0x999999, 2.2), lightFrom(1, -2, 3));
  for (const [kind, ends] of Object.entries(trace.endsByKind)) scene.add(lines(ends, materials[kind]));
  scene.add(new Points(geometryOf(trace.contacts), materials.contact));
  const bores = features.filter((one) => one.type === 'block').flatMap((block) => boresOf(block, features));
  let solids = null;
  const section = h('button', { type: 'button', hidden: !bores.length, 'aria-pressed': 'true', onclick: () => cut(section.getAttribute('aria-pressed') === 'false') }, t('programs.section'));
  const spots = sphere ? touchedSpheres(trace) : [];
  const table = spots.length > 0 && tableOf(sphere, materials);
  if (table) scene.add(table, ...spots.map(({ centre }) => ball(centre, sphere.radius_mm, materials.ghost)));
  const origin = AXES.map((axis) => Math.min(Math.max(0, bounds.low[axis]), bounds.high[axis]));
  const arms = AXES.map((_, i) => origin.map((value, k) => value + (i === k ? size / 6 : 0)));
  const across = bores.map(({ center_mm: [x, y], top_mm: top = 0, diameter_mm: d }) => [x - d / 2, y, top, x + d / 2, y, top]);
  const measures = lines(Float32Array.from([...arms.flatMap((arm) => [...origin, ...arm]), ...across.flat()]), materials.axes);
  measures.renderOrder = 1;
  scene.add(measures);
  const labels = new SceneLabels([
    ...AXES.map((text, i) => ({ text, at: arms[i] })),
    ...bores.map(({ diameter_mm: d }, i) => ({ text: `Ø ${number(d.toFixed(3))}`, at: across[i].slice(3) })),
  ]);
  const stylus = stylusOf(radius, materials.stylus);
  const marked = new LineSegments(geometryOf(trace.ends.slice(0, 6)), materials.here);
  marked.frustumCulled = false;
  marked.renderOrder = 1;
  scene.add(stylus, marked);

  const renderer = new WebGLRenderer({ canvas, context });
  renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
  const camera = new OrthographicCamera();
  camera.up.set(0, 0, 1);
  const controls = new OrbitControls(camera, canvas);
  const dark = matchMedia('(prefers-color-scheme: dark)');
  let frame = 0;

  function draw() {
    frame ||= requestAnimationFrame(() => {
      frame = 0;
      renderer.render(scene, camera);
      labels.draw(camera, { width: canvas.clientWidth, height: canvas.clientHeight });
    });
  }

  function paint() {
    const style = getComputedStyle(document.documentElement);
    for (const [name, token] of Object.entries(COLOURS)) materials[name].color.set(new Color(style.getPropertyValue(token).trim()));
    renderer.setClearColor(new Color(style.getPropertyValue('--sheet').trim()));
    draw();
  }

  function fit() {
    const { clientWidth: width, clientHeight: height } = canvas;
    if (!width || !height) return;
    renderer.setSize(width, height, false);
    const [across, upright] = spreadOf(camera, bounds);
    const half = SEEN * Math.max(upright, (across * height) / width, size / 20);
    Object.assign(camera, { left: -half * width / height, right: half * width / height, top: half, bottom: -half });
    camera.updateProjectionMatrix();
    draw();
  }

  const resized = new ResizeObserver(fit);
  lookAt(camera, controls, bounds, size, VIEWS.corner);
  // A wheel and a finger scroll the page until the figure is taken up; then the wheel comes nearer.
  controls.enableZoom = false;
  canvas.style.touchAction = 'pan-y';
  canvas.addEventListener('focus', () => { controls.enableZoom = true; });
  canvas.addEventListener('blur', () => { controls.enableZoom = false; });
  canvas.addEventListener('pointerdown', () => canvas.focus({ preventScroll: true }));
  controls.listenToKeyEvents(canvas);
  controls.addEventListener('change', draw);
  dark.addEventListener('change', paint);
  resized.observe(canvas);
  canvas.tabIndex = 0;
  canvas.setAttribute('role', 'img');
  canvas.setAttribute('aria-label', `${t('programs.space')}: ${t('programs.path_summary', { moves: trace.length, contacts: trace.contacts.length / 3 })}`);
  controls.update();
  paint();
  cut(bores.length > 0);

  /** Takes away what stands before the first bore, or puts it back. */
  function cut(isCut) {
    section.setAttribute('aria-pressed', isCut);
    if (solids) {
      scene.remove(solids);
      solids.traverse(({ geometry }) => geometry?.dispose());
    }
    solids = solidsOf(features, isCut ? bores[0].center_mm[1] : null, materials);
    scene.add(solids);
    draw();
  }

  function lookFrom(name) {
    lookAt(camera, controls, bounds, size, VIEWS[name]);
    controls.update();
    fit();
  }
  addEventListener('beforeprint', fit);

  function show(move) {
    stylus.position.set(...AXES.map((axis) => move.end_mm[axis]));
    const ends = marked.geometry.attributes.position;
    [move.start_mm, move.end_mm].forEach((point, i) => ends.setXYZ(i, ...AXES.map((axis) => point[axis])));
    ends.needsUpdate = true;
    stand(move.end_deg);
    draw();
  }
  show(trace.at(trace.length - 1));

  /** The table as the axes stand: it turns with them, against their sense, and the part with it. */
  function stand(degrees) {
    const spot = spots.find(({ name }) => name === poseName(degrees));
    if (!spot) return;
    table.position.set(...spot.centre);
    table.rotation.set(...['A', 'B', 'C'].map((axis) => (-(degrees[axis] ?? 0) * Math.PI) / 180), 'XYZ');
  }

  function destroy() {
    cancelAnimationFrame(frame);
    resized.disconnect();
    dark.removeEventListener('change', paint);
    removeEventListener('beforeprint', fit);
    controls.dispose();
    scene.traverse(({ geometry }) => geometry?.dispose());
    renderer.dispose();
    renderer.forceContextLoss();
  }
  const views = h('div.views', Object.keys(VIEWS).map((name) => h('button', { type: 'button', onclick: () => lookFrom(name) }, t(`programs.view.${name}`))), section);
  return { element: h('figure.scene', views, h('div.canvas', canvas, labels.element), h('figcaption', t('programs.space_hint'))), show, destroy };
}

const geometryOf = (numbers) => new BufferGeometry().setAttribute('position', new BufferAttribute(numbers, 3));

function lines(ends, material) {
  const segments = new LineSegments(geometryOf(ends), material);
  return material.isLineDashedMaterial ? segments.computeLineDistances() : segments;
}

function lightFrom(...place) {
  const light = new DirectionalLight(0xffffff, 1.5);
  light.position.set(...place);
  return light;
}

function materialsOf(size) {
  const part = { polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 1 };
  return {
    rapid: new LineDashedMaterial({ dashSize: size / 100, gapSize: size / 100 }),
    feed: new LineBasicMaterial(),
    arc: new LineDashedMaterial({ dashSize: size / 300, gapSize: size / 200 }),
    probe: new LineBasicMaterial(),
    here: new LineBasicMaterial({ depthTest: false }),
    axes: new LineBasicMaterial({ depthTest: false }),
    contact: new PointsMaterial({ size: CONTACT_PIXELS, sizeAttenuation: false, alphaTest: 0.5, map: disc() }),
    part: new MeshLambertMaterial(part),
    ghost: new MeshLambertMaterial({ transparent: true, opacity: 0.45, depthWrite: false }),
    hole: new MeshLambertMaterial({ ...part, side: BackSide, transparent: true, opacity: 0.8 }),
    stylus: new MeshLambertMaterial(),
  };
}

/** What a contact is drawn with. */
function disc() {
  const canvas = h('canvas', { width: 32, height: 32 });
  const pen = canvas.getContext('2d');
  pen.fillStyle = '#fff';
  pen.arc(16, 16, 14, 0, 2 * Math.PI);
  pen.fill();
  return new CanvasTexture(canvas);
}

const vector = (point) => new Vector3(...AXES.map((axis) => point[axis]));
const extentOf = ({ low, high }) => vector(low).distanceTo(vector(high));

/** How far the box reaches from its middle, as the camera stands: [across, upright] in mm. */
function spreadOf({ matrixWorld }, { low, high }) {
  const half = vector(high).sub(vector(low)).multiplyScalar(0.5);
  return [0, 1].map((axis) => {
    const { x, y, z } = new Vector3().setFromMatrixColumn(matrixWorld, axis);
    return Math.abs(x) * half.x + Math.abs(y) * half.y + Math.abs(z) * half.z;
  });
}

/** From a side, so that all that matters is in sight. */
function lookAt(camera, controls, { low, high }, size, from) {
  controls.target.addVectors(vector(low), vector(high)).multiplyScalar(0.5);
  camera.position.copy(controls.target).add(new Vector3(...from).normalize().multiplyScalar(4 * size));
  Object.assign(camera, { near: size / 100, far: size * 20, zoom: 1 });
  camera.updateProjectionMatrix();
  camera.lookAt(controls.target);
  camera.updateMatrixWorld();
}
