#pragma once

#include <vector>

#include "nc/machine/machine.hpp"
#include "nc/run/nc_error.hpp"
#include "nc/run/run_budget.hpp"

namespace fitgauge::interpreter {

/// The rotary axes at a part of a block's way, from 0 to 1, in machine coordinates.
struct VectorStop {
  double part;
  machine::Vec3 rotary;
};

/// PATHCTRL VECTOR: the tool, seen from the workpiece, turns evenly in the plane of its first and
/// its last direction. Between two stops the rotary axes move evenly; there it leaves the plane by
/// less than a thousandth of a degree, except next to a position where an axis turns without
/// turning the tool. The last stop is `to`. @errors 1013 an axis does not reach a direction
/// between.
NcResult<std::vector<VectorStop>> vector_stops(const machine::MachineState& state,
                                               const machine::Vec3& from, const machine::Vec3& to,
                                               RunBudget& budget);

}  // namespace fitgauge::interpreter
