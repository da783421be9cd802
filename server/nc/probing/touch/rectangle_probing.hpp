#pragma once

#include "nc/probing/touch/circle_probing.hpp"

namespace fitgauge::probing {

/// Plan for touching a rectangle along the axes of the plane: twice along each axis, through its
/// nominal centre.
struct RectanglePlan {
  Side side = Side::Inside;
  Point2 centre;
  double length_main = 0;
  double length_secondary = 0;
  double height = 0;  ///< of the ball centre (Q261)
  double start_distance = 0;
  bool via_clearance = false;  ///< Q301
};

struct Rectangle {
  Point2 centre;
  double length_main = 0;
  double length_secondary = 0;
};

/// Touches the rectangle, paraxially at measuring height or over the clearance height. A pocket too
/// small for the start distance is touched from its centre.
CycleResult<Rectangle> probe_rectangle(const CycleContext& context, ProbingMotion& motion,
                                       const RectanglePlan& plan, double clearance_height);

/// The two touches along one axis (0 main, 1 secondary) of a slot, pocket, ridge or stud of the
/// nominal width around its centre, first the one at the higher coordinate.
std::array<Touch, 2> width_touches(Side side, const Vec3& centre, std::size_t axis, double width,
                                   double start_distance);

}  // namespace fitgauge::probing
