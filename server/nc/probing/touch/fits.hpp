#pragma once

#include "nc/machine/geometry.hpp"
#include "nc/probing/cycle_descriptor.hpp"

namespace fitgauge::probing {

struct Circle {
  machine::Vec3 centre;  ///< at height 0
  double radius = 0;
  double residual = 0;  ///< the largest distance of a point from the circle
  /// Standard deviation of the diameter divided by that of a point along its radius: 1 with four
  /// points at right angles, 260 with four on an arc of 15 degrees.
  double diameter_factor = 1;
};

/// The circle through three points seen along z, or with the smallest sum of squared distances to
/// four and more (orthogonal distance regression by Gauss-Newton, not the algebraic fit).
/// @errors 1081 fewer than three points, or all on one line.
CycleResult<Circle> fit_circle(std::span<const machine::Vec3> points);

struct FittedSphere {
  machine::Vec3 centre;
  double radius = 0;
};

/// The sphere of least squared distances from the points (Gauss-Newton, exact for four of them),
/// searched from `near`; none if the points are in one plane, or on no sphere near it.
std::optional<FittedSphere> fit_sphere(std::span<const machine::Vec3> points,
                                       const FittedSphere& near);

struct FittedPlane {
  machine::Vec3 point;   ///< the mean of the points
  machine::Vec3 normal;  ///< of length 1
};

/// Fits a plane by least squared distances, exact for three points, with its normal on the side of
/// `towards`. None if fewer than three points are given, or if they are on a line or equally far
/// from every plane.
std::optional<FittedPlane> fit_plane(std::span<const machine::Vec3> points,
                                     const machine::Vec3& towards);

struct FittedCylinder {
  machine::Vec3 point;      ///< of the axis, the nearest to the mean of the points
  machine::Vec3 direction;  ///< of the axis, of length 1
  double radius = 0;
};

/// Fits a cylinder by least squared distances (Gauss-Newton), searched from `near`, whose direction
/// may have any length. None if the points do not determine it (fewer than five, or all in one
/// section), or if none is near it.
std::optional<FittedCylinder> fit_cylinder(std::span<const machine::Vec3> points,
                                           const FittedCylinder& near);

}  // namespace fitgauge::probing
