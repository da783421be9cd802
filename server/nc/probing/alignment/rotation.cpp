#include "nc/probing/alignment/rotation.hpp"

namespace fitgauge::probing {

using machine::CoordinateSystem;
using machine::Frames;
using machine::Matrix3;

Matrix3 tilt_of(const Frames& frames) {
  return frames.plane() ? Matrix3::spatial(frames.plane()->spatial_deg) : Matrix3{};
}

double workpiece_angle(const Frames& frames, const WorkingPlane& plane, const Vec3& direction,
                       double reference_deg) {
  const Vec3 machine = frames.direction_to_machine(plane.to_input(direction));
  const Vec3 workpiece = frames.direction_from_machine(machine, CoordinateSystem::Workpiece);
  const Vec3 along = plane.from_input(tilt_of(frames).transposed() * workpiece);
  const double angle =
      std::remainder(machine::degrees(std::atan2(along.y, along.x)) - reference_deg, 180);
  return angle == -90 ? 90 : angle;
}

Vec3 turned_rotation(const Frames& frames, const WorkingPlane& plane, const Matrix3& turn) {
  Matrix3 axes;  // of the plane, in the workpiece system
  for (std::size_t i = 0; i < 3; ++i) {
    Vec3 along;
    along[i] = 1;
    axes.rows.at(i) = frames.direction_from_machine(
        frames.direction_to_machine(plane.to_input(along)), CoordinateSystem::Workpiece);
  }
  const Vec3 angles = machine::spatial_angles(Matrix3::spatial(frames.preset().basic_rotation_deg) *
                                              axes.transposed() * turn * axes);
  return {to_angle(angles.x), to_angle(angles.y), to_angle(angles.z)};
}

CycleResult<void> replace_active_preset(machine::Machine& machine,
                                        const machine::PresetFrame& preset) {
  Frames frames = machine.state().frames;
  frames.set_preset(preset);
  return machine.set_frames(frames);
}

CycleResult<void> reset_basic_rotation(machine::Machine& machine) {
  machine::PresetFrame preset = machine.state().frames.preset();
  if (preset.basic_rotation_deg == Vec3{}) return {};
  preset.basic_rotation_deg = {};
  return replace_active_preset(machine, preset);
}

CycleResult<void> begin_without_rotation(const CycleContext& context) {
  const Vec3 rotation = context.state().frames.preset().basic_rotation_deg;
  if (rotation == Vec3{}) return {};
  const std::string shown =
      rotation.x == 0 && rotation.y == 0
          ? fmt::format("{:g}", rotation.z)
          : fmt::format("SPA{:+g} SPB{:+g} SPC{:+g}", rotation.x, rotation.y, rotation.z);
  TRY(
      context.host.note(fmt::format("basic rotation of {} degrees is reset by cycle {}: its "
                                    "coordinates and all later coordinates count without it",
                                    shown, context.descriptor().number)));
  return reset_basic_rotation(context.machine);
}

CycleResult<ProbingMotion> begin_alignment(const CycleContext& context) {
  TRY(refuse_mirror_and_scaling(context.state().frames));
  auto motion = ProbingMotion::begin(context);
  if (!motion) return motion;
  TRY(begin_without_rotation(context));
  return motion;
}

CycleResult<void> set_basic_rotation(const CycleContext& context, const Vec3& rotation_deg,
                                     int row) {
  const machine::MachineState& state = context.state();
  if (row != 0) {
    machine::Preset preset = state.preset_row(row < 0 ? state.active_preset : row);
    preset.frame.basic_rotation_deg = rotation_deg;
    TRY(context.machine.write_preset(preset));
  }
  if (row > 0) return {};
  machine::PresetFrame active = state.frames.preset();
  active.basic_rotation_deg = rotation_deg;
  return replace_active_preset(context.machine, active);
}

using machine::Axis;

CycleResult<double> table_angle(const machine::MachineState& state, Axis rotary, double angle_deg) {
  using machine::FaultKind;
  const machine::RotaryAxis* axis = state.kinematics.find(rotary);
  if (axis == nullptr) return make_fault(FaultKind::AxisMissing, name(rotary));
  if (axis->mount == machine::AxisMount::Head)
    return nc_error(1100, "the rotary axis does not turn the workpiece");
  // A positive angle turns the tool right-handed around the axis, seen from the workpiece.
  return dot(axis->direction, unit_vector(rotary)) < 0 ? -angle_deg : angle_deg;
}

CycleResult<void> align_rotary_axis(const CycleContext& context, Axis rotary, double angle_deg) {
  const auto turn = TRY(table_angle(context.state(), rotary, angle_deg));
  machine::AxisWords target;
  target[rotary] = to_angle(context.machine.position()[rotary] + turn);
  return context.machine.move({target, machine::Feed::rapid()});
}

CycleResult<void> zero_rotary_axis(const CycleContext& context, Axis rotary, int row) {
  const machine::MachineState& state = context.state();
  const std::size_t offset = index(rotary) - 3;
  if (row == 0) {
    machine::PresetFrame active = state.frames.preset();
    active.rotary_offsets_deg[offset] = state.nose[rotary];
    return replace_active_preset(context.machine, active);
  }
  machine::Preset preset = state.preset_row(row);
  preset.frame.rotary_offsets_deg[offset] = state.nose[rotary];
  return context.machine.write_preset(preset);
}

}  // namespace fitgauge::probing
