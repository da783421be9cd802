#pragma once

#include "nc/probing/touch/probing_motion.hpp"

namespace fitgauge::probing {

/// The rotary axis that turns around a linear one: A around X, B around Y, C around Z.
constexpr machine::Axis rotary_axis_around(machine::Axis linear) {
  return static_cast<machine::Axis>(index(linear) + 3);
}

/// Turns a rotary table so that what stands at `angle_deg` (right-handed around the linear axis of
/// the same letter) comes to 0.
/// @errors 1100 the axis turns the head, not the workpiece; a fault when the machine has no such
/// axis
///   or it would leave its range.
CycleResult<void> align_rotary_axis(const CycleContext& context, machine::Axis rotary,
                                    double angle_deg);

/// Makes the present position of a rotary axis read 0: of the active preset at once with row 0,
/// else in that row of the preset table.
/// @errors 1085 the row is write-protected.
CycleResult<void> zero_rotary_axis(const CycleContext& context, machine::Axis rotary, int row);

}  // namespace fitgauge::probing
