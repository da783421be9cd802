#include "nc/probing/alignment/rotation.hpp"
#include "nc/run/statements.hpp"

namespace fitgauge::interpreter {
namespace {

/// The tool table's number of a tool given by number or name.
NcResult<int> tool_number(Channel& channel, const Expr& tool) {
  if (is_text(tool)) {
    const auto name = TRY(text(channel, tool));
    const Tool* found = channel.state().tools.find(name);
    if (found == nullptr) return nc_error(1092, "tool \"{}\"", name);
    return found->number;
  }
  const auto value = TRY(number(channel, tool));
  if (value != std::floor(value))
    return nc_error(1092, "tool {}: the tool table has no indexed rows here", value);
  if (value < 0 || value > 32767) return nc_error(1093, "tool {}", value);
  return static_cast<int>(value);
}

/// Applies the values that FN 27 wrote to tool.t since the last TOOL CALL.
NcResult<void> read_written_tools(Channel& channel) {
  for (const auto& [number, nr, value] : channel.tables.take_tool_cells()) {
    const Tool* found = channel.state().tools.find(number);
    Tool tool = found != nullptr ? *found : Tool{};
    tool.number = number;
    if (set_tool_value(tool, nr, value) == ToolWrite::OutOfRange)
      return nc_error(1093, "tool {}: tool.t holds {} in a column of whole numbers", number, value);
    TRY(note_lathe_value(channel, tool, nr));
    TRY(channel.machine().write_tool(tool));
  }
  return {};
}

using klartext::Motion;

NcResult<void> note_entry(Channel& channel) {
  if (!std::exchange(channel.contour.has_entered_part, false)) return {};
  const auto& state = channel.state();
  return channel.note("tool {} enters the part {}", state.tool.number,
                      state.modes.turns()
                          ? "in rapid traverse: the simulation removes no material, so check "
                            "whether it is gone there"
                          : "with a standing spindle: give its speed S, and M3 or M4 before");
}

NcResult<void> note_lathe_tool(Channel& channel) {
  const Tool* tool = channel.state().active_tool();
  if (tool == nullptr || !tool->lathe || tool->lathe->xl + tool->lathe->dxl == 0) return {};
  return channel.note(
      "tool {} is a lathe tool: positioning blocks move the spindle axis here, without XL",
      tool->number);
}

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

NcResult<void> execute(Channel& channel, const klartext::ToolCall& call) {
  if (call.axis && *call.axis > klartext::Axis::Z)
    return nc_error(1079, "the tool axis is X, Y or Z");
  TRY(read_written_tools(channel));
  machine::ToolCall command;
  if (call.axis) command.axis = static_cast<Axis>(*call.axis);
  if (!is_absent(call.tool)) {
    command.number = TRY(tool_number(channel, call.tool));
    channel.prepared_tool = 0;
  }
  const double unit = channel.length_unit();
  for (const Word& word : channel.program().view(call.words)) {
    if (is_absent(word.value)) continue;
    const auto value = TRY(number(channel, word.value));
    switch (word.letter) {
      case Letter::S: command.spindle_rpm = value; break;
      case Letter::Dl: command.dl = value * unit; break;
      case Letter::Dr: command.dr = value * unit; break;
      case Letter::Dr2: command.dr2 = value * unit; break;
      default: break;
    }
  }
  TRY(channel.machine().call_tool(command));
  TRY(note_lathe_tool(channel));
  const auto words = TRY(read_words(channel, call.words));
  if (words.feed && !words.feed->is_rapid) {
    channel.contour.tool_feed = words.feed->rate;
    TRY(use_feed(channel, words.feed));
  }
  update_preassigned(channel);
  return {};
}

/// The old form with L and R defines the tool; otherwise it is only prepared, which takes no time.
NcResult<void> execute(Channel& channel, const klartext::ToolDefinition& definition) {
  if (is_absent(definition.tool)) return {};
  const auto number = TRY(tool_number(channel, definition.tool));
  if (channel.program().view(definition.words).empty()) {
    channel.prepared_tool = number;
    return {};
  }
  const Tool* found = channel.state().tools.find(number);
  Tool tool = found != nullptr ? *found : Tool{};
  tool.number = number;
  for (const Word& word : channel.program().view(definition.words)) {
    const auto value = TRY(interpreter::number(channel, word.value));
    (word.letter == Letter::L ? tool.l : tool.r) = value * channel.length_unit();
  }
  return channel.machine().write_tool(tool);
}

NcResult<Next> execute(Channel& channel, const Motion& motion) {
  auto words = TRY(read_words(channel, motion.words));
  channel.contour.compensate(motion.compensation);
  if (channel.contour.drawing() != nullptr) {
    TRY(position(channel, motion, words));
    return Next{};
  }
  TRY(start_m_functions(channel, words.m));
  TRY(orient_tool(channel, motion, words));
  TRY(position(channel, motion, words));
  TRY(note_entry(channel));
  return end_m_functions(channel, words);
}

NcResult<Next> execute(Channel& channel, const klartext::MFunctions& functions) {
  const auto words = TRY(read_words(channel, functions.words));
  if (channel.contour.drawing() != nullptr) return Next{};
  TRY(start_m_functions(channel, words.m));
  return end_m_functions(channel, words);
}

NcResult<Next> execute(Channel& channel, const klartext::Stop& stop) {
  const auto words = TRY(read_words(channel, stop.words));
  TRY(start_m_functions(channel, words.m));
  auto next = end_m_functions(channel, words);
  if (!next || next->kind != Next::Kind::Block) return next;
  TRY(channel.programmed_stop("programmed stop"));
  return next;
}

NcResult<void> execute(Channel& channel, const klartext::Dwell& dwell) {
  const auto value = TRY(number(channel, dwell.value));
  double seconds = value;
  if (dwell.revolutions) {
    const double rpm = channel.state().modes.spindle_rpm;
    if (rpm <= 0) return nc_error(1020, "FUNCTION DWELL REV needs a speed of the spindle");
    seconds = value * 60 / rpm;
  }
  return channel.machine().dwell(seconds);
}

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
