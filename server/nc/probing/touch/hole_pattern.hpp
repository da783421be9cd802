#pragma once

#include <vector>

#include "nc/probing/touch/circle_probing.hpp"

namespace fitgauge::probing {

/// The centres of holes near the given points: each is touched four times from there, along the
/// axes of the plane at measuring height; between the holes the probe goes over the clearance
/// height.
/// @errors 1014 a hole is wider than DIST reaches, 1081.
CycleResult<std::vector<Point2>> probe_hole_centres(ProbingMotion& motion,
                                                    std::span<const Point2> nominal, double height,
                                                    double clearance_height);

/// The circle through three holes around Q273 and Q274, of the parameters Q262, Q291, Q292, Q293,
/// Q261, Q260.
CycleResult<ProbedCircle> probe_bolt_circle(const CycleContext& context, ProbingMotion& motion);

}  // namespace fitgauge::probing
