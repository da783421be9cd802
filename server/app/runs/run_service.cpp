#include "app/runs/run_service.hpp"

#include <chrono>

#include "app/files/draft_disk.hpp"
#include "app/files/file_check.hpp"
#include "app/measurements/mapping.hpp"
#include "app/measurements/measurement_storage.hpp"
#include "app/runs/run_executor.hpp"
#include "app/runs/run_measurements.hpp"
#include "base/guarded.hpp"
#include "program/check.hpp"
#include "store/database.hpp"
#include "store/storage_failure.hpp"

namespace fitgauge::app {
namespace {

using interpreter::MessageKind;
using interpreter::RunStatus;

constexpr std::string_view kFinishedEvent = "run.finished";
/// Requests that wait to be checked.
constexpr std::size_t kPreparing = 256;
/// What one of them may take.
constexpr std::chrono::seconds kPreparingTime{5};
constexpr std::size_t kPreparingMemory = std::size_t{48} << 20;
/// Runs an answer or a start looks at together.
constexpr std::size_t kPage = 100;

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
    case store::RunStatus::Running: return RunState::Running;
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

Error unknown_run(const std::string& id) {
  return {ErrorCode::RunUnknown, "there is no run '" + id + "'"};
}

Error stopping() {
  return {ErrorCode::ShuttingDown, "the service is shutting down and takes no more runs"};
}

/// Of a run that ends because the service does, the last moves are not written down: a long trace
/// is 15 MB of text, and the end of the service would wait for it.
void shorten(RunTrace& trace) {
  constexpr std::size_t kMostMoves = 1000;
  if (trace.moves.size() <= kMostMoves) return;
  trace.dropped += trace.moves.size() - kMostMoves;
  trace.moves.erase(trace.moves.begin() + kMostMoves, trace.moves.end());
}

}  // namespace

RunService::RunService(store::Database& database, const TableCatalog& tables, const Clock& clock,
                       std::string_view origin, RunServiceOptions options)
    : database_(database),
      clock_(clock),
      origin_(origin),
      options_(options),
      live_tables_(tables),
      stored_(database),
      control_tables_(stored_),
      meshes_(stored_),
      preparing_(1, kPreparing),
      // What may be queued is limited where runs are started.
      running_(options.workers, options.workers + options.queue) {}

RunService::~RunService() { stop(); }

Result<void> RunService::open(RunFormat format) {
  format_ = std::move(format);
  for (const RunState state : {RunState::Queued, RunState::Running}) {
    if (auto closed = close_interrupted(state); !closed) return closed;
  }
  return {};
}

Result<void> RunService::close_interrupted(RunState state) {
  while (true) {
    const auto page = database_.readers().wait(
        [state](const store::Stores& stores) -> Result<store::RunsStore::Page> {
          return stores.runs.list({.status = run_status(state)}, {}, kPage);
        });
    if (!page) return page.error();
    for (const store::Run& run : page->runs) {
      const RunReport report{.id = run.id,
                             .origin = origin_,
                             .program = run.program,
                             .result = unstarted(RunStatus::Failed, MessageKind::Error,
                                                 "the service ended before the run did; nothing "
                                                 "it had done was kept",
                                                 run.program),
                             .seed = format_.seed(run.request),
                             .created_at = {run.created_at_ns},
                             .finished_at = clock_.now()};
      const auto kept = keep(report, {}, run.caller);
      if (!kept) return kept.error();
    }
    if (!page->next) return {};
  }
}

void RunService::stop() {
  stopping_.request_stop();
  preparing_.stop();
  {
    const std::lock_guard lock(mutex_);
    for (const auto& [id, entry] : active_) entry.run->cancel();
  }
  running_.stop();
}

void RunService::prepare(std::function<void()> work, const std::function<void(Error)>& refused) {
  // Work that throws drops what it had to answer, and that answers for itself.
  auto unless_stopping = [this, work = std::move(work), refused] {
    if (stopping_.stop_requested()) return refused(stopping());
    work();
  };
  if (preparing_.submit(std::move(unless_stopping))) return;
  if (stopping_.stop_requested()) return refused(stopping());
  refused({ErrorCode::Overloaded, "too many runs and checks wait already; try again soon"});
}

Result<RunService::Diagnostics> RunService::check(const interpreter::ControlPath& path,
                                                  std::optional<std::string> draft) {
  return check_with(check_file, path, std::move(draft));
}

Result<RunService::Diagnostics> RunService::check_program(const interpreter::ControlPath& path) {
  return check_with(interpreter::check, path);
}

Result<RunService::Diagnostics> RunService::check_with(Check find_all,
                                                       const interpreter::ControlPath& path,
                                                       std::optional<std::string> draft) try {
  const interpreter::ProjectingDisk disk(stored_, live_tables_.projections());
  Allowance allowance(kPreparingTime, kPreparingMemory, stopping_.get_token());
  if (!draft) return find_all(path, disk, programs_, allowance);
  return find_all(path, DraftDisk(disk, path, *std::move(draft)), programs_, allowance);
} catch (const store::StorageFailure& failure) {
  return failure.error();
}

Result<std::string> RunService::format(const interpreter::ControlPath& path) try {
  return format_file(path, stored_);
} catch (const store::StorageFailure& failure) {
  return failure.error();
}

Result<std::shared_ptr<const ControlTables>> RunService::control_tables() try {
  Allowance allowance(kPreparingTime, kPreparingMemory, stopping_.get_token());
  return control_tables_.read(allowance);
} catch (const store::StorageFailure& failure) {
  return failure.error();
}

Result<void> RunService::load_meshes(machine::Setup& setup, std::string_view pointer,
                                     MissingFiles missing) try {
  return meshes_.load(setup, pointer, missing);
} catch (const store::StorageFailure& failure) {
  return failure.error();
}

Result<std::optional<Answer>> RunService::kept_answer(const IdempotencyScope& scope) {
  return database_.readers().wait(
      [request = to_store(scope)](const store::Stores& stores) -> Result<std::optional<Answer>> {
        auto found = stores.idempotency.find(request);
        if (!found) return found.error();
        if (!*found) return std::optional<Answer>();
        return std::optional(from_store(**std::move(found)));
      });
}

Result<std::shared_ptr<ActiveRun>> RunService::start(RunOrder order,
                                                     const std::optional<IdempotencyScope>& scope,
                                                     const Accepted& accepted) {
  if (stopping_.stop_requested()) return stopping();
  {
    // Only the preparing thread adds runs, so that there is still room when the row is stored.
    const std::lock_guard lock(mutex_);
    if (active_.size() >= options_.workers + options_.queue) {
      return Error{ErrorCode::Overloaded, "too many runs wait already; try again soon"};
    }
  }
  const auto shared = std::make_shared<const RunOrder>(std::move(order));
  const store::Run row{.status = store::RunStatus::Queued,
                       .program = shared->program.text(),
                       .request = shared->request,
                       .created_at_ns = clock_.now().nanoseconds,
                       .caller = shared->caller};
  std::shared_ptr<ActiveRun> active;
  const auto create = [&](store::Stores& stores) -> Result<store::StoredAnswer> {
    active = std::make_shared<ActiveRun>(stores.runs.create(row), origin_, shared,
                                         Timestamp{row.created_at_ns});
    return to_store(accepted(*active));
  };
  const auto created = scope ? database_.writer().wait_once(to_store(*scope), create)
                             : database_.writer().wait(create);
  if (!created) return created.error();
  if (created->replayed) {
    return Error{ErrorCode::IdempotencyInProgress,
                 "another request with this Idempotency-Key came first; try again"};
  }
  bool is_queued = false;
  {
    const std::lock_guard lock(mutex_);
    const auto ticket = running_.submit([this, active] { run(active); });
    active_.emplace(active->id(), Entry{active, ticket.value_or(0)});
    is_queued = ticket.has_value();
  }
  if (!is_queued) {
    end(*active,
        unstarted(RunStatus::Failed, MessageKind::Error,
                  "the service takes no more runs: it is shutting down", active->program()),
        {});
  }
  return active;
}

void RunService::run(const std::shared_ptr<ActiveRun>& run) {
  ActiveRun& active = *run;
  if (options_.keeps_newest) {
    const std::lock_guard lock(mutex_);
    newest_ = run;
  }
  active.started();
  // Not waited for: the writer keeps the order of its jobs.
  database_.writer().submit(
      [id = active.id()](store::Stores& stores) { return stores.runs.start(id); },
      [](const Result<void>&) {});
  RunTrace trace;
  interpreter::RunResult result = execute_guarded(active, trace);
  if (stopping_.stop_requested()) shorten(trace);
  end(active, std::move(result), trace);
}

void RunService::end(ActiveRun& active, interpreter::RunResult result, const RunTrace& trace) {
  const RunReport report{.id = active.id(),
                         .origin = origin_,
                         .program = active.program(),
                         .result = std::move(result),
                         .seed = active.order().setup.seed,
                         .created_at = active.created_at(),
                         .finished_at = clock_.now()};
  Result<FinishedRun> kept = Error{ErrorCode::Internal, "the end of the run could not be stored"};
  guarded("the end of a run", [&] { kept = keep(report, trace, active.order().caller); });
  guarded("the end of a run", [&] { active.finished(std::move(kept)); });
  const std::lock_guard lock(mutex_);
  ++ended_[static_cast<std::size_t>(state_of(report.result.status))];
  active_.erase(report.id);
}

void RunService::cancel(const std::shared_ptr<ActiveRun>& active) {
  active->cancel();
  const auto ticket = preparing_.submit([this, active] {
    if (!withdraw(active->id())) return;
    end(*active,
        unstarted(RunStatus::Cancelled, MessageKind::Cancelled,
                  "the run was cancelled before its first block", active->program()),
        {});
  });
  static_cast<void>(ticket);  // where there is no room, the worker whose turn it is ends the run
}

/// @returns whether the run was queued; now no worker will begin it.
bool RunService::withdraw(std::int64_t id) {
  const std::lock_guard lock(mutex_);
  const auto found = active_.find(id);
  return found != active_.end() && running_.withdraw(found->second.ticket);
}

/// A bug or broken storage ends the run, not the service.
interpreter::RunResult RunService::execute_guarded(ActiveRun& active, RunTrace& trace) try {
  const interpreter::ProjectingDisk disk(stored_, live_tables_.projections());
  ExecutedRun executed = execute({disk, programs_, clock_, options_.keeps_newest}, active);
  trace = std::move(executed.trace);
  return std::move(executed.result);
} catch (const std::exception& failure) {
  return unstarted(RunStatus::Failed, MessageKind::Error,
                   std::string("the service failed: ") + failure.what(), active.program());
}

/// One transaction for all that a run leaves.
Result<FinishedRun> RunService::keep(const RunReport& report, const RunTrace& trace,
                                     const std::optional<std::string>& caller) {
  FinishedRun finished{.state = state_of(report.result.status), .report = format_.report(report)};
  const std::string trace_text = format_.trace(trace);
  const std::string event = format_.event(report);
  std::vector<store::RunFile> files;
  files.reserve(report.result.files.size());
  for (const interpreter::WrittenFile& file : report.result.files) {
    files.push_back({.path = file.path.text(), .content = file.bytes});
  }
  std::vector<Measurement> measurements = measurements_of(report, caller);
  const auto store = [&](store::Stores& stores) -> Result<bool> {
    const std::int64_t now = report.finished_at.nanoseconds;
    const auto closed = stores.runs.finish(report.id,
                                           {.status = run_status(finished.state),
                                            .result = finished.report,
                                            .trace = trace_text,
                                            .files = files},
                                           now);
    if (!closed) return closed.error();
    if (const auto first = append(stores, measurements, std::nullopt, origin_); !first) {
      return first.error();
    }
    stores.events.append(kFinishedEvent, event, now);
    return true;
  };
  // What a run has done is not thrown away because the writer is busy for a moment.
  for (int attempt = 0;; ++attempt) {
    const auto stored = database_.writer().wait(store);
    if (stored) return finished;
    constexpr int kAttempts = 100;
    if (stored.error().code != ErrorCode::StorageBusy || attempt == kAttempts) {
      return stored.error();
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
}

RunService::Counts RunService::counts() const {
  const std::lock_guard lock(mutex_);
  Counts counts = ended_;
  for (const auto& [id, entry] : active_) {
    const RunState state = entry.run->state();
    if (state <= RunState::Running) ++counts[static_cast<std::size_t>(state)];
  }
  return counts;
}

std::shared_ptr<ActiveRun> RunService::newest() const {
  const std::lock_guard lock(mutex_);
  return newest_;
}

std::shared_ptr<ActiveRun> RunService::active(std::int64_t id) const {
  const std::lock_guard lock(mutex_);
  const auto found = active_.find(id);
  return found == active_.end() ? nullptr : found->second.run;
}

void RunService::find(std::int64_t id, Done<StoredRun> done) {
  database_.readers().submit(
      [this, id](const store::Stores& stores) -> Result<StoredRun> {
        auto run = stores.runs.find(id);
        if (!run) return unknown_run(run_id_text(id, origin_));
        return stored_run(*std::move(run), origin_);
      },
      std::move(done));
}

void RunService::trace(std::int64_t id, Done<std::string> done) {
  database_.readers().submit(
      [this, id](const store::Stores& stores) -> Result<std::string> {
        if (auto trace = stores.runs.trace(id)) return *std::move(trace);
        if (!stores.runs.find(id)) return unknown_run(run_id_text(id, origin_));
        return Error{ErrorCode::RunUnfinished, "run '" + run_id_text(id, origin_) +
                                                   "' is not over; its trace comes with its end"};
      },
      std::move(done));
}

void RunService::file(std::int64_t id, std::string name, Done<File> done) {
  database_.readers().submit(
      [this, id, name = std::move(name)](const store::Stores& stores) -> Result<File> {
        if (auto file = stores.runs.file(id, name)) {
          return File{.path = std::move(file->path), .bytes = std::move(file->content)};
        }
        if (!stores.runs.find(id)) return unknown_run(run_id_text(id, origin_));
        return Error{ErrorCode::FileUnknown,
                     "run '" + run_id_text(id, origin_) + "' has written no file '" + name + "'"};
      },
      std::move(done));
}

void RunService::list(RunQuery query, std::optional<std::int64_t> after, std::size_t limit,
                      Done<Page> done) {
  store::RunFilter filter{.program = std::move(query.program)};
  if (query.state) filter.status = run_status(*query.state);
  database_.readers().submit(
      [this, filter = std::move(filter), after,
       limit](const store::Stores& stores) -> Result<Page> {
        store::RunsStore::Page found = stores.runs.list(filter, after, limit);
        Page page{.runs = {}, .next = found.next};
        for (store::Run& run : found.runs) {
          run.request.clear();
          run.result.clear();
          page.runs.push_back(stored_run(std::move(run), origin_));
        }
        return page;
      },
      std::move(done));
}

}  // namespace fitgauge::app
