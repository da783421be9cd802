#pragma once

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

/// What a run of a cycle has left, in its own coordinates.
struct Outcome {
  int error = 0;
  std::vector<double> values;
  std::vector<double> stored;  ///< what tables have made of it, in whole nanometres
};

/// Runs a case with `frames` active and its part placed in them, `displaced` from the drawing. The
/// values: its results, the coordinate of the face that was touched, the angle of the basic
/// rotation to the input system. Stored: what the measured centre reads with the preset that was
/// written.
Outcome run_in(const NominalCase& c, const machine::Frames& frames, const machine::Vec3& displaced);

}  // namespace fitgauge::probing
