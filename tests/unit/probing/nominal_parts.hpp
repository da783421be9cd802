#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "probing_bench.hpp"

namespace fitgauge::probing {

/// A part that equals its drawing, a block that measures it, and the nominal values of its results.
struct NominalCase {
  int cycle;
  std::vector<machine::Feature> part;
  machine::Vec3 start;  ///< of the tip
  Values block;
  std::vector<std::pair<int, double>> results;
  /// The face that was touched last, of cycles without results: an axis and the coordinate.
  std::optional<std::pair<std::size_t, double>> touched{};
  bool only_right_angles = false;  ///< the part has faces along the axes
};

/// One for each cycle that touches the workpiece to measure, set a datum or align.
std::vector<NominalCase> nominal_cases();

}  // namespace fitgauge::probing
