#include "service/runs/stored_run.hpp"

#include <utility>

#include "db/store/runs_store.hpp"

namespace fitgauge::app {

store::RunStatus run_status(RunState state) {
  switch (state) {
    case RunState::Queued: return store::RunStatus::Queued;
    case RunState::Running: return store::RunStatus::Running;
    case RunState::Completed: return store::RunStatus::Completed;
    case RunState::Stopped: return store::RunStatus::Stopped;
    case RunState::Failed: return store::RunStatus::Failed;
    case RunState::LimitExceeded: return store::RunStatus::LimitExceeded;
    case RunState::Cancelled: break;
  }
  return store::RunStatus::Cancelled;
}

RunState run_state(store::RunStatus status) {
  switch (status) {
    case store::RunStatus::Queued: return RunState::Queued;
    case store::RunStatus::Running:
    case store::RunStatus::Cancelling: return RunState::Running;
    case store::RunStatus::Completed: return RunState::Completed;
    case store::RunStatus::Stopped: return RunState::Stopped;
    case store::RunStatus::Failed: return RunState::Failed;
    case store::RunStatus::LimitExceeded: return RunState::LimitExceeded;
    case store::RunStatus::Cancelled: break;
  }
  return RunState::Cancelled;
}

StoredRun stored_run(store::Run run, std::string_view origin) {
  StoredRun stored{.id = run.id,
                   .origin = origin,
                   .state = run_state(run.status),
                   .program = std::move(run.program),
                   .request = std::move(run.request),
                   .report = std::move(run.result),
                   .created_at = {run.created_at_ns},
                   .finished_at = {}};
  if (run.finished_at_ns) stored.finished_at = Timestamp{*run.finished_at_ns};
  return stored;
}

}  // namespace fitgauge::app
