#pragma once

#include "base/allowance.hpp"
#include "nc/run/nc_error.hpp"
#include "nc/run/run_result.hpp"

namespace fitgauge::interpreter {

/// Budget of one run. A run above one of these limits ends with LimitExceeded. The two depths are
/// limits of the control (error 1025).
struct RunLimits {
  std::uint64_t blocks = 1'000'000;
  std::chrono::duration<double> time{10.0};         ///< of the wall clock
  std::size_t label_depth = 19;                     ///< subprograms nested by CALL LBL
  std::size_t program_depth = 19;                   ///< programs nested by CALL PGM
  std::size_t output_bytes = std::size_t{4} << 20;  ///< screen, files, messages and records
  std::size_t files = 100;                          ///< written
  /// Memory of the run: programs, tables, masks, presets, files, records, its trace.
  std::size_t memory_bytes = std::size_t{48} << 20;
};

/// The blocks of a run, and its allowance of time and memory. The executor reserves blocks in
/// portions and counts them itself; the allowance is checked with each portion, with each block
/// that is more than arithmetic, and in every loop inside of such a block.
class RunBudget {
 public:
  /// @param allowance is also that of the run's machine, and must outlive the budget
  RunBudget(const RunLimits& limits, Allowance& allowance)
      : limits_(limits), allowance_(allowance) {}

  /// Returns the rest of a portion and reserves a new one of at least `needed` blocks.
  /// @errors limit (blocks, time), cancelled.
  NcResult<std::int64_t> refuel(std::int64_t left, std::int64_t needed);
  /// The rest of a portion if its executor ends before the run.
  void give_back(std::int64_t left) { granted_ -= static_cast<std::uint64_t>(left); }
  /// Checks the budget. Call it in loops, and for each block that is more than arithmetic.
  /// @errors limit (time, memory), cancelled.
  NcResult<void> check() {
    if (!allowance_.is_spent()) [[likely]]
      return {};
    return *refusal();
  }
  /// Returns the refusal of an earlier check, if the allowance is spent: it is the cause of later
  /// failures.
  std::optional<NcError> refusal() const;

  Allowance& allowance() { return allowance_; }

  /// @param left of the last portion.
  std::uint64_t executed(std::int64_t left) const {
    return granted_ - static_cast<std::uint64_t>(left);
  }

 private:
  static constexpr std::int64_t kPortion = 8192;

  const RunLimits limits_;
  Allowance& allowance_;
  std::uint64_t granted_ = 0;
};

/// The rest of the run's output budget; every stored text is charged to it.
class OutputBudget {
 public:
  explicit OutputBudget(std::size_t bytes) : total_(bytes), left_(bytes) {}
  /// @errors limit when it is used up; nothing is charged then.
  NcResult<void> charge(std::size_t bytes);
  std::size_t left() const { return left_; }

 private:
  std::size_t total_;
  std::size_t left_;
};

/// The output of a run: screen, messages, measurements. Owns them until they are moved out.
class RunLog {
 public:
  RunLog(OutputBudget& budget, RunObserver& observer) : budget_(budget), observer_(observer) {}

  /// A line of the screen window. @errors limit.
  NcResult<void> print(std::string line);
  /// A message that does not end the run. @errors limit.
  NcResult<void> report(MessageKind kind, int number, std::string text, const Place& place);
  /// Something the simulation leaves out: reported the first time only. @errors limit.
  NcResult<void> note(std::string text, const Place& place);
  /// The message of the error that ends the run; not charged, so that it is always there.
  void finish(const NcError& error, const Place& place, std::vector<DiagnosticNote> origins);
  /// @param chain as of origins_of_values. @errors limit.
  NcResult<void> record(probing::MeasuringRecord record, std::span<const Place> chain);

  void take(RunResult& result);

 private:
  void add(MessageKind kind, int number, std::string text, const Place& place);

  OutputBudget& budget_;
  RunObserver& observer_;
  std::vector<std::string> screen_;
  std::vector<RunMessage> messages_;
  std::vector<Measurement> measurements_;
  std::set<std::string, std::less<>> notes_;
};

// origins.cpp
/// Returns the blocks that a failing block depends on, each with its effect: on the parameters that
/// the failing block reads, on the parameters these were computed from, and, if the error can come
/// from them, on axes that it does not move, datum, tool and unit INCH. Names for each the block
/// that ran last before it, as far as the calls of subprograms tell this.
/// @param chain the failing block, then the blocks after the calls that lead to it
std::vector<DiagnosticNote> origins_of(std::span<const Place> chain, const NcError& error);

/// The blocks that the values of a block depend on, if it measures or reads data of the control.
std::vector<DiagnosticNote> origins_of_values(std::span<const Place> chain);

}  // namespace fitgauge::interpreter
