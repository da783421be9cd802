#pragma once

#include "nc/probing/touch/probing_motion.hpp"

namespace fitgauge::probing {

/// Returns the tilted plane in the workpiece system; the identity without one.
machine::Matrix3 tilt_of(const machine::Frames& frames);

/// Returns the angle, -90 < angle <= 90, from a reference line to a line in the plane. The
/// reference line is at `reference_deg` to the main axis of the workpiece system, or of the tilted
/// plane if one is active.
/// @param direction of the line, in plane coordinates of the input system.
double workpiece_angle(const machine::Frames& frames, const WorkingPlane& plane,
                       const Vec3& direction, double reference_deg = 0);

/// Returns the spatial angles of the active basic rotation after a further turn, in plane
/// coordinates of the input system. @pre nothing is mirrored or scaled.
Vec3 turned_rotation(const machine::Frames& frames, const WorkingPlane& plane,
                     const machine::Matrix3& turn);
/// Returns the spatial angles after a further turn around the probe axis.
inline Vec3 turned_rotation(const machine::Frames& frames, const WorkingPlane& plane,
                            double angle_deg) {
  return turned_rotation(frames, plane, machine::Matrix3::rotation({0, 0, 1}, angle_deg));
}

/// Replaces the active preset in the chain of frames, in no table.
CycleResult<void> replace_active_preset(machine::Machine& machine,
                                        const machine::PresetFrame& preset);

/// Resets the basic rotation: measuring and alignment cycles begin without one.
CycleResult<void> reset_basic_rotation(machine::Machine& machine);

/// Resets the basic rotation, with a note if there was one. @errors the output budget is spent.
CycleResult<void> begin_without_rotation(const CycleContext& context);

/// Begins every alignment cycle: resets an active basic rotation.
/// @errors 1008 and 1007 with mirror and scaling active; those of ProbingMotion::begin.
CycleResult<ProbingMotion> begin_alignment(const CycleContext& context);

/// Sets the basic rotation, in spatial angles. Row 0: active at once, in no table. Row -1: also in
/// the row of the active preset. Other rows: stored there until cycle 247 activates it; a new row
/// begins as the active preset.
/// @errors 1085 the row is write-protected.
CycleResult<void> set_basic_rotation(const CycleContext& context, const Vec3& rotation_deg,
                                     int row);

/// Returns the rotary axis that turns around a linear axis: A around X, B around Y, C around Z.
constexpr machine::Axis rotary_axis_around(machine::Axis linear) {
  return static_cast<machine::Axis>(index(linear) + 3);
}

/// Returns the angle by which a rotary table turns a direction at `angle_deg`, right-handed around
/// the linear axis of the same letter, to 0. @errors those of align_rotary_axis.
CycleResult<double> table_angle(const machine::MachineState& state, machine::Axis rotary,
                                double angle_deg);

/// Turns a rotary table so that a direction at `angle_deg` (right-handed around the linear axis of
/// the same letter) comes to 0.
/// @errors 1100 the axis turns the head, not the workpiece; a fault if the machine has no such axis
///   or it would leave its range.
CycleResult<void> align_rotary_axis(const CycleContext& context, machine::Axis rotary,
                                    double angle_deg);

/// Sets the present position of a rotary axis to 0: with row 0 in the active preset at once,
/// otherwise in that row of the preset table.
/// @errors 1085 the row is write-protected.
CycleResult<void> zero_rotary_axis(const CycleContext& context, machine::Axis rotary, int row);

}  // namespace fitgauge::probing
