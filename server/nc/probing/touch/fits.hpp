#pragma once

#include <optional>
#include <span>

#include "nc/machine/geometry.hpp"
#include "nc/probing/cycle_fault.hpp"

namespace fitgauge::probing {

struct Point2 {
  double x = 0;
  double y = 0;
};

struct Circle {
  Point2 centre;
  double radius = 0;
  double residual = 0;  ///< the largest distance of a point from the circle
  /// The standard deviation of the diameter over that of a point along its radius: 1 with four
  /// points at right angles, 260 with four on an arc of 15 degrees.
  double diameter_factor = 1;
};

/// The circle through three points, or with the smallest sum of squared distances to four and more
/// (orthogonal distance regression by Gauss-Newton, not the algebraic fit).
/// @errors 1081 fewer than three points, or all on one line.
CycleResult<Circle> fit_circle(std::span<const Point2> points);

struct FittedSphere {
  machine::Vec3 centre;
  double radius = 0;
};

/// The sphere of least squared distances from the points (Gauss-Newton, exact for four of them),
/// searched from `near`; nothing where the points lie in one plane, or on no sphere near it.
std::optional<FittedSphere> fit_sphere(std::span<const machine::Vec3> points,
                                       const FittedSphere& near);

}  // namespace fitgauge::probing
