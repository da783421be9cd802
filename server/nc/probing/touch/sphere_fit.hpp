#pragma once

#include <optional>
#include <span>

#include "nc/machine/geometry.hpp"

namespace fitgauge::probing {

struct FittedSphere {
  machine::Vec3 centre;
  double radius = 0;
};

/// The sphere of least squared distances from the points (Gauss-Newton, exact for four of them),
/// searched from `near`; nothing where the points lie in one plane, or on no sphere near it.
std::optional<FittedSphere> fit_sphere(std::span<const machine::Vec3> points,
                                       const FittedSphere& near);

}  // namespace fitgauge::probing
