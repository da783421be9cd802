#include "nc/probing/alignment/rotary_alignment.hpp"

#include "nc/probing/measured_value.hpp"

namespace fitgauge::probing {

using machine::Axis;

CycleResult<void> align_rotary_axis(const CycleContext& context, Axis rotary, double angle_deg) {
  using machine::FaultKind;
  const machine::MachineState& state = context.machine.state();
  const machine::RotaryAxis* axis = state.kinematics.find(rotary);
  if (axis == nullptr) return from_machine(make_fault(FaultKind::AxisMissing, name(rotary)));
  if (axis->mount == machine::AxisMount::Head) {
    return nc_error(1100, "the rotary axis does not turn the workpiece");
  }
  // A positive angle turns the tool right-handed around the axis, seen from the workpiece.
  const double sense = dot(axis->direction, unit_vector(rotary)) < 0 ? -1 : 1;
  machine::AxisWords target;
  target[rotary] = to_angle(context.machine.position()[rotary] + sense * angle_deg);
  return lift(context.machine.move({target, machine::Feed::rapid()}));
}

CycleResult<void> zero_rotary_axis(const CycleContext& context, Axis rotary, int row) {
  const machine::MachineState& state = context.machine.state();
  const std::size_t offset = index(rotary) - 3;
  machine::Frames frames = state.frames;
  machine::PresetFrame active = frames.preset();
  active.rotary_offsets_deg[offset] = state.nose[rotary];
  if (row == 0) {
    frames.set_preset(active);
    return lift(context.machine.set_frames(frames));
  }
  machine::Preset preset{.number = row, .comment = {}, .frame = active};
  if (const machine::Preset* existing = state.presets.find(row)) preset = *existing;
  preset.frame.rotary_offsets_deg[offset] = active.rotary_offsets_deg[offset];
  return lift(context.machine.write_preset(preset));
}

}  // namespace fitgauge::probing
