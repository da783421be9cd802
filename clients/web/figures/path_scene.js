/** The part, the stylus, the path of a run and its contacts in space. Drawn only when something changes. */

import {
  BackSide, BoxGeometry, BufferAttribute, BufferGeometry, CanvasTexture, Color, CylinderGeometry, DirectionalLight, Group, HemisphereLight,
  LineBasicMaterial, LineDashedMaterial, LineSegments, Mesh, MeshLambertMaterial, OrbitControls, PerspectiveCamera, Points, PointsMaterial, Scene, SphereGeometry,
  Vector3, WebGLRenderer,
} from '../bundled/three.js';
import { h } from '../dom.js';
import { t } from '../i18n.js';
import { boundsOf } from './path_bounds.js';

/** What is drawn in which colour of the page. */
const COLOURS = { rapid: '--edge', feed: '--ink', arc: '--ink', probe: '--focus', contact: '--focus', here: '--alarm', part: '--line', hole: '--edge', stylus: '--reject' };
const STYLUS_RADIUS_MM = 2;
const STYLUS_LENGTH = 12; // of its ball's radius
const CONTACT_PIXELS = 11;
/** Points in a cylinder's circle. */
const ROUND = 64;
const VIEW_ANGLE = 35;
const AXES = ['X', 'Y', 'Z'];

/** {element, show, destroy}: `show` puts the stylus to the end of a move. @param trace a Trace; @param context of WebGL @param radius of the ball, in mm */
export function pathScene(trace, features, { canvas, context, radius = STYLUS_RADIUS_MM }) {
  const bounds = boundsOf(trace, features);
  const size = Math.max(extentOf(bounds), 1);
  const materials = materialsOf(size);
  const scene = new Scene();
  scene.add(new HemisphereLight(0xffffff, 0x999999, 2.2), lightFrom(1, -2, 3));
  for (const [kind, ends] of Object.entries(trace.endsByKind)) scene.add(lines(ends, materials[kind]));
  scene.add(new Points(geometryOf(trace.contacts), materials.contact));
  for (const feature of features) if (feature.type in SOLIDS) scene.add(SOLIDS[feature.type](feature, materials));
  const stylus = stylusOf(radius, materials.stylus);
  const marked = new LineSegments(geometryOf(trace.ends.slice(0, 6)), materials.here);
  marked.frustumCulled = false;
  marked.renderOrder = 1;
  scene.add(stylus, marked);

  const renderer = new WebGLRenderer({ canvas, context });
  renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
  const camera = new PerspectiveCamera(VIEW_ANGLE);
  camera.up.set(0, 0, 1);
  const controls = new OrbitControls(camera, canvas);
  const dark = matchMedia('(prefers-color-scheme: dark)');
  let frame = 0;

  function draw() {
    frame ||= requestAnimationFrame(() => {
      frame = 0;
      renderer.render(scene, camera);
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
    camera.aspect = width / height;
    camera.updateProjectionMatrix();
    draw();
  }

  const resized = new ResizeObserver(fit);
  lookAt(camera, controls, bounds, size);
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
  addEventListener('beforeprint', fit);

  function show(move) {
    stylus.position.set(...AXES.map((axis) => move.end_mm[axis]));
    const ends = marked.geometry.attributes.position;
    [move.start_mm, move.end_mm].forEach((point, i) => ends.setXYZ(i, ...AXES.map((axis) => point[axis])));
    ends.needsUpdate = true;
    draw();
  }
  show(trace.at(trace.length - 1));

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
  return { element: h('figure.scene', canvas, h('figcaption', t('programs.space_hint'))), show, destroy };
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
    contact: new PointsMaterial({ size: CONTACT_PIXELS, sizeAttenuation: false, alphaTest: 0.5, map: disc() }),
    part: new MeshLambertMaterial({ ...part, transparent: true, opacity: 0.55, depthWrite: false }),
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

function cylinder({ center_mm: [x, y], diameter_mm: diameter, top_mm: top = 0 }, length, material) {
  const mesh = new Mesh(new CylinderGeometry(diameter / 2, diameter / 2, length, ROUND, 1, material.side === BackSide), material);
  mesh.rotation.x = Math.PI / 2; // its axis is Y
  mesh.position.set(x, y, top - length / 2);
  return mesh;
}

/** The features that have a simple shape; the others are known by their contacts. */
const SOLIDS = {
  block: ({ min_mm: low, max_mm: high }, { part }) => {
    const mesh = new Mesh(new BoxGeometry(...high.map((value, i) => value - low[i])), part);
    mesh.position.set(...high.map((value, i) => (value + low[i]) / 2));
    return mesh;
  },
  bore: (feature, { hole }) => cylinder(feature, feature.depth_mm ?? 0, hole),
  boss: (feature, { part }) => cylinder(feature, feature.height_mm ?? 0, part),
};

function stylusOf(radius, material) {
  const length = radius * STYLUS_LENGTH;
  const shank = new Mesh(new CylinderGeometry(radius / 2, radius / 2, length, 24), material);
  shank.rotation.x = Math.PI / 2;
  shank.position.z = length / 2;
  const stylus = new Group();
  stylus.add(new Mesh(new SphereGeometry(radius, 32, 16), material), shank);
  return stylus;
}

const vector = (point) => new Vector3(...AXES.map((axis) => point[axis]));
const extentOf = ({ low, high }) => vector(low).distanceTo(vector(high));

/** From the front, right and above, so that all that matters is in sight. */
function lookAt(camera, controls, { low, high }, size) {
  const distance = (0.6 * size) / Math.tan((VIEW_ANGLE * Math.PI) / 360);
  controls.target.addVectors(vector(low), vector(high)).multiplyScalar(0.5);
  camera.position.copy(controls.target).add(new Vector3(0.45, -0.75, 0.5).normalize().multiplyScalar(distance));
  camera.near = size / 500;
  camera.far = size * 100;
}
