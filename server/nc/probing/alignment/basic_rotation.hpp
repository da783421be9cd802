#pragma once

#include "nc/probing/touch/probing_motion.hpp"

namespace fitgauge::probing {

/// The tilted plane in the workpiece system; the identity without one.
machine::Matrix3 tilt_of(const machine::Frames& frames);

/// The angle, -90 < angle <= 90, from the main axis to a line in the plane: the main axis of the
/// workpiece system, or of the tilted plane when one is active.
/// @param direction of the line, in plane coordinates of the input system.
double workpiece_angle(const machine::Frames& frames, const WorkingPlane& plane,
                       const Vec3& direction);

/// The spatial angles of the active basic rotation after a further turn by `angle_deg` around the
/// probe axis of the workpiece system, or of the tilted plane when one is active.
Vec3 turned_rotation(const machine::Frames& frames, machine::Axis probe, double angle_deg);

/// Measuring and alignment cycles begin without a basic rotation.
CycleResult<void> reset_basic_rotation(machine::Machine& machine);

/// What every alignment cycle begins with: resets an active basic rotation.
/// @errors 1008 and 1007 with mirror and scaling active; those of ProbingMotion::begin.
CycleResult<ProbingMotion> begin_alignment(const CycleContext& context);

/// Sets the basic rotation, in spatial angles. Row 0: active at once, in no table; -1: also in the
/// row of the active preset; otherwise only stored in that row (one that does not exist yet begins
/// as the active preset) until cycle 247 activates it.
/// @errors 1085 the row is write-protected.
CycleResult<void> set_basic_rotation(const CycleContext& context, const Vec3& rotation_deg,
                                     int row);

}  // namespace fitgauge::probing
