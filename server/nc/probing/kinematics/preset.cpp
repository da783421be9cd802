#include "nc/probing/kinematics/preset.hpp"

#include <fmt/format.h>

#include "nc/probing/measured_value.hpp"

namespace fitgauge::probing {
namespace {

using machine::MachineState;
using machine::Preset;

CycleResult<void> set_preset(const CycleContext& context, KinematicsProbing& probing) {
  const auto reference = probing.measure({});
  if (!reference) return reference.error();
  const MachineState& state = context.machine.state();
  const Vec3 centre = on_table(*reference, state.kinematics, probing.tool());
  Preset row{.number = state.active_preset, .comment = {}, .frame = state.frames.preset()};
  if (const Preset* existing = state.presets.find(row.number)) row = *existing;
  row.frame.origin = {to_length(centre.x).to_mm(), to_length(centre.y).to_mm(),
                      to_length(centre.z).to_mm()};
  if (auto written = lift(context.machine.write_preset(row)); !written) return written;
  return lift(context.machine.activate_preset(row.number));
}

}  // namespace

CycleResult<void> PresetAtSphere::check(const CycleContext& context) const {
  const MachineState& state = context.machine.state();
  const Preset* row = state.presets.find(state.active_preset);
  if ((!sets_before_ && !sets_after_) || row == nullptr || !row->locked) return {};
  return from_machine(make_fault(machine::FaultKind::PresetLocked,
                                 fmt::format("the active preset {}", row->number)));
}

CycleResult<void> PresetAtSphere::before(const CycleContext& context,
                                         KinematicsProbing& probing) const {
  if (!sets_before_) return {};
  if (auto found = probing.find(); !found) return found;
  return set_preset(context, probing);
}

CycleResult<void> PresetAtSphere::after(const CycleContext& context,
                                        KinematicsProbing& probing) const {
  auto done = sets_after_ ? set_preset(context, probing) : probing.turn({});
  return done ? probing.retract() : done;
}

}  // namespace fitgauge::probing
