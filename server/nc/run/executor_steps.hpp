#pragma once

#include "nc/run/channel.hpp"

namespace fitgauge::interpreter {

/// Steps that the loop over the code of a run leaves to a function: everything but arithmetic and
/// plain jumps.
class ExecutorSteps {
 protected:
  /// @param announces whether the loop itself notifies the observer of each block
  ExecutorSteps(Channel& channel, bool announces)
      : channel_(channel), depth_(channel.calls.depth()), announces_(announces) {}

  /// Continuation after LBL 0 of a subprogram that a cycle runs.
  static constexpr std::uint32_t kBackToCycle = std::numeric_limits<std::uint32_t>::max();

  void load_program() {
    code_ = channel_.linked().code().data();
    cells_ = channel_.parameters.cells();
  }

  std::uint32_t index_of(const Instruction* pc) const {
    return static_cast<std::uint32_t>(pc - code_);
  }

  /// Reports the current block.
  void enter(const Instruction* pc) { channel_.block = channel_.linked().block_of(index_of(pc)); }

  void announce(const Instruction* pc) {
    if (pc->blocks == 0) return;
    enter(pc);
    channel_.before = std::exchange(channel_.entered, channel_.place());
    channel_.environment.observer.entered(channel_.entered);
  }

  NcError value_error(const Instruction& instruction) const;
  bool give_preassigned(const Instruction& instruction);
  bool refuel(std::int64_t needed);
  // The next instruction; null after an error and at the end of the run.
  const Instruction* evaluate_node(const Instruction* pc);
  void enter_program(double unit, std::span<const double> locals);
  const Instruction* call_program(std::shared_ptr<const LinkedProgram> program,
                                  std::uint32_t return_to);
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

  Channel& channel_;
  const Instruction* code_ = nullptr;
  double* cells_ = nullptr;
  std::int64_t fuel_ = 0;
  std::optional<NcError> error_;
  bool has_returned_ = false;               ///< to the cycle that runs a subprogram
  std::optional<std::uint32_t> failed_at_;  ///< the block, if it is in that subprogram

 private:
  const std::size_t depth_;  ///< of the program in which this began
  const bool announces_;
};

}  // namespace fitgauge::interpreter
