#pragma once

#include "service/runs/active_run.hpp"

namespace fitgauge::app {

/// Services of a run; shared by all runs.
struct RunSurroundings {
  const interpreter::ControlDisk& disk;
  interpreter::ProgramCache& programs;
  const Clock& clock;
  const TraceFormat& trace;
  bool shows_last = false;  ///< whether the run's last state is shown, with its files
};

struct ExecutedRun {
  interpreter::RunResult result;
  std::string trace;  ///< packed: TraceReader reads it
};

/// Builds the machine of the run's setup and runs its program on the calling thread; reports the
/// progress to `active`. Errors of the program are in the result.
/// @throws if the storage fails, or for a bug.
ExecutedRun execute(const RunSurroundings& surroundings, ActiveRun& active);

/// Result of a run that did not reach its first block.
interpreter::RunResult unstarted(interpreter::RunStatus status, interpreter::MessageKind kind,
                                 std::string text, std::string program);

/// Returns the measurements of a run (decision 27): one for each value that a cycle judged by
/// limits of its block, so the verdict of the cycle is among them. A cycle without a judged value
/// gives its first value without a verdict; cycles 0 and 1 give none. The texts are views of the
/// report and the order.
std::vector<Measurement> measurements_of(const RunReport& report,
                                         const std::optional<std::string>& caller);

}  // namespace fitgauge::app
