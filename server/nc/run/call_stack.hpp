#pragma once

#include "nc/program/linked_program.hpp"
#include "nc/run/run_log.hpp"

namespace fitgauge::interpreter {

/// The programs and subprograms that are being run, the main program first.
class CallStack {
 public:
  CallStack(std::shared_ptr<const LinkedProgram> main, const RunLimits& limits);

  const LinkedProgram& program() const { return *programs_.back().program; }
  const LinkedProgram& main_program() const { return *programs_.front().program; }
  bool is_in_main() const { return programs_.size() == 1; }
  /// Returns the number of programs that call each other, with the main program.
  std::size_t depth() const { return programs_.size(); }
  /// The program that called this one, or null in the main program.
  const LinkedProgram* caller() const {
    return is_in_main() ? nullptr : programs_[programs_.size() - 2].program.get();
  }

  /// Returns the calling blocks of the present block, the innermost first.
  std::vector<Place> behind_calls() const;

  /// @errors 1025 too deep.
  NcResult<void> call_label(std::uint32_t return_to);
  /// The instruction to return to, or nothing outside of a subprogram.
  std::optional<std::uint32_t> return_from_label();

  /// The saved state of the caller.
  struct Caller {
    std::uint32_t return_to = 0;
    std::vector<double> locals;
  };
  /// @errors 1025 too deep.
  NcResult<void> call_program(std::shared_ptr<const LinkedProgram> program, Caller caller);
  /// @pre not in the main program
  Caller return_from_program();

 private:
  struct Activation {
    std::shared_ptr<const LinkedProgram> program;
    Caller caller;
    std::size_t first_label = 0;  ///< of the returns that belong to this program
  };

  const std::size_t label_depth_;
  const std::size_t program_depth_;
  std::vector<Activation> programs_;
  std::vector<std::uint32_t> label_returns_;
};

}  // namespace fitgauge::interpreter
