#pragma once

#include "nc/probing/touch/circle_probing.hpp"

namespace fitgauge::probing {

struct Rectangle {
  Point2 centre;
  std::array<double, 2> length{};  ///< along main and secondary axis
};

/// Touches the rectangle of that nominal centre and length (main, secondary axis) by Q261, Q320,
/// Q260 and Q301: along the axes of the plane, twice along each, through its nominal centre;
/// paraxially at measuring height or over the clearance height. A pocket too small for the start
/// distance is touched from its centre.
CycleResult<Rectangle> probe_rectangle(const CycleContext& context, ProbingMotion& motion,
                                       Side side, Point2 centre,
                                       const std::array<double, 2>& length);

/// The two touches along one axis (0 main, 1 secondary) of a slot, pocket, ridge or stud of the
/// nominal width around its centre, first the one at the higher coordinate.
std::array<Touch, 2> width_touches(Side side, const Vec3& centre, std::size_t axis, double width,
                                   double start_distance);

}  // namespace fitgauge::probing
