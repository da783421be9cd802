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

std::optional<Axis> tool_axis(const std::optional<klartext::Axis>& axis) {
  if (!axis || *axis > klartext::Axis::Z) return std::nullopt;
  return static_cast<Axis>(*axis);
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

}  // namespace

NcResult<void> execute(Channel& channel, const klartext::ToolCall& call) {
  if (call.axis && *call.axis > klartext::Axis::Z)
    return nc_error(1079, "the tool axis is X, Y or Z");
  TRY(read_written_tools(channel));
  machine::ToolCall command;
  command.axis = tool_axis(call.axis);
  if (!is_absent(call.tool)) {
    command.number = TRY(tool_number(channel, call.tool));
    channel.prepared_tool = 0;
  } else {
    const machine::ActiveTool& active = channel.state().tool;
    command.dl = active.dl;
    command.dr = active.dr;
    command.dr2 = active.dr2;
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

}  // namespace fitgauge::interpreter
