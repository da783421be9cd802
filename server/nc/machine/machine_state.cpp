#include "nc/machine/machine_state.hpp"

namespace fitgauge::machine {

double MachineState::tool_length() const {
  const Tool* row = active_tool();
  if (row == nullptr) return 0;
  return (row->lathe ? row->lathe->zl + row->lathe->dzl : row->l + row->dl) + tool.dl;
}

double MachineState::tool_radius() const {
  const Tool* row = active_tool();
  return row == nullptr ? 0 : row->r + row->dr + tool.dr;
}

std::optional<ProbeSystem> MachineState::probe_system() const {
  const Tool* row = active_tool();
  if (row == nullptr || !row->is_probe()) return std::nullopt;
  const ProbeRow* data = probes.find(row->probe);
  if (data == nullptr) return std::nullopt;
  return ProbeSystem{*data, tool_length(), tool_radius()};
}

Vec3 MachineState::tool_direction(CoordinateSystem system) const {
  const Vec3 machine = kinematics.tool_direction(nose.rotary, tool_axis());
  return unit(frames.direction_from_machine(machine, system));
}

Position MachineState::position(CoordinateSystem system) const {
  if (system == CoordinateSystem::Reference) return nose;
  const Vec3 tip = nose.linear + kinematics.tool_vector(nose.rotary, tool_axis(), tool_length());
  return {frames.from_machine(tip, system), frames.rotary_from_machine(nose.rotary, system)};
}

Vec3 MachineState::ball_centre(CoordinateSystem system) const {
  const double length = tool_length() - tool_radius();
  return frames.from_machine(nose.linear + kinematics.tool_vector(nose.rotary, tool_axis(), length),
                             system);
}

}  // namespace fitgauge::machine
