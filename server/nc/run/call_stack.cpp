#include "nc/run/call_stack.hpp"

namespace fitgauge::interpreter {

CallStack::CallStack(std::shared_ptr<const LinkedProgram> main, const RunLimits& limits)
    : label_depth_(limits.label_depth), program_depth_(limits.program_depth) {
  programs_.push_back({std::move(main), {}, 0});
}

std::vector<Place> CallStack::behind_calls() const {
  std::vector<Place> all;
  const auto add = [&](const LinkedProgram& program, std::uint32_t instruction) {
    // A cycle that runs a subprogram has no such instruction.
    if (instruction < program.code().size())
      all.push_back({&program, program.block_of(instruction)});
  };
  std::size_t label = label_returns_.size();
  for (std::size_t i = programs_.size(); i-- > 0;) {
    while (label > programs_[i].first_label) add(*programs_[i].program, label_returns_[--label]);
    if (i > 0) add(*programs_[i - 1].program, programs_[i].caller.return_to);
  }
  return all;
}

NcResult<void> CallStack::call_label(std::uint32_t return_to) {
  if (label_returns_.size() >= label_depth_) {
    return nc_error(1025, "more than {} subprograms call each other", label_depth_);
  }
  label_returns_.push_back(return_to);
  return {};
}

std::optional<std::uint32_t> CallStack::return_from_label() {
  if (label_returns_.size() == programs_.back().first_label) return std::nullopt;
  const std::uint32_t target = label_returns_.back();
  label_returns_.pop_back();
  return target;
}

NcResult<void> CallStack::call_program(std::shared_ptr<const LinkedProgram> program,
                                       Caller caller) {
  if (programs_.size() > program_depth_) {
    return nc_error(1025, "more than {} programs call each other", program_depth_);
  }
  programs_.push_back({std::move(program), std::move(caller), label_returns_.size()});
  return {};
}

CallStack::Caller CallStack::return_from_program() {
  Activation ended = std::move(programs_.back());
  programs_.pop_back();
  label_returns_.resize(ended.first_label);
  return std::move(ended.caller);
}

}  // namespace fitgauge::interpreter
