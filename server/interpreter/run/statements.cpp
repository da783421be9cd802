#include "run/statements.hpp"

#include <fmt/format.h>

#include "run/channel.hpp"

namespace fitgauge::interpreter {
namespace {

/// Calls the function of a block's kind and gives its outcome one form.
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
      return Next{};  // comments, labels, BLK FORM: the linker makes no code of them
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

}  // namespace

NcResult<Next> execute_statement(Channel& channel, const Instruction& instruction) {
  const klartext::Statement& statement = channel.place().source().statement;
  if (!std::holds_alternative<klartext::Motion>(statement)) {
    if (auto done = channel.contour.finish(channel.machine()); !done) return done.error();
  }
  auto next = std::visit(Dispatcher(channel, instruction), statement);
  if (next && channel.stop_after_block) {
    return NcError{NcErrorKind::Stop, 0, "measuring log shown on the screen"};
  }
  return next;
}

}  // namespace fitgauge::interpreter
