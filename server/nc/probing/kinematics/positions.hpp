#pragma once

#include <vector>

#include "nc/machine/machine_state.hpp"
#include "nc/probing/arguments.hpp"

namespace fitgauge::probing {

/// What a block says about one rotary axis, and where it is to be measured.
struct AxisPlan {
  machine::Axis axis = machine::Axis::A;
  double start = 0;      ///< degrees
  double end = 0;        ///< degrees
  double incidence = 0;  ///< where it stands while the other axes are measured, in degrees
  int points = 0;        ///< 0: it is not measured
  bool strobed = false;  ///< positioned by an M function (mStrobeRotAxPos, decision 19)
  double grid = 0;       ///< of a Hirth axis, in degrees; 0 is none
  std::vector<double> positions{};  ///< in order; 0 is left out, the reference is measured there

  bool is_measured() const { return points > 0; }
};

/// `points` positions from `start` to `end` at equal steps. A Hirth axis stops at the nearest
/// multiple of its grid, of two equally near ones at that away from zero (decision 5).
std::vector<double> measuring_positions(double start, double end, int points, double grid);

/// The plans of the rotary axes that the machine has, in the order A, B, C; what the block says
/// about others counts for nothing.
/// @errors 1005 an axis that an M function positions does not stand at 0, 1100 the machine has no
/// rotary axis, 1101 a position, or what backlash (Q432) needs on
///   either side of it, is outside the range of its axis.
CycleResult<std::vector<AxisPlan>> plan_positions(const Arguments& arguments,
                                                  const machine::MachineState& state);

}  // namespace fitgauge::probing
