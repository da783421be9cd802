#include "nc/run/statements.hpp"

namespace fitgauge::interpreter {
namespace {

NcResult<Next> wrap(NcResult<Next> next) { return next; }
NcResult<Next> wrap(const NcResult<void>& done) {
  if (!done) return done.error();
  return Next{};
}

/// Calls the function for a block's kind.
template <class Statement>
NcResult<Next> dispatch(Channel& channel, const Instruction& instruction,
                        const Statement& statement) {
  const auto text = [&](Text written) { return channel.program().text(written); };
  if constexpr (std::is_same_v<Statement, klartext::LabelCall>) {
    return execute(channel, statement, instruction.b);
  } else if constexpr (std::is_same_v<Statement, klartext::Cycle>) {
    return execute(channel, statement, channel.linked().cycle(instruction.b));
  } else if constexpr (std::is_same_v<Statement, klartext::CyclePart>) {
    return execute_parts(channel, instruction.b, instruction.a);
  } else if constexpr (std::is_same_v<Statement, klartext::ErrorBlock>) {
    return nc_error("block is faulty: {}", text(statement.text));
  } else if constexpr (std::is_same_v<Statement, klartext::Unsupported>) {
    return nc_error("{} is not available: {}", text(statement.feature), text(statement.text));
  } else if constexpr (requires { execute(channel, statement); }) {
    return wrap(execute(channel, statement));
  } else {
    return Next{};  // comments, labels: the linker makes no code of them; the mode, always MILL
  }
}

template <class... Kinds>
bool is_one_of(const klartext::Statement& statement) {
  return (std::holds_alternative<Kinds>(statement) || ...);
}

/// Whether a block may stand in the contour of an SL cycle: it programs the contour, computes, or
/// transforms coordinates.
bool may_stand_in_contour(const klartext::Statement& statement) {
  if (const auto* part = std::get_if<klartext::CyclePart>(&statement)) {
    constexpr std::array<int, 5> kTransformations{7, 8, 10, 11, 26};
    return std::count(kTransformations.begin(), kTransformations.end(), part->number) != 0;
  }
  return is_one_of<klartext::Empty, klartext::Structure, klartext::Motion, klartext::MFunctions,
                   klartext::LabelDefinition, klartext::LabelCall, klartext::ConditionalJump,
                   klartext::Assignment, klartext::SetUndefined, klartext::CircleData,
                   klartext::Trans>(statement);
}

}  // namespace

NcResult<Next> execute_statement(Channel& channel, const Instruction& instruction) {
  const klartext::Statement& statement = channel.place().source().statement;
  if (!std::holds_alternative<klartext::Motion>(statement)) {
    TRY(channel.contour.finish(channel.machine()));
    if (channel.contour.drawing() != nullptr && !may_stand_in_contour(statement))
      return nc_error("this block is not allowed in the contour of an SL cycle");
  }
  auto next =
      std::visit([&](const auto& kind) { return dispatch(channel, instruction, kind); }, statement);
  if (next && channel.stop_after_block)
    return NcError{FaultKind::Stop, 0, "measuring log shown on the screen"};
  return next;
}

}  // namespace fitgauge::interpreter
