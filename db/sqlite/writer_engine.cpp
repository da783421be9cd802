#include "sqlite/writer_engine.hpp"

#include <exception>

#include "sqlite/maintenance.hpp"
#include "store/storage_failure.hpp"

namespace fitgauge::store {
namespace {

using std::chrono::milliseconds;

constexpr milliseconds kAtOnce{0};
constexpr milliseconds kProbeInterval{1'000};
constexpr milliseconds kQuiet{200};  ///< without a write: time to tidy up
constexpr milliseconds kTidyInterval{60'000};

Error internal_error(const std::exception& bug) {
  return {ErrorCode::Internal, std::string("a storage job failed: ") + bug.what()};
}

}  // namespace

Writer::Engine::Engine(const OpenOptions& options, const Clock& clock, HealthMonitor& health)
    : options_(options), clock_(clock), health_(health), queue_(options.queue_limit) {
  checkpointer_.emplace(options);
  session();
  thread_ = std::thread([this] { run(); });
}

Writer::Engine::~Engine() {
  queue_.close();
  thread_.join();
}

bool Writer::Engine::begin(const IdempotentRequest& request) {
  const std::lock_guard lock(under_way_mutex_);
  return under_way_.emplace(request.caller, request.method, request.path, request.key).second;
}

void Writer::Engine::end(const IdempotentRequest& request) {
  const std::lock_guard lock(under_way_mutex_);
  under_way_.erase({request.caller, request.method, request.path, request.key});
}

void Writer::Engine::run() {
  while (true) {
    Jobs jobs = queue_.take_all(patience_);
    if (jobs.empty()) {
      if (queue_.closed()) break;
      idle();
    } else if (options_.commit_each) {
      for (std::unique_ptr<WriteJob>& job : jobs) {
        Jobs one;
        one.push_back(std::move(job));
        commit(std::move(one));
      }
    } else {
      commit(std::move(jobs));
    }
    if (session_) checkpointer_->go_on(session_->connection);
  }
  checkpointer_.reset();
  session_.reset();  // the last connection to close also checkpoints
}

/// One transaction for all jobs, then their outcomes.
void Writer::Engine::commit(Jobs jobs) {
  std::vector<std::optional<Error>> errors(jobs.size());
  const std::optional<Error> error = try_commit(jobs, errors);
  if (error) errors.assign(jobs.size(), error);
  const auto tell_outcomes = [&] {
    for (std::size_t i = 0; i < jobs.size(); ++i) {
      errors[i] ? jobs[i]->refuse(*std::move(errors[i])) : jobs[i]->deliver();
    }
  };
  options_.around_outcomes ? options_.around_outcomes(tell_outcomes) : tell_outcomes();
  if (!error && options_.committed) options_.committed();
}

/// @returns what concerns the whole batch; `errors` gets what concerns one job.
std::optional<Error> Writer::Engine::try_commit(Jobs& jobs,
                                                std::vector<std::optional<Error>>& errors) {
  const Health health = health_.health();
  if (health.state == HealthState::Damaged) return Error{ErrorCode::StorageCorrupt, health.reason};
  std::optional<Error> error;
  try {
    session().begin_writing.run();
    for (std::size_t i = 0; i < jobs.size(); ++i) errors[i] = run_in_savepoint(*jobs[i]);
    session().commit.run();
    succeed();
    patience_ = kQuiet;
  } catch (const StorageFailure& failure) {
    error = failure.error();
  } catch (const std::exception& bug) {
    error = internal_error(bug);
  }
  if (error) fail(*error);
  return error;
}

/// @returns the job's bug, if it threw. Broken storage concerns the whole batch and is thrown.
std::optional<Error> Writer::Engine::run_in_savepoint(WriteJob& job) {
  Session& session = *session_;
  session.savepoint.run();
  std::optional<Error> bug;
  bool keep = false;
  try {
    keep = job.run(session.stores);
  } catch (const StorageFailure&) {
    throw;
  } catch (const std::exception& thrown) {
    bug = internal_error(thrown);
  }
  if (!keep) session.undo.run();
  session.release.run();
  return bug;
}

/// Nothing to write: find out whether commits work again, or tidy up.
void Writer::Engine::idle() {
  if (health_.health().state == HealthState::Damaged) {
    patience_ = kTidyInterval;
    return;
  }
  try {
    if (failing_) {
      session().connection.execute("UPDATE storage_probe SET probed_at = probed_at + 1");
      succeed();
    }
    const bool more = tidy(session(), options_, clock_.now());
    patience_ = more ? kAtOnce : kTidyInterval;
  } catch (const StorageFailure& failure) {
    fail(failure.error());
  } catch (const std::exception& bug) {
    fail(internal_error(bug));
  }
}

void Writer::Engine::succeed() {
  failing_ = false;
  health_.writes_succeeded();
}

/// After a failure the connection starts afresh: what it holds in memory is not to be trusted.
void Writer::Engine::fail(const Error& error) {
  if (session_) session_->connection.rollback();
  session_.reset();
  failing_ = true;
  patience_ = kProbeInterval;
  if (error.code == ErrorCode::StorageCorrupt) {
    health_.damaged(error.message);
  } else {
    health_.writes_failed(error.message);
  }
}

Session& Writer::Engine::session() {
  if (!session_) {
    session_.emplace(options_, clock_, sqlite::Mode::Write);
    checkpointer_->take_over(session_->connection);
  }
  return *session_;
}

void Writer::enqueue(std::unique_ptr<Job<Stores>> job) { engine_.enqueue(std::move(job)); }
bool Writer::begin(const IdempotentRequest& request) { return engine_.begin(request); }
void Writer::end(const IdempotentRequest& request) { engine_.end(request); }

Error Writer::in_progress() {
  return {ErrorCode::IdempotencyInProgress,
          "the first request with this Idempotency-Key is still running; try again soon"};
}

}  // namespace fitgauge::store
