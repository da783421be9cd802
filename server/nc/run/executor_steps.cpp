#include "nc/run/executor_steps.hpp"

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

/// Whether a block may stand in the contour of an SL cycle: it programs the contour, computes, or
/// transforms coordinates.
bool may_stand_in_contour(const klartext::Block& block) {
  if (const auto* part = block.as<klartext::CyclePart>()) {
    constexpr std::array<int, 5> kTransformations{7, 8, 10, 11, 26};
    return std::count(kTransformations.begin(), kTransformations.end(), part->number) != 0;
  }
  return block
      .is<klartext::Empty, klartext::Structure, klartext::Motion, klartext::MFunctions,
          klartext::LabelDefinition, klartext::LabelCall, klartext::ConditionalJump,
          klartext::Assignment, klartext::SetUndefined, klartext::CircleData, klartext::Trans>();
}

/// Runs the block of an Op::Statement.
NcResult<Next> execute_statement(Channel& channel, const Instruction& instruction) {
  const klartext::Block& block = channel.place().source();
  if (!block.is<klartext::Motion>()) {
    TRY(channel.contour.finish(channel.machine()));
    if (channel.contour.drawing() != nullptr && !may_stand_in_contour(block))
      return nc_error("this block is not allowed in the contour of an SL cycle");
  }
  auto next = std::visit([&](const auto& kind) { return dispatch(channel, instruction, kind); },
                         block.statement);
  if (next && channel.stop_after_block)
    return NcError{FaultKind::Stop, 0, "measuring log shown on the screen"};
  return next;
}

}  // namespace

/// Returns the reason why the result of an instruction is not finite, or why it cannot compare.
NcError ExecutorSteps::value_error(const Instruction& instruction) const {
  const double a = cells_[instruction.a];
  const double b = cells_[instruction.b];
  if (!is_defined(a)) return undefined_error(parameter_of(instruction.a));
  if (!is_defined(b)) return undefined_error(parameter_of(instruction.b));
  return nc_error(
      failure(instruction.op == Op::Divide ? Operator::Divide : instruction.function, a, b));
}

/// Returns whether the control gives the undefined operand a value.
bool ExecutorSteps::give_preassigned(const Instruction& instruction) {
  for (const std::uint32_t cell : {instruction.a, instruction.b}) {
    if (!is_defined(cells_[cell]) && is_preassigned(cell)) {
      update_preassigned(channel_);
      return true;
    }
  }
  return false;
}

bool ExecutorSteps::refuel(std::int64_t needed) {
  const auto portion = channel_.budget.refuel(std::exchange(fuel_, 0), needed);
  if (!portion) {
    error_ = portion.error();
    return false;
  }
  fuel_ = *portion;
  channel_.environment.observer.progressed(channel_.budget.executed(fuel_));
  return true;
}

/// Switches to the active program. @param unit of the program before it
void ExecutorSteps::enter_program(double unit, std::span<const double> locals) {
  channel_.parameters.enter(channel_.linked(), locals);
  load_program();
  const bool is_known = is_defined(cells_[kFirstQ + 108]);
  if (is_known && unit != channel_.length_unit()) update_preassigned(channel_);
}

const Instruction* ExecutorSteps::call_program(std::shared_ptr<const LinkedProgram> program,
                                               std::uint32_t return_to) {
  const double unit = channel_.length_unit();
  auto locals = channel_.parameters.save_locals(channel_.linked());
  if (auto called = channel_.calls.call_program(std::move(program), {return_to, std::move(locals)});
      !called)
    return fail(called.error());
  enter_program(unit, {});
  return code_;
}

const Instruction* ExecutorSteps::evaluate_node(const Instruction* pc) {
  enter(pc);
  if (auto checked = channel_.budget.check(); !checked) return fail(checked.error());
  const auto value = evaluate(channel_, NodeIndex{pc->a});
  if (!value) return fail(value.error());
  cells_[pc->c] = *value;
  return pc + 1;
}

const Instruction* ExecutorSteps::jump_when(const Instruction* pc) {
  enter(pc);
  if (auto checked = channel_.budget.check(); !checked) return fail(checked.error());
  const auto holds = condition(channel_, NodeIndex{pc->a});
  if (!holds) return fail(holds.error());
  return *holds ? code_ + pc->c : pc + 1;
}

const Instruction* ExecutorSteps::call_label(std::uint32_t target, const Instruction* pc) {
  if (auto called = channel_.calls.call_label(index_of(pc + 1)); !called)
    return fail(called.error());
  return code_ + target;
}

/// LBL 0, which is passed over outside of a subprogram.
const Instruction* ExecutorSteps::end_label(const Instruction* pc) {
  const auto target = channel_.calls.return_from_label();
  has_returned_ = target == kBackToCycle;
  if (has_returned_) return nullptr;
  return target ? code_ + *target : pc + 1;
}

/// CALL LBL REP: the counter cell is undefined while the part is not being repeated.
const Instruction* ExecutorSteps::repeat(const Instruction* pc) {
  double& counter = cells_[pc->b];
  if (!is_defined(counter)) {
    const double count = cells_[pc->a];
    if (!is_defined(count)) return fail(undefined_error(parameter_of(pc->a)));
    if (count < 0) return fail(nc_error(1004, "REP is less than 0"));
    counter = std::round(count);  // decision 7
  }
  if (counter < 1) {
    counter = kUndefined;
    return pc + 1;
  }
  counter -= 1;
  return code_ + pc->c;
}

const Instruction* ExecutorSteps::statement(const Instruction* pc) {
  enter(pc);
  if (auto checked = channel_.budget.check(); !checked) return fail(checked.error());
  if (!announces_) channel_.environment.observer.entered(channel_.place());
  auto next = execute_statement(channel_, *pc);
  cells_ = channel_.parameters.cells();  // a cycle may have run a subprogram
  if (!next) {
    failed_at_ = channel_.block;
    return fail(next.error());
  }
  switch (next->kind) {
    case Next::Kind::Block: return pc + 1;
    case Next::Kind::Jump: return code_ + next->target;
    case Next::Kind::CallLabel: return call_label(next->target, pc);
    case Next::Kind::CallProgram: return call_program(std::move(next->program), index_of(pc + 1));
    case Next::Kind::EndRun: break;
  }
  return nullptr;
}

const Instruction* ExecutorSteps::end_block(const Instruction* pc) {
  enter(pc);
  if (auto done = channel_.contour.finish(channel_.machine()); !done) return fail(done.error());
  return end_program();
}

/// @returns the next instruction of the caller, or null at the end of the main program.
const Instruction* ExecutorSteps::end_program() {
  if (channel_.calls.depth() == depth_) return nullptr;
  const double unit = channel_.length_unit();
  const CallStack::Caller caller = channel_.calls.return_from_program();
  enter_program(unit, caller.locals);
  return code_ + caller.return_to;
}

}  // namespace fitgauge::interpreter
