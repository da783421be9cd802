#pragma once

#include "nc/probing/touch/circle_fit.hpp"
#include "nc/probing/touch/probing_motion.hpp"

namespace fitgauge::probing {

struct Corner {
  Point2 point;    ///< where the two edges meet
  Vec3 direction;  ///< of the first edge
};

/// The corner of two edges, each touched twice: the first two touches on the edge along the main
/// axis, the others on the one along the secondary axis. Each edge lies one ball radius from the
/// line through its ball centres, so that a turned part is compensated along its own normals.
/// @errors 1081 the edges are parallel or their points coincide.
CycleResult<Corner> corner_of(std::span<const Contact> contacts, std::span<const Touch> touches,
                              double ball_radius);

/// Where the lines a1-a2 and b1-b2 meet. @errors 1081 they are parallel.
CycleResult<Point2> intersection(Point2 a1, Point2 a2, Point2 b1, Point2 b2);

}  // namespace fitgauge::probing
