/** Outlines of the simple features of a workpiece, as a background for a path. */

const point = ([X, Y, Z]) => ({ X, Y, Z });

function box(low, high) {
  return [[low[0], low[1], low[2]], [high[0], low[1], low[2]], [high[0], high[1], high[2]], [low[0], high[1], high[2]]].map(point);
}

function cylinder(kind, { center_mm: [x, y], diameter_mm: diameter }, bottom, top, up) {
  const radius = diameter / 2;
  const corners = box([x - radius, y - radius, bottom], [x + radius, y + radius, top]);
  return up === 'Y' ? { kind, points: corners, round: { centre: { X: x, Y: y }, radius } } : { kind, points: side(corners) };
}

/** Seen from the side a box is the rectangle of its X and Z. */
function side(corners) {
  const [low, , high] = corners;
  return [[low.X, 0, low.Z], [high.X, 0, low.Z], [high.X, 0, high.Z], [low.X, 0, high.Z]].map(point);
}

/** Of a measured surface the material below its lowest point, as thick as a tenth of its length. */
function below({ points_mm: points }) {
  const [low, high] = [Math.min, Math.max].map((most) => [0, 1, 2].map((axis) => points.map((each) => each[axis]).reduce((one, other) => most(one, other))));
  const thickness = Math.max(high[0] - low[0], high[1] - low[1]) / 10;
  return { type: 'block', min_mm: [low[0], low[1], low[2] - thickness], max_mm: [high[0], high[1], low[2]] };
}

/** The features as they are drawn. */
export const drawnFeatures = (features) => features.map((feature) => (feature.type === 'surface' ? below(feature) : feature));

const OUTLINES = {
  block: (feature, up) => {
    const corners = box(feature.min_mm, feature.max_mm);
    return { kind: 'block', points: up === 'Y' ? corners : side(corners) };
  },
  bore: (feature, up) => cylinder('bore', feature, (feature.top_mm ?? 0) - (feature.depth_mm ?? 0), feature.top_mm ?? 0, up),
  boss: (feature, up) => cylinder('boss', feature, (feature.top_mm ?? 0) - (feature.height_mm ?? 0), feature.top_mm ?? 0, up),
};

/** {kind, points} of each feature that has an outline; `round` where it is a circle. */
export const outlines = (features, up) =>
  features.filter((feature) => feature.type in OUTLINES).map((feature) => OUTLINES[feature.type](feature, up));
