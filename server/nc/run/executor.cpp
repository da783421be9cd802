#include "nc/run/executor_steps.hpp"
#include "nc/run/statements.hpp"

// Direct threading: each operation jumps to the next one's code, so that the processor predicts
// every pair of operations apart. Labels as values are an extension of GCC and Clang.

namespace fitgauge::interpreter {
namespace {

/// The loop over the code of a run. `kFollowed`: every block is announced to the observer; a second
/// instantiation, so that the usual one does not even ask.
template <bool kFollowed>
class Executor : ExecutorSteps {
 public:
  explicit Executor(Channel& channel) : ExecutorSteps(channel, kFollowed) {}

  Ending run() {
    load_program();
    const auto& start = channel_.options.start_block;
    loop(code_ + (start ? channel_.linked().instruction_of(*start).value_or(0) : 0));
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
  void loop(const Instruction* first);
};

// The table of labels and the jump through it are the extension.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wpedantic"
// Macros that are labels and statements confuse the formatter.
// clang-format off

// NOLINTNEXTLINE(bugprone-macro-parentheses): a statement
#define FITGAUGE_NEXT() goto* kHandlers[static_cast<std::size_t>(pc->op)]
// Forgets the state of a variable. The rare way out reads everything again, so that the usual way
// keeps none of it in a register.
#define FITGAUGE_FORGET(variable) asm volatile("" : "+r"(variable) : : "memory")

// Accounts for the blocks that an instruction begins.
#define FITGAUGE_BEGIN()                                            \
  if ((fuel -= pc->blocks) < 0) [[unlikely]] goto out_of_fuel;      \
  if constexpr (kFollowed) announce(pc)

// Begins the code of an operation.
#define FITGAUGE_OP(name) op_##name: FITGAUGE_BEGIN()

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

// Jumps if `jumps`, continues if `stays`; neither is true if an operand is undefined.
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

// Leaves the loop for a function that returns the next instruction; null: the run ended or failed.
// A program call changes code and cells.
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
  static const void* const kHandlers[] = {
      &&op_Add,         &&op_Subtract,      &&op_Multiply,    &&op_Divide,
      &&op_Copy,        &&op_Compute,       &&op_Evaluate,    &&op_JumpEqual,
      &&op_JumpNotEqual, &&op_JumpGreater,  &&op_JumpLess,    &&op_JumpDefined,
      &&op_JumpUndefined, &&op_JumpWhen,    &&op_AddThenAdd,  &&op_AddThenJumpLess,
      &&op_AddTwiceThenJumpLess, &&op_Count,  &&op_SkipBlock,   &&op_CallLabel,
      &&op_LabelEnd,    &&op_Repeat,        &&op_Statement,   &&op_End};
  static_assert(std::size(kHandlers) == static_cast<std::size_t>(Op::End) + 1);
  // The loop keeps its state in registers; the members are updated on the way out.
  const Instruction* code = code_;
  double* cells = cells_;
  std::int64_t fuel = fuel_;
  const Instruction* pc = first;
  const Instruction* next = nullptr;
  FITGAUGE_NEXT();

  FITGAUGE_OP(Add);
    FITGAUGE_STORE(cells[pc->a] + cells[pc->b]);
  FITGAUGE_OP(Subtract);
    FITGAUGE_STORE(cells[pc->a] - cells[pc->b]);
  FITGAUGE_OP(Multiply);
    FITGAUGE_STORE(cells[pc->a] * cells[pc->b]);
  FITGAUGE_OP(Divide);
    FITGAUGE_STORE(cells[pc->a] / cells[pc->b]);
  FITGAUGE_OP(Copy);
    FITGAUGE_STORE(cells[pc->a]);
  FITGAUGE_OP(Compute);
    FITGAUGE_STORE(compute(pc->function, cells[pc->a], cells[pc->b]));
  FITGAUGE_OP(Evaluate);
    FITGAUGE_CALL(evaluate_node(pc));

  FITGAUGE_OP(JumpEqual);
    FITGAUGE_BRANCH(are_equal(a, b), is_defined(a) && is_defined(b));
  FITGAUGE_OP(JumpNotEqual);
    FITGAUGE_BRANCH(is_defined(a) && is_defined(b) && !are_equal(a, b), are_equal(a, b));
  FITGAUGE_OP(JumpGreater);
    FITGAUGE_BRANCH(a > b, a <= b);
  FITGAUGE_OP(JumpLess);
    FITGAUGE_BRANCH(a < b, a >= b);
  FITGAUGE_OP(JumpDefined);
    pc = is_defined(cells[pc->a]) ? code + pc->c : pc + 1;
    FITGAUGE_NEXT();
  FITGAUGE_OP(JumpUndefined);
    pc = is_defined(cells[pc->a]) ? pc + 1 : code + pc->c;
    FITGAUGE_NEXT();
  FITGAUGE_OP(JumpWhen);
    FITGAUGE_CALL(jump_when(pc));

  FITGAUGE_OP(AddThenAdd);
    FITGAUGE_KEEP(cells[pc->a] + cells[pc->b]);
    FITGAUGE_BEGIN();
    FITGAUGE_STORE(cells[pc->a] + cells[pc->b]);
  FITGAUGE_OP(AddThenJumpLess);
    FITGAUGE_KEEP(cells[pc->a] + cells[pc->b]);
    FITGAUGE_BEGIN();
    FITGAUGE_BRANCH(a < b, a >= b);
  FITGAUGE_OP(AddTwiceThenJumpLess);
    FITGAUGE_KEEP(cells[pc->a] + cells[pc->b]);
    FITGAUGE_BEGIN();
    FITGAUGE_KEEP(cells[pc->a] + cells[pc->b]);
    FITGAUGE_BEGIN();
    FITGAUGE_BRANCH(a < b, a >= b);

  FITGAUGE_OP(Count);
    ++pc;
    FITGAUGE_NEXT();
  op_SkipBlock:
    pc = channel_.options.block_skip ? code + pc->c : pc + 1;
    FITGAUGE_NEXT();
  FITGAUGE_OP(CallLabel);
    FITGAUGE_CALL(call_label(pc->c, pc));
  FITGAUGE_OP(LabelEnd);
    FITGAUGE_CALL(end_label(pc));
  FITGAUGE_OP(Repeat);
    FITGAUGE_CALL(repeat(pc));
  FITGAUGE_OP(Statement);
    FITGAUGE_CALL(statement(pc));
  FITGAUGE_OP(End);
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
done:
  if (error_) enter(pc);
  if (failed_at_) channel_.block = *failed_at_;
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
