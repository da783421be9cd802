#pragma once

#include "nc/klartext/statement.hpp"
#include "nc/run/motion_words.hpp"

namespace fitgauge::interpreter {

/// A, B and C as spatial angles of the tool (FUNCTION TCPM AXIS SPAT), each as it was programmed
/// last.
using SpatialAngles = std::array<std::optional<double>, 3>;

/// Returns the positions turned by whole turns into the ranges of the axes, each nearest to `from`.
std::optional<machine::Vec3> in_range(const machine::MachineState& state, machine::Vec3 rotary,
                                      const machine::Vec3& from);

/// Positions of the rotary axes that point the tool along `normal`, a unit vector fixed to the
/// table: in their ranges and the nearest to `from`, in machine coordinates.
std::optional<machine::Vec3> rotary_along(const machine::MachineState& state,
                                          const machine::Vec3& normal, const machine::Vec3& from);

/// TX TY TZ or NX NY NZ of an LN block, by their first letter. @errors it has no length.
NcResult<std::optional<machine::Vec3>> vector_of(Channel& channel, const klartext::Motion& motion,
                                                 klartext::Letter first);

/// Adds the positions of the rotary axes to a block that defines the tool's direction in the input
/// system: LN by its tool vector, else by its normal, any line by spatial angles. Of the positions
/// in the range of the axes the nearest is used.
/// @errors 1013 no position of the axes reaches it; a vector without length; the first block under
///   AXIS SPAT that turns the tool omits an angle.
NcResult<void> orient_tool(Channel& channel, const klartext::Motion& motion, MotionWords& words);

}  // namespace fitgauge::interpreter
