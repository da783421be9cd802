#include <fmt/format.h>

#include <cmath>

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
    const auto named = text(channel, parameter);
    if (!named) return named.error();
    shown = fmt::format("\"{}\"", *named);
    found = channel.linked().label(std::string_view(*named));
  } else {
    const auto numbered = whole(channel, parameter);
    if (!numbered) return numbered.error();
    shown = std::to_string(*numbered);
    if (*numbered > 0) {
      found = channel.linked().label(static_cast<std::uint32_t>(*numbered));
    }
  }
  if (found) return *found;
  return nc_error(
      fmt::format("label {} of {} is not defined in this program", shown, name(parameter)));
}

}  // namespace

NcResult<Next> execute(Channel& channel, const klartext::ConditionalJump& jump) {
  const auto holds = condition(channel, std::get<klartext::NodeIndex>(jump.condition));
  if (!holds) return holds.error();
  if (!*holds) return Next{};
  const auto target = find_label(channel, jump.target);
  if (!target) return target.error();
  return Next{Next::Kind::Jump, *target};
}

NcResult<Next> execute(Channel& channel, const klartext::LabelCall& call, std::uint32_t counter) {
  const auto target = find_label(channel, call.label);
  if (!target) return target.error();
  if (is_absent(call.repeat)) return Next{Next::Kind::CallLabel, *target};
  double& left = channel.parameters.cells()[counter];
  if (!is_defined(left)) {
    const auto count = number(channel, call.repeat);
    if (!count) return count.error();
    left = std::round(*count);
  }
  if (left < 1) {
    left = kUndefined;
    return Next{};
  }
  left -= 1;
  return Next{Next::Kind::Jump, *target};
}

NcResult<Next> call_program(Channel& channel, const ControlPath& path) {
  auto program = channel.load_program(path);
  if (!program) return program.error();
  return Next{Next::Kind::CallProgram, 0, *std::move(program)};
}

NcResult<Next> execute(Channel& channel, const klartext::CallProgram& call) {
  const auto written = text(channel, call.path);
  if (!written) return written.error();
  const auto path = channel.resolve_program(*written);
  if (!path) return path.error();
  return call_program(channel, *path);
}

/// Whether the program exists shows when it is called.
NcResult<void> execute(Channel& channel, const klartext::SelectProgram& select) {
  const auto written = text(channel, select.path);
  if (!written) return written.error();
  auto path = channel.resolve_program(*written);
  if (!path) return path.error();
  channel.selected_program = *std::move(path);
  return {};
}

NcResult<Next> execute(Channel& channel, const klartext::CallSelectedProgram&) {
  if (!channel.selected_program) {
    return nc_error("CALL SELECTED PGM needs a program selected by SEL PGM before it");
  }
  return call_program(channel, *channel.selected_program);
}

}  // namespace fitgauge::interpreter
