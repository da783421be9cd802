#pragma once

#include "nc/machine/geometry.hpp"

namespace fitgauge::machine {

/// A Delaunay triangulation of points in X and Y.
struct Triangulation {
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< counter-clockwise, indices of points
  std::vector<std::uint32_t> hull;                      ///< counter-clockwise
};

/// Triangulates the points; empty if all are on one line. Points at one X and Y are used once.
/// Orientations are exact on a grid of 1 nm; four points on one circle may have either diagonal.
/// @pre coordinates are within ±1e6 mm.
Triangulation delaunay(const std::vector<Vec3>& points);

}  // namespace fitgauge::machine
