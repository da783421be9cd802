#pragma once

#include <vector>

#include "probing/circle_probing.hpp"

namespace fitgauge::probing {

/// The centres of holes near the given points: each is touched four times from there, along the
/// axes of the plane at measuring height; between the holes the probe goes over the clearance
/// height.
/// @errors 1014 a hole is wider than DIST reaches, 1081.
CycleResult<std::vector<Point2>> probe_hole_centres(ProbingMotion& motion,
                                                    std::span<const Point2> nominal, double height,
                                                    double clearance_height);

/// Three holes on the pitch circle of Q262 around a centre, at the angles Q291, Q292, Q293.
std::vector<Point2> bolt_circle_holes(const Arguments& arguments, Point2 centre);

}  // namespace fitgauge::probing
