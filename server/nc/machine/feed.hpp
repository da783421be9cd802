#pragma once

#include <limits>

namespace fitgauge::machine {

/// How fast a move is, in mm/min of the tool tip, in degrees/min when only rotary axes move.
struct Feed {
  bool is_rapid = true;
  double rate = std::numeric_limits<double>::infinity();  ///< of a rapid: at most, if slower

  /// FMAX: the machine's rapid, or `at_most` (FMAX of tchprobe.tp) if that is slower.
  static Feed rapid(double at_most = std::numeric_limits<double>::infinity()) {
    return {true, at_most};
  }
  static Feed at(double mm_min) { return {false, mm_min}; }

  /// The rate on a machine whose rapid is `machine_rapid`.
  double rate_on(double machine_rapid) const {
    return is_rapid && machine_rapid < rate ? machine_rapid : rate;
  }
};

}  // namespace fitgauge::machine
