#pragma once

#include "nc/run/run_budget.hpp"
#include "nc/run/run_observer.hpp"

namespace fitgauge::interpreter {

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
  void finish(const NcError& error, const Place& place,
              std::vector<klartext::DiagnosticNote> origins);
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
std::vector<klartext::DiagnosticNote> origins_of(std::span<const Place> chain,
                                                 const NcError& error);

/// The blocks that the values of a block depend on, if it measures or reads data of the control.
std::vector<klartext::DiagnosticNote> origins_of_values(std::span<const Place> chain);

}  // namespace fitgauge::interpreter
