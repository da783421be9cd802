#include "store/writer_engine.hpp"

#include <chrono>
#include <exception>
#include <vector>

#include "store/maintenance.hpp"
#include "store/storage_failure.hpp"

namespace fitgauge::store {
namespace {

using std::chrono::milliseconds;

constexpr milliseconds kProbeInterval{1'000};
constexpr milliseconds kQuiet{200};  ///< without a write: time to tidy up
constexpr milliseconds kTidyInterval{60'000};

Error internal_error(const std::exception& bug) {
  return {ErrorCode::Internal, std::string("a storage job failed: ") + bug.what()};
}

}  // namespace

Writer::Engine::Engine(const OpenOptions& options, const Clock& clock, HealthMonitor& health)
    : options_(options), clock_(clock), health_(health), queue_(options.queue_limit) {
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
    Jobs jobs = queue_.take_all(failing_ ? kProbeInterval : more_to_tidy_ ? kQuiet : kTidyInterval);
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
  }
  session_.reset();  // the last connection to close also checkpoints
}

/// One transaction for all jobs, then their outcomes.
void Writer::Engine::commit(Jobs jobs) {
  std::vector<std::optional<Error>> errors(jobs.size());
  const Health health = health_.health();
  std::optional<Error> batch_error;
  if (health.state == HealthState::Damaged) {
    batch_error = Error{ErrorCode::StorageCorrupt, health.reason};
  } else {
    try {
      commit_or_throw(jobs, errors);
    } catch (const StorageFailure& failure) {
      batch_error = failure.error();
    } catch (const std::exception& bug) {
      batch_error = internal_error(bug);
    }
    if (batch_error) {
      fail(*batch_error);
    } else {
      failing_ = false;
      more_to_tidy_ = true;
      health_.writes_succeeded();
    }
  }
  for (std::size_t i = 0; i < jobs.size(); ++i) {
    const std::optional<Error>& error = batch_error ? batch_error : errors[i];
    if (error) {
      jobs[i]->refuse(*error);
    } else {
      jobs[i]->deliver();
    }
  }
}

void Writer::Engine::commit_or_throw(Jobs& jobs, std::vector<std::optional<Error>>& errors) {
  sqlite::Connection& connection = session().connection;
  connection.execute("BEGIN IMMEDIATE");
  for (std::size_t i = 0; i < jobs.size(); ++i) errors[i] = run_in_savepoint(*jobs[i]);
  connection.execute("COMMIT");
}

/// @returns the job's bug, if it threw. Broken storage concerns the whole batch and is thrown.
std::optional<Error> Writer::Engine::run_in_savepoint(WriteJob& job) {
  sqlite::Connection& connection = session_->connection;
  connection.execute("SAVEPOINT job");
  std::optional<Error> bug;
  bool keep = false;
  try {
    keep = job.run(session_->stores);
  } catch (const StorageFailure&) {
    throw;
  } catch (const std::exception& thrown) {
    bug = internal_error(thrown);
  }
  connection.execute(keep ? "RELEASE job" : "ROLLBACK TO job; RELEASE job");
  return bug;
}

/// Nothing to write: find out whether commits work again, or tidy up.
void Writer::Engine::idle() {
  if (health_.health().state == HealthState::Damaged) {
    more_to_tidy_ = false;
    return;
  }
  try {
    if (failing_) {
      probe();
    } else {
      more_to_tidy_ = tidy(session(), options_, clock_.now());
    }
  } catch (const StorageFailure& failure) {
    fail(failure.error());
  } catch (const std::exception& bug) {
    fail(internal_error(bug));
  }
}

void Writer::Engine::probe() {
  session().connection.execute("UPDATE storage_probe SET probed_at = probed_at + 1");
  failing_ = false;
  health_.writes_succeeded();
}

/// After a failure the connection starts afresh: what it holds in memory is not to be trusted.
void Writer::Engine::fail(const Error& error) {
  if (session_) session_->connection.rollback();
  session_.reset();
  failing_ = true;
  if (error.code == ErrorCode::StorageCorrupt) {
    health_.damaged(error.message);
  } else {
    health_.writes_failed(error.message);
  }
}

Session& Writer::Engine::session() {
  if (!session_) session_.emplace(options_, clock_, sqlite::Mode::Write);
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
