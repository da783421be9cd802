#include "run/executor.hpp"

#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

#include "program/arithmetic.hpp"
#include "run/preassigned.hpp"
#include "run/statements.hpp"
#include "run/values.hpp"

// Direct threading: each operation jumps to the next one's code, so that the processor predicts
// every pair of operations apart. Labels as values are an extension of GCC and Clang; other
// compilers get a switch in a loop.
#if defined(__GNUC__) && !defined(FITGAUGE_SWITCH_DISPATCH)
#define FITGAUGE_THREADED 1
#else
#define FITGAUGE_THREADED 0
#endif

namespace fitgauge::interpreter {
namespace {

/// The loop over the code of a run. `kFollowed`: every block is announced to the observer; a second
/// instantiation, so that the usual one does not even ask.
template <bool kFollowed>
class Executor {
 public:
  explicit Executor(Channel& channel) : channel_(channel), depth_(channel.calls.depth()) {}

  Ending run() {
    load_program();
    loop(code_);
    return {channel_.budget.executed(fuel_), std::move(error_)};
  }

  NcResult<void> run_label(std::uint32_t label) {
    const std::uint32_t caller = channel_.block;
    if (auto called = channel_.calls.call_label(kBackToCycle); !called) return called;
    load_program();
    loop(code_ + label);
    channel_.budget.give_back(fuel_);
    if (error_) return *std::move(error_);
    if (!has_returned_) return nc_error("the subprogram of a contour ends with LBL 0");
    channel_.block = caller;
    return {};
  }

 private:
  /// Where LBL 0 of a subprogram that a cycle runs goes on.
  static constexpr std::uint32_t kBackToCycle = std::numeric_limits<std::uint32_t>::max();

  void load_program() {
    code_ = channel_.linked().code().data();
    cells_ = channel_.parameters.cells();
  }

  std::uint32_t index_of(const Instruction* pc) const {
    return static_cast<std::uint32_t>(pc - code_);
  }

  /// Says which block runs.
  void enter(const Instruction* pc) { channel_.block = channel_.linked().block_of(index_of(pc)); }

  void announce(const Instruction* pc) {
    if (pc->blocks == 0) return;
    enter(pc);
    channel_.environment.observer.entered(channel_.place());
  }

  NcError value_error(const Instruction& instruction) const;
  bool give_preassigned(const Instruction& instruction);
  bool refuel(std::int64_t needed);
  bool evaluate_node(const Instruction* pc);
  bool call_program(std::shared_ptr<const LinkedProgram> program, std::uint32_t return_to);
  // Where the run goes on; null after an error and at the end of the run.
  const Instruction* jump_when(const Instruction* pc);
  const Instruction* call_label(std::uint32_t target, const Instruction* pc);
  const Instruction* end_label(const Instruction* pc);
  const Instruction* repeat(const Instruction* pc);
  const Instruction* statement(const Instruction* pc);
  const Instruction* end_block(const Instruction* pc);
  const Instruction* end_program();
  const Instruction* fail(NcError error) {
    error_ = std::move(error);
    return nullptr;
  }
  void loop(const Instruction* first);

  Channel& channel_;
  const std::size_t depth_;  ///< of the program in which this began
  bool has_returned_ = false;
  const Instruction* code_ = nullptr;
  double* cells_ = nullptr;
  std::int64_t fuel_ = 0;
  std::optional<NcError> error_;
};

/// Why the result of an instruction is not finite, or its comparison not possible.
template <bool kFollowed>
NcError Executor<kFollowed>::value_error(const Instruction& instruction) const {
  const double a = cells_[instruction.a];
  const double b = cells_[instruction.b];
  if (!is_defined(a)) return undefined_error(parameter_of(instruction.a));
  if (!is_defined(b)) return undefined_error(parameter_of(instruction.b));
  return nc_error(failure(
      instruction.op == Op::Divide ? klartext::Operator::Divide : instruction.function, a, b));
}

/// Whether an undefined operand was one that the control gives a value.
template <bool kFollowed>
bool Executor<kFollowed>::give_preassigned(const Instruction& instruction) {
  for (const std::uint32_t cell : {instruction.a, instruction.b}) {
    if (!is_defined(cells_[cell]) && is_preassigned(cell)) {
      update_preassigned(channel_);
      return true;
    }
  }
  return false;
}

template <bool kFollowed>
bool Executor<kFollowed>::refuel(std::int64_t needed) {
  const auto portion = channel_.budget.refuel(std::exchange(fuel_, 0), needed);
  if (!portion) {
    error_ = portion.error();
    return false;
  }
  fuel_ = *portion;
  channel_.environment.observer.progressed(channel_.budget.executed(fuel_));
  return true;
}

template <bool kFollowed>
bool Executor<kFollowed>::call_program(std::shared_ptr<const LinkedProgram> program,
                                       std::uint32_t return_to) {
  QParameters& parameters = channel_.parameters;
  auto locals = parameters.save_locals(channel_.linked());
  if (auto called = channel_.calls.call_program(std::move(program), {return_to, std::move(locals)});
      !called) {
    error_ = called.error();
    return false;
  }
  parameters.enter(channel_.linked());
  load_program();
  return true;
}

template <bool kFollowed>
bool Executor<kFollowed>::evaluate_node(const Instruction* pc) {
  enter(pc);
  if (auto checked = channel_.budget.check(); !checked) {
    error_ = checked.error();
    return false;
  }
  const auto value = evaluate(channel_, klartext::NodeIndex{pc->a});
  if (!value) {
    error_ = value.error();
    return false;
  }
  cells_[pc->c] = *value;
  return true;
}

template <bool kFollowed>
const Instruction* Executor<kFollowed>::jump_when(const Instruction* pc) {
  enter(pc);
  if (auto checked = channel_.budget.check(); !checked) return fail(checked.error());
  const auto holds = condition(channel_, klartext::NodeIndex{pc->a});
  if (!holds) return fail(holds.error());
  return *holds ? code_ + pc->c : pc + 1;
}

template <bool kFollowed>
const Instruction* Executor<kFollowed>::call_label(std::uint32_t target, const Instruction* pc) {
  if (auto called = channel_.calls.call_label(index_of(pc + 1)); !called) {
    return fail(called.error());
  }
  return code_ + target;
}

/// LBL 0, which is passed over outside of a subprogram.
template <bool kFollowed>
const Instruction* Executor<kFollowed>::end_label(const Instruction* pc) {
  const auto target = channel_.calls.return_from_label();
  has_returned_ = target == kBackToCycle;
  if (has_returned_) return nullptr;
  return target ? code_ + *target : pc + 1;
}

/// CALL LBL REP: the counter cell is undefined while the part is not being repeated.
template <bool kFollowed>
const Instruction* Executor<kFollowed>::repeat(const Instruction* pc) {
  double& counter = cells_[pc->b];
  if (!is_defined(counter)) {
    const double count = cells_[pc->a];
    if (!is_defined(count)) return fail(undefined_error(parameter_of(pc->a)));
    counter = std::round(count);  // decision 7
  }
  if (counter < 1) {
    counter = kUndefined;
    return pc + 1;
  }
  counter -= 1;
  return code_ + pc->c;
}

template <bool kFollowed>
const Instruction* Executor<kFollowed>::statement(const Instruction* pc) {
  enter(pc);
  if (auto checked = channel_.budget.check(); !checked) return fail(checked.error());
  if constexpr (!kFollowed) channel_.environment.observer.entered(channel_.place());
  auto next = execute_statement(channel_, *pc);
  cells_ = channel_.parameters.cells();  // a cycle may have run a subprogram
  if (!next) return fail(next.error());
  switch (next->kind) {
    case Next::Kind::Block: return pc + 1;
    case Next::Kind::Jump: return code_ + next->target;
    case Next::Kind::CallLabel: return call_label(next->target, pc);
    case Next::Kind::CallProgram:
      return call_program(std::move(next->program), index_of(pc + 1)) ? code_ : nullptr;
    case Next::Kind::EndRun: break;
  }
  return nullptr;
}

template <bool kFollowed>
const Instruction* Executor<kFollowed>::end_block(const Instruction* pc) {
  enter(pc);
  if (auto done = channel_.contour.finish(channel_.machine()); !done) return fail(done.error());
  return end_program();
}

/// @returns where the caller goes on, or null at the end of the main program.
template <bool kFollowed>
const Instruction* Executor<kFollowed>::end_program() {
  if (channel_.calls.depth() == depth_) return nullptr;
  const CallStack::Caller caller = channel_.calls.return_from_program();
  channel_.parameters.enter(channel_.linked(), caller.locals);
  load_program();
  return code_ + caller.return_to;
}

// The table of labels and the jump through it are the extension.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wpedantic"
// Macros that are labels and statements confuse the formatter.
// clang-format off

#if FITGAUGE_THREADED
#define FITGAUGE_OP(name) op_##name
// NOLINTNEXTLINE(bugprone-macro-parentheses): a statement
#define FITGAUGE_NEXT() goto* kHandlers[static_cast<std::size_t>(pc->op)]
// What is known of a variable is forgotten: on the rare way out everything is read again, so that
// no step of the usual way keeps it in a register.
#define FITGAUGE_FORGET(variable) asm volatile("" : "+r"(variable) : : "memory")
#else
#define FITGAUGE_FORGET(variable) static_cast<void>(variable)
#define FITGAUGE_OP(name) case Op::name
#define FITGAUGE_NEXT() continue
#endif

// Accounts for the blocks that an instruction begins.
#define FITGAUGE_BEGIN()                                            \
  if ((fuel -= pc->blocks) < 0) [[unlikely]] goto out_of_fuel;      \
  if constexpr (kFollowed) announce(pc)

// Keeps a result, which must be finite: else an operand is undefined or the operation failed.
#define FITGAUGE_KEEP(value)                                        \
  do {                                                              \
    const double result = (value);                                  \
    if (!std::isfinite(result)) [[unlikely]] goto not_a_value;      \
    cells[pc->c] = result;                                          \
  } while (false);                                                  \
  ++pc

#define FITGAUGE_STORE(value)                                       \
  FITGAUGE_KEEP(value);                                             \
  FITGAUGE_NEXT()

// Jumps when `jumps`, goes on when `stays`; neither holds where an operand is undefined.
#define FITGAUGE_BRANCH(jumps, stays)                               \
  do {                                                              \
    const double a = cells[pc->a];                                  \
    const double b = cells[pc->b];                                  \
    if (jumps) {                                                    \
      pc = code + pc->c;                                            \
    } else if (stays) [[likely]] {                                  \
      ++pc;                                                         \
    } else {                                                        \
      goto not_a_value;                                             \
    }                                                               \
  } while (false);                                                  \
  FITGAUGE_NEXT()

// Leaves the loop for a function that says where the run goes on; null: it ended or failed. A
// program call changes code and cells.
#define FITGAUGE_CALL(function)                                     \
  fuel_ = fuel;                                                     \
  next = (function);                                                \
  if (next == nullptr) goto done;                                   \
  pc = next;                                                        \
  code = code_;                                                     \
  cells = cells_;                                                   \
  FITGAUGE_NEXT()

template <bool kFollowed>
void Executor<kFollowed>::loop(const Instruction* first) {
#if FITGAUGE_THREADED
  static const void* const kHandlers[] = {
      &&op_Add,         &&op_Subtract,      &&op_Multiply,    &&op_Divide,
      &&op_Copy,        &&op_Compute,       &&op_Evaluate,    &&op_JumpEqual,
      &&op_JumpNotEqual, &&op_JumpGreater,  &&op_JumpLess,    &&op_JumpDefined,
      &&op_JumpUndefined, &&op_JumpWhen,    &&op_AddThenAdd,  &&op_AddThenJumpLess,
      &&op_AddTwiceThenJumpLess, &&op_Count,  &&op_SkipBlock,   &&op_CallLabel,
      &&op_LabelEnd,    &&op_Repeat,        &&op_Statement,   &&op_End};
  static_assert(std::size(kHandlers) == static_cast<std::size_t>(Op::End) + 1);
#endif
  // What the loop works with lies in registers; the members are brought up to date on the way out.
  const Instruction* code = code_;
  double* cells = cells_;
  std::int64_t fuel = fuel_;
  const Instruction* pc = first;
  const Instruction* next = nullptr;

#if FITGAUGE_THREADED
  FITGAUGE_NEXT();
#else
  for (;;) {
  switch (pc->op) {
#endif

  FITGAUGE_OP(Add):
    FITGAUGE_BEGIN();
    FITGAUGE_STORE(cells[pc->a] + cells[pc->b]);
  FITGAUGE_OP(Subtract):
    FITGAUGE_BEGIN();
    FITGAUGE_STORE(cells[pc->a] - cells[pc->b]);
  FITGAUGE_OP(Multiply):
    FITGAUGE_BEGIN();
    FITGAUGE_STORE(cells[pc->a] * cells[pc->b]);
  FITGAUGE_OP(Divide):
    FITGAUGE_BEGIN();
    FITGAUGE_STORE(cells[pc->a] / cells[pc->b]);
  FITGAUGE_OP(Copy):
    FITGAUGE_BEGIN();
    FITGAUGE_STORE(cells[pc->a]);
  FITGAUGE_OP(Compute):
    FITGAUGE_BEGIN();
    FITGAUGE_STORE(compute(pc->function, cells[pc->a], cells[pc->b]));
  FITGAUGE_OP(Evaluate):
    FITGAUGE_BEGIN();
    FITGAUGE_CALL(evaluate_node(pc) ? pc + 1 : nullptr);

  FITGAUGE_OP(JumpEqual):
    FITGAUGE_BEGIN();
    FITGAUGE_BRANCH(are_equal(a, b), is_defined(a) && is_defined(b));
  FITGAUGE_OP(JumpNotEqual):
    FITGAUGE_BEGIN();
    FITGAUGE_BRANCH(is_defined(a) && is_defined(b) && !are_equal(a, b), are_equal(a, b));
  FITGAUGE_OP(JumpGreater):
    FITGAUGE_BEGIN();
    FITGAUGE_BRANCH(a > b, a <= b);
  FITGAUGE_OP(JumpLess):
    FITGAUGE_BEGIN();
    FITGAUGE_BRANCH(a < b, a >= b);
  FITGAUGE_OP(JumpDefined):
    FITGAUGE_BEGIN();
    pc = is_defined(cells[pc->a]) ? code + pc->c : pc + 1;
    FITGAUGE_NEXT();
  FITGAUGE_OP(JumpUndefined):
    FITGAUGE_BEGIN();
    pc = is_defined(cells[pc->a]) ? pc + 1 : code + pc->c;
    FITGAUGE_NEXT();
  FITGAUGE_OP(JumpWhen):
    FITGAUGE_BEGIN();
    FITGAUGE_CALL(jump_when(pc));

  FITGAUGE_OP(AddThenAdd):
    FITGAUGE_BEGIN();
    FITGAUGE_KEEP(cells[pc->a] + cells[pc->b]);
    FITGAUGE_BEGIN();
    FITGAUGE_STORE(cells[pc->a] + cells[pc->b]);
  FITGAUGE_OP(AddThenJumpLess):
    FITGAUGE_BEGIN();
    FITGAUGE_KEEP(cells[pc->a] + cells[pc->b]);
    FITGAUGE_BEGIN();
    FITGAUGE_BRANCH(a < b, a >= b);
  FITGAUGE_OP(AddTwiceThenJumpLess):
    FITGAUGE_BEGIN();
    FITGAUGE_KEEP(cells[pc->a] + cells[pc->b]);
    FITGAUGE_BEGIN();
    FITGAUGE_KEEP(cells[pc->a] + cells[pc->b]);
    FITGAUGE_BEGIN();
    FITGAUGE_BRANCH(a < b, a >= b);

  FITGAUGE_OP(Count):
    FITGAUGE_BEGIN();
    ++pc;
    FITGAUGE_NEXT();
  FITGAUGE_OP(SkipBlock):
    pc = channel_.options.block_skip ? code + pc->c : pc + 1;
    FITGAUGE_NEXT();
  FITGAUGE_OP(CallLabel):
    FITGAUGE_BEGIN();
    FITGAUGE_CALL(call_label(pc->c, pc));
  FITGAUGE_OP(LabelEnd):
    FITGAUGE_BEGIN();
    FITGAUGE_CALL(end_label(pc));
  FITGAUGE_OP(Repeat):
    FITGAUGE_BEGIN();
    FITGAUGE_CALL(repeat(pc));
  FITGAUGE_OP(Statement):
    FITGAUGE_BEGIN();
    FITGAUGE_CALL(statement(pc));
  FITGAUGE_OP(End):
    FITGAUGE_BEGIN();
    FITGAUGE_CALL(end_block(pc));

  out_of_fuel:
    FITGAUGE_FORGET(pc);
    FITGAUGE_FORGET(fuel);
    fuel_ = fuel + pc->blocks;
    if (!refuel(pc->blocks)) goto done;
    fuel = fuel_;
    FITGAUGE_NEXT();
  not_a_value:
    FITGAUGE_FORGET(pc);
    if (give_preassigned(*pc)) {
      fuel += pc->blocks;
      FITGAUGE_NEXT();
    }
    error_ = value_error(*pc);
    fuel_ = fuel;
    goto done;
#if !FITGAUGE_THREADED
  }
  }
#endif
done:
  if (error_) enter(pc);
}

// clang-format on
#pragma GCC diagnostic pop

}  // namespace

Ending execute_program(Channel& channel) {
  return channel.environment.observer.follows_every_block() ? Executor<true>(channel).run()
                                                            : Executor<false>(channel).run();
}

NcResult<void> execute_label(Channel& channel, std::uint32_t label) {
  return channel.environment.observer.follows_every_block()
             ? Executor<true>(channel).run_label(label)
             : Executor<false>(channel).run_label(label);
}

}  // namespace fitgauge::interpreter
