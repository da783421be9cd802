#pragma once

#include "nc/probing/touch/probing_motion.hpp"

namespace fitgauge::probing {

/// Q267. @errors 1042 it is 0.
CycleResult<int> probing_direction(const Arguments& arguments);

struct TouchedCoordinate {
  std::size_t axis = 0;  ///< 0 main, 1 secondary, 2 probe axis (Q272)
  Vec3 nominal;          ///< Q263, Q264, Q261
  Vec3 surface;          ///< in plane coordinates
};

/// One touch along an axis at Q263, Q264, Q261 in the direction Q267, as 419 and 427 make it.
/// @errors 1042 no direction.
CycleResult<TouchedCoordinate> touch_coordinate(const CycleContext& context, ProbingMotion& motion);

/// One touch at a point against the probe axis, as in 417 and for Q381.
CycleResult<Vec3> touch_down(ProbingMotion& motion, const Vec3& nominal, double q320,
                             double clearance_height);

}  // namespace fitgauge::probing
