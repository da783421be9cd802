#include "nc/run/statements.hpp"

#include "nc/probing/alignment/rotation.hpp"

namespace fitgauge::interpreter {
namespace {

using machine::SpindleState;

/// Sets the modes of the machine that the block changes.
NcResult<void> set_modes(Channel& channel, const Modes& modes) {
  if (modes == channel.state().modes) return {};
  TRY(channel.machine().set_modes(modes));
  update_preassigned(channel);
  return {};
}

SpindleState stopped(SpindleState state) {
  switch (state) {
    case SpindleState::Clockwise: return SpindleState::StoppedAfterM3;
    case SpindleState::CounterClockwise: return SpindleState::StoppedAfterM4;
    default: return state;
  }
}

/// Returns the distance that the spindle nose can move along `direction` (machine coordinates)
/// before an axis reaches its limit.
double room(const MachineState& state, const Vec3& direction) {
  double room = std::numeric_limits<double>::infinity();
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto& range = state.ranges[axis];
    if (!range || std::abs(direction[axis]) < tolerance::kParallel) continue;
    const double limit = direction[axis] > 0 ? range->max : range->min;
    room = std::min(room, (limit - state.nose.linear[axis]) / direction[axis]);
  }
  return std::max(room, 0.0);
}

}  // namespace

NcResult<void> retract(Channel& channel, const MCall& call) {
  if (!call.to_limit && call.length.value_or(-1) < 0)
    return nc_error(1011, "a retraction needs MB with a length, or MB MAX");
  const MachineState& state = channel.state();
  const Vec3 direction = state.tool_direction(CoordinateSystem::Reference);
  const double length = call.to_limit ? room(state, direction) : call.length.value_or(0);
  const Vec3 target = state.nose.linear + direction * length;
  return channel.machine().move(
      {AxisWords::linear(target), call.feed.value_or(Feed::rapid()), CoordinateSystem::Reference});
}

NcResult<void> start_m_functions(Channel& channel, const std::vector<MCall>& calls) {
  Modes modes = channel.state().modes;
  for (const MCall& call : calls) {
    switch (call.number) {
      case 13: modes.coolant = true; [[fallthrough]];
      case 3: modes.spindle = SpindleState::Clockwise; break;
      case 14: modes.coolant = true; [[fallthrough]];
      case 4: modes.spindle = SpindleState::CounterClockwise; break;
      case 8: modes.coolant = true; break;
      case 116: modes.feed_at_circumference = true; break;
      case 117: modes.feed_at_circumference = false; break;
      case 128:
      case 129:
        modes.tcpm = call.number == 128;
        channel.spatial_angles.reset();
        channel.turns_along_vector = false;
        break;
      case 144: modes.kinematics_in_display = true; break;
      case 145: modes.kinematics_in_display = false; break;
      case 143:
        TRY(channel.contour.finish(channel.machine()));
        TRY(probing::reset_basic_rotation(channel.machine()));
        break;
      default: break;
    }
  }
  return set_modes(channel, modes);
}

NcResult<Next> end_m_functions(Channel& channel, const MotionWords& words) {
  Modes modes = channel.state().modes;
  bool stops = false;
  bool ends = false;
  bool calls_cycle = channel.active_cycle.after_every_block && words.names_axes();
  const bool stands = std::ranges::any_of(words.m, [](const MCall& call) {
    return call.number <= 2 || call.number == 30 || call.number == 140;
  });
  if (stands) TRY(channel.contour.finish(channel.machine()));
  for (const MCall& call : words.m) {
    switch (call.number) {
      case 0:
      case 1: stops = true; break;
      case 2:
      case 30: ends = true; [[fallthrough]];
      case 5:
      case 6:
        modes.spindle = stopped(modes.spindle);
        if (ends) modes.coolant = false;
        break;
      case 9: modes.coolant = false; break;
      case 89: channel.active_cycle.after_every_block = calls_cycle = true; break;
      case 99:
        calls_cycle = true;
        channel.active_cycle.after_every_block = false;
        break;
      case 140: TRY(retract(channel, call)); break;
      default: break;
    }
  }
  if (calls_cycle) {
    auto next = call_active_cycle(channel);
    if (!next || next->kind != Next::Kind::Block) return next;
  }
  TRY(set_modes(channel, modes));
  if (stops) {
    const char* reason = words.has_m(0) ? "programmed stop M0" : "optional stop M1";
    TRY(channel.programmed_stop(reason));
  }
  for (const MCall& call : words.m) {
    if (call.program == nullptr) continue;
    if (ends || calls_cycle) {
      return nc_error("M{} calls a program: write M2, M30, M89 and M99 into another block",
                      call.number);
    }
    return call_program(channel, *call.program);
  }
  if (ends) return Next{.kind = Next::Kind::EndRun};
  return Next{};
}

}  // namespace fitgauge::interpreter
