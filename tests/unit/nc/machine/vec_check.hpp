#pragma once

#include <doctest/doctest.h>

#include "nc/machine/geometry.hpp"

namespace fitgauge::machine {

/// Compares within `tolerance` mm in each coordinate and shows all three on failure.
inline void check_near(const Vec3& actual, const Vec3& expected, double tolerance = 1e-9) {
  INFO("actual   ", actual.x, " ", actual.y, " ", actual.z);
  INFO("expected ", expected.x, " ", expected.y, " ", expected.z);
  CHECK(norm(actual - expected) <= tolerance);
}

inline bool near(double actual, double expected, double tolerance = 1e-9) {
  return std::abs(actual - expected) <= tolerance;
}

}  // namespace fitgauge::machine
