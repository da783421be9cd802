#pragma once

#include "nc/machine/geometry.hpp"

namespace fitgauge::machine {

/// A ball on a straight path; all in mm.
struct BallPath {
  Vec3 start;      ///< of its centre
  Vec3 direction;  ///< of length 1
  double radius = 0;
  double longest = 0;  ///< where the path ends

  Vec3 at(double way) const { return start + direction * way; }
  /// The rest of the path from `way` on.
  BallPath from(double way) const { return {at(way), direction, radius, longest - way}; }
};

}  // namespace fitgauge::machine
