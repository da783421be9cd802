#include <fmt/format.h>

#include "nc/run/channel.hpp"
#include "nc/run/motion_words.hpp"
#include "nc/run/preassigned.hpp"
#include "nc/run/statements.hpp"
#include "nc/run/values.hpp"

namespace fitgauge::interpreter {
namespace {

using klartext::Expr;
using klartext::Letter;
using klartext::QRef;

/// The tool table's number of a tool given by number or name.
NcResult<int> tool_number(Channel& channel, const Expr& tool) {
  const auto* parameter = std::get_if<QRef>(&tool);
  if (std::holds_alternative<klartext::Text>(tool) ||
      (parameter != nullptr && parameter->is_string())) {
    const auto name = text(channel, tool);
    if (!name) return name.error();
    const machine::Tool* found = channel.machine().state().tools.find(*name);
    if (found == nullptr) return nc_error(1092, fmt::format("tool \"{}\"", *name));
    return found->number;
  }
  // Indexed tools (5.1) are not in a simulated tool table; the main number is meant.
  const auto value = number(channel, tool);
  if (!value) return value.error();
  if (*value < 0 || *value > 32767.9) return nc_error(1093, fmt::format("tool {}", *value));
  return static_cast<int>(*value);
}

std::optional<machine::Axis> tool_axis(const std::optional<klartext::Axis>& axis) {
  if (!axis || *axis > klartext::Axis::Z) return std::nullopt;
  return static_cast<machine::Axis>(*axis);
}

}  // namespace

NcResult<void> execute(Channel& channel, const klartext::ToolCall& call) {
  if (call.axis && *call.axis > klartext::Axis::Z) {
    return nc_error(1079, "the tool axis is X, Y or Z");
  }
  machine::ToolCall command;
  command.axis = tool_axis(call.axis);
  if (!is_absent(call.tool)) {
    const auto number = tool_number(channel, call.tool);
    if (!number) return number.error();
    command.number = *number;
    channel.prepared_tool = 0;
  } else {
    const machine::ActiveTool& active = channel.machine().state().tool;
    command.dl = active.dl;
    command.dr = active.dr;
    command.dr2 = active.dr2;
  }
  const double unit = channel.length_unit();
  for (const klartext::Word& word : channel.program().view(call.words)) {
    if (is_absent(word.value)) continue;
    const auto value = number(channel, word.value);
    if (!value) return value.error();
    switch (word.letter) {
      case Letter::S: command.spindle_rpm = *value; break;
      case Letter::Dl: command.dl = *value * unit; break;
      case Letter::Dr: command.dr = *value * unit; break;
      case Letter::Dr2: command.dr2 = *value * unit; break;
      default: break;
    }
  }
  if (auto done = checked(channel.machine().call_tool(command)); !done) return done;
  const auto words = read_words(channel, call.words);
  if (!words) return words.error();
  if (words->feed && !words->feed->is_rapid) {
    channel.contour.tool_feed = words->feed->rate;
    if (const auto used = use_feed(channel, words->feed); !used) return used.error();
  }
  update_preassigned(channel);
  return {};
}

/// The old form with L and R defines the tool; otherwise it is only prepared, which takes no time.
NcResult<void> execute(Channel& channel, const klartext::ToolDefinition& definition) {
  if (is_absent(definition.tool)) return {};
  const auto number = tool_number(channel, definition.tool);
  if (!number) return number.error();
  if (channel.program().view(definition.words).empty()) {
    channel.prepared_tool = *number;
    return {};
  }
  const machine::Tool* found = channel.machine().state().tools.find(*number);
  machine::Tool tool = found != nullptr ? *found : machine::Tool{};
  tool.number = *number;
  for (const klartext::Word& word : channel.program().view(definition.words)) {
    const auto value = interpreter::number(channel, word.value);
    if (!value) return value.error();
    (word.letter == Letter::L ? tool.l : tool.r) = *value * channel.length_unit();
  }
  return checked(channel.machine().write_tool(tool));
}

}  // namespace fitgauge::interpreter
