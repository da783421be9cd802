/** The part in space: a block with its bores, whole or cut through a bore, bosses, the stylus, the sphere on its table. */

import { BackSide, CylinderGeometry, ExtrudeGeometry, Group, Mesh, Path, Shape, SphereGeometry } from '../bundled/three.js';

/** Points in a cylinder's circle. */
const ROUND = 64;
const STYLUS_LENGTH = 12; // of its ball's radius
/** As the service has it. */
const DEPTH_MM = 30;
const TABLE_THICKNESS = 0.1; // of its radius

const isInside = ({ center_mm: [x, y], diameter_mm: d }, { min_mm: low, max_mm: high }) =>
  x - d / 2 > low[0] && x + d / 2 < high[0] && y - d / 2 > low[1] && y + d / 2 < high[1];
const bottomOf = ({ top_mm: top = 0, depth_mm: depth = DEPTH_MM }) => top - depth;

/** The bores that are cut out of a block. */
export const boresOf = (block, features) => features.filter((one) => one.type === 'bore' && isInside(one, block));

/** Its outline from above; from `cut` on the front is away, through the bores in its way. */
function outline({ min_mm: low, max_mm: high }, bores, cut) {
  const shape = new Shape();
  const front = cut ?? low[1];
  shape.moveTo(low[0], front);
  const across = ({ center_mm: [, y], diameter_mm: d }) => Math.abs(front - y) < d / 2;
  for (const { center_mm: [x, y], diameter_mm: d } of bores.filter(across).sort((one, other) => one.center_mm[0] - other.center_mm[0])) {
    const angle = Math.asin((front - y) / (d / 2));
    shape.lineTo(x - (d / 2) * Math.cos(angle), front);
    shape.absarc(x, y, d / 2, Math.PI - angle, angle, true);
  }
  [[high[0], front], [high[0], high[1]], [low[0], high[1]]].forEach(([x, y]) => shape.lineTo(x, y));
  shape.holes = bores.filter((bore) => !across(bore) && bore.center_mm[1] > front)
    .map(({ center_mm: [x, y], diameter_mm: d }) => new Path().absarc(x, y, d / 2, 0, 2 * Math.PI, true));
  return shape;
}

/** Slabs between the heights at which a bore begins or ends. @param cut Y of the section in mm, or null */
export function blockOf(block, features, cut, material) {
  const bores = boresOf(block, features);
  const [bottom, top] = [block.min_mm[2], block.max_mm[2]];
  const heights = bores.flatMap((bore) => [bore.top_mm ?? 0, bottomOf(bore)]).filter((z) => z > bottom && z < top);
  const levels = [...new Set([bottom, top, ...heights])].sort((one, other) => one - other);
  const group = new Group();
  levels.slice(1).forEach((upper, i) => {
    const lower = levels[i];
    const open = bores.filter((bore) => bottomOf(bore) <= lower && (bore.top_mm ?? 0) >= upper);
    const mesh = new Mesh(new ExtrudeGeometry(outline(block, open, cut), { depth: upper - lower, bevelEnabled: false, curveSegments: ROUND }), material);
    mesh.position.z = lower;
    group.add(mesh);
  });
  return group;
}

function cylinder({ center_mm: [x, y], diameter_mm: diameter, top_mm: top = 0 }, length, material) {
  const mesh = new Mesh(new CylinderGeometry(diameter / 2, diameter / 2, length, ROUND, 1, material.side === BackSide), material);
  mesh.rotation.x = Math.PI / 2; // its axis is Y
  mesh.position.set(x, y, top - length / 2);
  return mesh;
}

/** A ball about a point. */
export const ball = ([x, y, z], radius, material) => {
  const mesh = new Mesh(new SphereGeometry(radius, 32, 16), material);
  mesh.position.set(x, y, z);
  return mesh;
};

/** The features that have a simple shape; the others are known by their contacts. A bore in a block is part of the block. */
const SOLIDS = {
  block: (feature, features, cut, { part }) => blockOf(feature, features, cut, part),
  bore: (feature, features, cut, { hole }) => (features.some((one) => one.type === 'block' && isInside(feature, one))
    ? null : cylinder(feature, feature.depth_mm ?? DEPTH_MM, hole)),
  boss: (feature, features, cut, { part }) => cylinder(feature, feature.height_mm ?? 0, part),
  sphere: ({ center_mm: centre, diameter_mm: diameter }, features, cut, { part }) => ball(centre, diameter / 2, part),
};

/** All of them. @param cut Y of the section in mm, or null */
export function solidsOf(features, cut, materials) {
  const group = new Group();
  for (const one of features) {
    const solid = SOLIDS[one.type]?.(one, features, cut, materials);
    if (solid) group.add(solid);
  }
  return group;
}

export function stylusOf(radius, material) {
  const length = radius * STYLUS_LENGTH;
  const shank = new Mesh(new CylinderGeometry(radius / 2, radius / 2, length, 24), material);
  shank.rotation.x = Math.PI / 2;
  shank.position.z = length / 2;
  const stylus = new Group();
  stylus.add(new Mesh(new SphereGeometry(radius, 32, 16), material), shank);
  return stylus;
}

/** The sphere on its stand on the table, whose top is at the machine's Z 0, about the sphere's centre. */
export function tableOf({ center_mm: [x, y, z], radius_mm: radius }, { part }) {
  const size = Math.hypot(x, y) + 2 * radius;
  const thickness = TABLE_THICKNESS * size;
  const stand = Math.max(z, radius);
  const group = new Group();
  group.add(ball([0, 0, 0], radius, part),
    cylinder({ center_mm: [0, 0], diameter_mm: radius / 2 }, stand, part),
    cylinder({ center_mm: [-x, -y], diameter_mm: 2 * size, top_mm: -stand }, thickness, part));
  return group;
}
