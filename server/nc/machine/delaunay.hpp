#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "nc/machine/geometry.hpp"

namespace fitgauge::machine {

/// A Delaunay triangulation of points in X and Y.
struct Triangulation {
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< counter-clockwise, indices of points
  std::vector<std::uint32_t> hull;                      ///< counter-clockwise
};

/// Empty if all points are on one line. Of points at the same X and Y only one is used.
/// Orientations are decided exactly on a grid of 1 nm; four points on one circle may have either
/// diagonal. @pre coordinates are within ±1e6 mm.
Triangulation delaunay(const std::vector<Vec3>& points);

}  // namespace fitgauge::machine
