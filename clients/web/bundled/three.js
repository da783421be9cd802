/** What the page takes from three.js (scripts/cmake/bundle_web.mjs). */

export {
  BackSide, BufferAttribute, BufferGeometry, CanvasTexture, Color, CylinderGeometry, DirectionalLight, ExtrudeGeometry, Group, HemisphereLight,
  LineBasicMaterial, LineDashedMaterial, LineSegments, Mesh, MeshLambertMaterial, OrthographicCamera, Path, Points, PointsMaterial, Scene, Shape, SphereGeometry, Vector3, WebGLRenderer,
} from 'three';
export { OrbitControls } from 'three/addons/controls/OrbitControls.js';
