#include "nc/run/preassigned.hpp"

#include "nc/run/channel.hpp"

namespace fitgauge::interpreter {

void update_preassigned(Channel& channel) {
  const machine::MachineState& state = channel.machine().state();
  QParameters& q = channel.parameters;
  const bool is_inch = channel.calls.main_program().is_inch();
  const double unit = is_inch ? 25.4 : 1.0;
  q.set_q(108, state.tool_radius() / unit);
  q.set_q(109, state.tool.axis ? static_cast<double>(machine::index(*state.tool.axis)) : -1);
  q.set_q(110, static_cast<int>(state.modes.spindle));
  q.set_q(111, state.modes.coolant ? 1 : 0);
  q.set_q(113, is_inch ? 1 : 0);
  q.set_q(114, state.tool_length() / unit);
}

void set_plane_angles(Channel& channel, const machine::Vec3& rotary) {
  for (std::uint16_t i = 0; i < 3; ++i) {
    channel.parameters.set_q(static_cast<std::uint16_t>(120 + i), rotary[i]);
  }
}

}  // namespace fitgauge::interpreter
