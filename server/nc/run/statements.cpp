#include "nc/run/statements.hpp"

#include "nc/run/channel.hpp"

namespace fitgauge::interpreter {
namespace {

/// Calls the function for a block's kind, and converts its outcome to one form.
class Dispatcher {
 public:
  Dispatcher(Channel& channel, const Instruction& instruction)
      : channel_(channel), instruction_(instruction) {}

  NcResult<Next> operator()(const klartext::LabelCall& call) const {
    return execute(channel_, call, instruction_.b);
  }
  NcResult<Next> operator()(const klartext::Cycle& cycle) const {
    return execute(channel_, cycle, channel_.linked().cycle(instruction_.b));
  }
  NcResult<Next> operator()(const klartext::CyclePart&) const {
    return wrap(execute_parts(channel_, instruction_.b, instruction_.a));
  }
  NcResult<Next> operator()(const klartext::ErrorBlock& block) const {
    return nc_error(fmt::format("block is faulty: {}", channel_.program().text(block.text)));
  }
  NcResult<Next> operator()(const klartext::Unsupported& block) const {
    return nc_error(fmt::format("{} is not available: {}", channel_.program().text(block.feature),
                                channel_.program().text(block.text)));
  }
  template <class Statement>
  NcResult<Next> operator()(const Statement& statement) const {
    if constexpr (requires { execute(channel_, statement); }) {
      return wrap(execute(channel_, statement));
    } else {
      return Next{};  // comments, labels: the linker makes no code of them
    }
  }

 private:
  static NcResult<Next> wrap(NcResult<Next> next) { return next; }
  static NcResult<Next> wrap(const NcResult<void>& done) {
    if (!done) return done.error();
    return Next{};
  }

  Channel& channel_;
  const Instruction& instruction_;
};

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
    if (channel.contour.drawing() != nullptr && !may_stand_in_contour(statement)) {
      return nc_error("this block is not allowed in the contour of an SL cycle");
    }
  }
  auto next = std::visit(Dispatcher(channel, instruction), statement);
  if (next && channel.stop_after_block) {
    return NcError{NcErrorKind::Stop, 0, "measuring log shown on the screen"};
  }
  return next;
}

}  // namespace fitgauge::interpreter
