#include "nc/run/channel.hpp"
#include "nc/run/statements.hpp"
#include "nc/run/values.hpp"

namespace fitgauge::interpreter {
namespace {

using klartext::Label;
using klartext::QRef;

/// The instruction of a label that is named by a parameter: `LBL QS5`, `LBL Q0`.
NcResult<std::uint32_t> find_label(Channel& channel, const Label& label) {
  const QRef parameter = std::get<QRef>(label);
  std::string shown;
  std::optional<std::uint32_t> found;
  if (parameter.is_string()) {
    const auto named = TRY(text(channel, parameter));
    shown = fmt::format("\"{}\"", named);
    found = channel.linked().label(std::string_view(named));
  } else {
    const auto numbered = TRY(whole(channel, parameter));
    shown = std::to_string(numbered);
    if (numbered > 0) found = channel.linked().label(static_cast<std::uint32_t>(numbered));
  }
  if (found) return *found;
  return nc_error("label {} of {} is not defined in this program", shown, name(parameter));
}

}  // namespace

NcResult<Next> execute(Channel& channel, const klartext::ConditionalJump& jump) {
  const auto holds = TRY(condition(channel, std::get<klartext::NodeIndex>(jump.condition)));
  if (!holds) return Next{};
  const auto target = TRY(find_label(channel, jump.target));
  return Next{Next::Kind::Jump, target};
}

NcResult<Next> execute(Channel& channel, const klartext::LabelCall& call, std::uint32_t counter) {
  const auto target = TRY(find_label(channel, call.label));
  if (is_absent(call.repeat)) return Next{Next::Kind::CallLabel, target};
  double& left = channel.parameters.cells()[counter];
  if (!is_defined(left)) {
    const auto count = TRY(number(channel, call.repeat));
    if (count < 0) return nc_error(1004, "REP is less than 0");
    left = std::round(count);
  }
  if (left < 1) {
    left = kUndefined;
    return Next{};
  }
  left -= 1;
  return Next{Next::Kind::Jump, target};
}

NcResult<Next> call_program(Channel& channel, const ControlPath& path) {
  auto program = TRY(channel.load_program(path));
  return Next{Next::Kind::CallProgram, 0, std::move(program)};
}

NcResult<Next> execute(Channel& channel, const klartext::CallProgram& call) {
  const auto written = TRY(text(channel, call.path));
  const auto path = TRY(channel.resolve_program(written));
  return call_program(channel, path);
}

/// Whether the program exists shows when it is called.
NcResult<void> execute(Channel& channel, const klartext::SelectProgram& select) {
  const auto written = TRY(text(channel, select.path));
  channel.selected_program = TRY(channel.resolve_program(written));
  return {};
}

NcResult<Next> execute(Channel& channel, const klartext::CallSelectedProgram&) {
  if (!channel.selected_program) {
    return nc_error("CALL SELECTED PGM needs a program selected by SEL PGM before it");
  }
  return call_program(channel, *channel.selected_program);
}

}  // namespace fitgauge::interpreter
