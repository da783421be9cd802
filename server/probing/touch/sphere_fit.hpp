#pragma once

#include <span>

#include "machine/geometry.hpp"

namespace fitgauge::probing {

struct FittedSphere {
  machine::Vec3 centre;
  double radius = 0;
};

/// The sphere of least squared distances from the points (Gauss-Newton, exact for four of them),
/// searched from `near`. @pre four or more points that are not in one plane.
FittedSphere fit_sphere(std::span<const machine::Vec3> points, const FittedSphere& near);

}  // namespace fitgauge::probing
