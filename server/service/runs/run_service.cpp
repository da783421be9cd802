#include "service/runs/run_service.hpp"

#include "db/store/database.hpp"
#include "nc/program/program_cache.hpp"
#include "service/measurements/measurement_storage.hpp"

namespace fitgauge::app {
namespace {

using interpreter::MessageKind;
using interpreter::RunStatus;

}  // namespace

RunService::RunService(const Records& records, JobPool& orders, RunServiceOptions options)
    : Records(records),
      options_(options),
      live_tables_(tables_),
      stored_(database_),
      control_tables_(stored_),
      meshes_(stored_),
      orders_(orders),
      // The start of runs limits the queue.
      running_("a run", options.workers, options.workers + options.queue) {}

RunService::~RunService() { stop(); }

Result<void> RunService::open(RunFormat format) {
  format_ = std::move(format);
  storing_ = Thread("ends of runs", [this](const std::stop_token& stop) { store_waiting(stop); });
  if (!options_.shares) return close_interrupted();
  looking_ =
      Thread("abandoned runs", [this](const std::stop_token& stop) { look_for_abandoned(stop); });
  const auto has_any = [this] {
    const std::lock_guard lock(mutex_);
    return !active_.empty();
  };
  const auto cancel_own = [this](std::int64_t id) {
    const auto own = active(id);
    if (own && !own->stop_token().stop_requested()) cancel(own);
  };
  shared_ = std::make_unique<SharedRuns>(database_, SharedRuns::Own{has_any, cancel_own});
  return {};
}

void RunService::stop() {
  looking_.stop();
  if (shared_) shared_->stop();
  {
    const std::lock_guard lock(mutex_);
    for (const auto& [id, entry] : active_) entry.run->cancel();
  }
  running_.stop();
  storing_.stop();
}

Result<std::shared_ptr<ActiveRun>> RunService::start(RunOrder order,
                                                     const std::optional<IdempotencyScope>& scope,
                                                     const Accepted& accepted) {
  if (orders_.is_called_off()) return shutting_down();
  const std::lock_guard starting(starting_);
  {
    const std::lock_guard lock(mutex_);
    if (active_.size() >= options_.workers + options_.queue) {
      return Error{ErrorCode::Overloaded, "too many runs are waiting: try again soon"};
    }
  }
  const auto shared = std::make_shared<const RunOrder>(std::move(order));
  const store::Run row{.status = store::RunStatus::Queued,
                       .program = shared->program.text(),
                       .request = shared->request,
                       .created_at = clock_.now(),
                       .caller = shared->caller};
  std::shared_ptr<ActiveRun> active;
  const auto create = [&](Stores& stores) -> Result<Answer> {
    active = std::make_shared<ActiveRun>(stores.runs.create(row), origins_.own(), shared,
                                         row.created_at);
    return accepted(*active);
  };
  const auto created = TRY(scope ? database_.writer().wait_once(to_store(*scope), create)
                                 : database_.writer().wait(create));
  if (created.replayed) {
    return Error{ErrorCode::IdempotencyInProgress,
                 "another request with this Idempotency-Key was first: try again"};
  }
  return queue(std::move(active));
}

Result<std::shared_ptr<ActiveRun>> RunService::queue(std::shared_ptr<ActiveRun> active) {
  bool is_queued = false;
  {
    const std::lock_guard lock(mutex_);
    const auto ticket = running_.submit([this, active] { run(active); });
    active_.emplace(active->id(), Entry{active, ticket.value_or(0)});
    is_queued = ticket.has_value();
  }
  if (!is_queued) {
    end(*active, without_moves(unstarted(RunStatus::Failed, MessageKind::Error,
                                         shutting_down().message, active->program())));
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
  database_.writer().submit([id = active.id()](Stores& stores) { return stores.runs.start(id); },
                            [](const Result<void>&) {});
  end(active, execute_guarded(active));
}

void RunService::end(ActiveRun& active, ExecutedRun executed) {
  if (executed.result.blocks_executed == 0) {
    executed.result.active_preset = active.order().setup.machine.active_preset;
  }
  RunReport report{.id = active.id(),
                   .origin = origin_of(active.id()),
                   .program = active.program(),
                   .result = std::move(executed.result),
                   .seed = active.order().setup.seed,
                   .subject = active.order().subject,
                   .created_at = active.created_at(),
                   .finished_at = clock_.now()};
  active.being_stored();
  // The place is free before listeners hear of the end.
  auto kept = keep_or_wait({std::move(report), std::move(executed.trace), active.order().caller});
  guarded("the end of a run", [&] { active.finished(std::move(kept)); });
}

void RunService::cancel(const std::shared_ptr<ActiveRun>& active) {
  active->cancel();
  const auto end_queued = [this, active]() -> Result<void> {
    if (!withdraw(active->id())) return {};
    end(*active, without_moves(unstarted(RunStatus::Cancelled, MessageKind::Cancelled,
                                         "the run was cancelled before its first block",
                                         active->program())));
    return {};
  };
  // If the queue is full, the worker of the run ends it.
  orders_.run(end_queued, [](const Result<void>&) {});
}

/// @returns whether the run was queued; now no worker will begin it.
bool RunService::withdraw(std::int64_t id) {
  const std::lock_guard lock(mutex_);
  const auto found = active_.find(id);
  return found != active_.end() && running_.withdraw(found->second.ticket);
}

/// A bug or broken storage ends the run, not the service.
ExecutedRun RunService::execute_guarded(ActiveRun& active) try {
  const interpreter::ProjectingDisk disk(stored_, live_tables_.projections());
  return execute({disk, programs_, clock_, format_.trace, options_.keeps_newest}, active);
} catch (const std::exception& failure) {
  return without_moves(unstarted(RunStatus::Failed, MessageKind::Error,
                                 std::string("the service failed: ") + failure.what(),
                                 active.program()));
}

ExecutedRun RunService::without_moves(interpreter::RunResult result) const {
  return {std::move(result), empty_trace(format_.trace)};
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
  auto run = own(id);
  return run && !run->is_being_stored() ? run : nullptr;
}

std::vector<std::string> RunService::queued(
    const std::function<bool(const RunOrder&)>& names_it) const {
  std::vector<std::string> users;
  const std::lock_guard lock(mutex_);
  for (const auto& [id, entry] : active_) {
    if (entry.run->state() == RunState::Queued && names_it(entry.run->order())) {
      users.push_back("queued run " + entry.run->id_text());
    }
  }
  return users;
}

std::shared_ptr<ActiveRun> RunService::own(std::int64_t id) const {
  const std::lock_guard lock(mutex_);
  const auto found = active_.find(id);
  return found == active_.end() ? nullptr : found->second.run;
}

}  // namespace fitgauge::app
