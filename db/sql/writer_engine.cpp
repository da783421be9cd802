#include "db/sql/session.hpp"

#include <sstream>

#include "db/store/stores.hpp"

namespace fitgauge::store {
namespace {

using std::chrono::milliseconds;
using std::chrono::nanoseconds;

/// Maximum number of rows that a step deletes: a request meanwhile waits a few milliseconds.
constexpr std::int64_t kStep = 200;
/// Under load, jobs run for this number of times the duration of a step: six percent for
/// maintenance.
constexpr int kShare = 15;
/// After commits, and without any.
constexpr milliseconds kLookInterval{200};
constexpr milliseconds kQuietInterval{60'000};

constexpr milliseconds kProbeInterval{1'000};

/// Running time after which a clock is right.
constexpr std::chrono::hours kSteadyDay{24};
/// A clock is set back less when the machine starts.
constexpr std::chrono::hours kLeastSetBack{1};
constexpr std::chrono::minutes kBetweenKeepings{10};
/// After this duration of a transaction, waiting jobs are left for the next one.
constexpr milliseconds kLongestBatch{20};

Error internal_error(const std::exception& bug) {
  return {ErrorCode::Internal, std::string("a storage job failed: ") + bug.what()};
}

}  // namespace

bool run_maintenance_step(sql::Session& session, const OpenOptions& options,
                          const SteadyTime& clock, Retention& retention) {
  Stores& stores = session.stores();
  std::int64_t keys = 0;
  std::int64_t runs = 0;
  session.begin_writing();
  const auto now = retention.time(clock, stores);
  retention.keep(stores);
  if (now) {
    keys = stores.idempotency.purge(*now, kStep);
    runs = stores.runs.purge(now->nanoseconds - nanoseconds(options.run_retention).count(), kStep);
  }
  const std::int64_t events = stores.events.trim(options.event_retention, kStep);
  const bool indexed = stores.measurements.index_step();
  session.commit();
  retention.deleted(keys, runs);
  return keys + runs + events > 0 || indexed;
}

void MaintenancePace::stepped(Time begin, Time end, bool more) {
  const auto cost = end - begin;
  has_more_ = more;
  when_quiet_ = more ? end + cost : end + kQuietInterval;
  when_busy_ = more ? end + kShare * cost : end + kQuietInterval;
}

void MaintenancePace::committed(Time now) {
  if (has_more_) return;
  when_quiet_ = std::min(when_quiet_, now + kLookInterval);
  when_busy_ = std::min(when_busy_, now + kLookInterval);
}

milliseconds MaintenancePace::patience(Time now) const {
  return std::max(std::chrono::ceil<milliseconds>(when_quiet_ - now), milliseconds(0));
}

WriterThread::WriterThread(const OpenOptions& options, const Clock& clock, HealthMonitor& health,
                           sql::OpenSession open, std::function<void()> check)
    : Writer(options.queue_limit),
      options_(options),
      clock_(clock),
      health_(health),
      open_(std::move(open)),
      check_(std::move(check)) {
  session();
  thread_ = Thread("the writer", [this](const auto&) { run(); });
}

WriterThread::~WriterThread() { stop(); }

void WriterThread::stop() {
  queue_.close();
  thread_.stop();
}

void WriterThread::run() {
  begin_retention();
  Jobs jobs;
  while (true) {
    if (jobs.empty()) jobs = queue_.take_all(std::min(patience(), kProbeInterval));
    if (jobs.empty() && queue_.is_finished()) break;
    const bool had_jobs = !jobs.empty();
    if (had_jobs) commit(jobs);
    if (session_) session_->tidy_up(counters_);
    if (!had_jobs) failing_ ? probe() : look();
    const auto now = MaintenancePace::Clock::now();
    const bool is_due = had_jobs ? pace_.is_due(now) : pace_.patience(now) == milliseconds(0);
    if (!failing_ && is_due && options_.access == Access::Serve) maintain();
  }
  session_.reset();
}

/// Runs one transaction for the first jobs, and delivers their outcomes.
void WriterThread::commit(Jobs& jobs) {
  Jobs rest;
  if (options_.commit_each) {
    std::move(std::next(jobs.begin()), jobs.end(), std::back_inserter(rest));
    jobs.resize(1);
  }
  std::vector<std::optional<Error>> errors;
  const std::optional<Error> error = try_commit(jobs, errors);
  if (error) errors.assign(jobs.size(), error);
  std::move(jobs.begin() + static_cast<std::ptrdiff_t>(errors.size()), jobs.end(),
            std::back_inserter(rest));
  const auto tell_outcomes = [&] {
    for (std::size_t i = 0; i < errors.size(); ++i) tell(*jobs[i], std::move(errors[i]));
  };
  options_.around_outcomes ? options_.around_outcomes(tell_outcomes) : tell_outcomes();
  jobs = std::move(rest);
  if (!error && options_.committed) guarded("a listener of commits", options_.committed);
}

/// Runs jobs until the transaction is long enough: at least one, so that no job waits for more than
/// one long job before it.
/// @param errors receives the errors of single jobs, an entry for each that was run.
/// @returns the error of the whole batch, run or not.
std::optional<Error> WriterThread::try_commit(Jobs& jobs,
                                              std::vector<std::optional<Error>>& errors) {
  const Health health = health_.health();
  if (health.state == HealthState::Damaged) return Error{ErrorCode::StorageCorrupt, health.reason};
  std::optional<Error> error;
  try {
    const auto begin = MaintenancePace::Clock::now();
    if (check_) check_();
    session().begin_writing();
    // If several daemons write, there was a wait: jobs that arrived in between are included.
    if (!options_.commit_each) {
      Jobs more = queue_.take_all(milliseconds(0));
      const bool have_come = !more.empty();
      std::move(more.begin(), more.end(), std::back_inserter(jobs));
      if (have_come && check_) check_();  // a file may have been taken away before they came
    }
    if (jobs.size() == 1) {
      errors.push_back(run_alone(*jobs.front()));
    } else {
      run_in_savepoints(jobs, errors);
      commit_transaction();
    }
    succeed();
    const auto now = MaintenancePace::Clock::now();
    pace_.committed(now);
    counters_.commit_seconds.observe(std::chrono::duration<double>(now - begin).count());
    counters_.batch_jobs.observe(static_cast<double>(errors.size()));
  } catch (const StorageFailure& failure) {
    error = failure.error();
  } catch (const std::exception& bug) {
    error = internal_error(bug);
  }
  if (error) fail(*error);
  return error;
}

void WriterThread::commit_transaction() {
  const std::int64_t own_rows = session().stores().measurements.log_size();
  session().commit();
  counters_.own_rows = own_rows;  // before the outcomes are delivered
}

/// The transaction has only this job: it needs no savepoint, and its postponed statements may fail
/// as late as in the commit.
/// @returns as run_in_savepoint().
std::optional<Error> WriterThread::run_alone(WriteJob& job) {
  std::optional<Error> bug;
  try {
    if (job.run(session().stores())) {
      commit_transaction();
      return bug;
    }
  } catch (const StorageFailure&) {
    throw;
  } catch (const std::exception& thrown) {
    bug = bug_of(thrown);
  }
  session().rollback();
  return bug;
}

void WriterThread::run_in_savepoints(Jobs& jobs, std::vector<std::optional<Error>>& errors) {
  const auto end = MaintenancePace::Clock::now() + kLongestBatch;
  do {
    errors.push_back(run_in_savepoint(*jobs[errors.size()]));
  } while (errors.size() < jobs.size() && MaintenancePace::Clock::now() < end);
}

/// @returns the job's bug, if it threw. Broken storage concerns the whole batch and is thrown.
std::optional<Error> WriterThread::run_in_savepoint(WriteJob& job) {
  sql::Session& session = *session_;
  session.savepoint();
  std::optional<Error> bug;
  bool keep = false;
  try {
    const bool done = job.run(session.stores());
    if (done) session.settle();
    keep = done;
  } catch (const StorageFailure&) {
    throw;
  } catch (const std::exception& thrown) {
    bug = bug_of(thrown);
  }
  if (!keep) session.undo();
  session.release();
  return bug;
}

Error WriterThread::bug_of(const std::exception& thrown) {
  const Error bug = internal_error(thrown);
  if (options_.job_threw) options_.job_threw(bug);
  return bug;
}

milliseconds WriterThread::patience() const {
  if (failing_ || options_.access != Access::Serve) return kProbeInterval;
  return pace_.patience(MaintenancePace::Clock::now());
}

SteadyTime WriterThread::steady_time() const {
  return options_.steady_time ? options_.steady_time() : SteadyTime{.time = clock_.now()};
}

/// Before the first job stores a record with the time of this start.
void WriterThread::begin_retention() {
  try {
    session().begin_reading();
    retention_.time(steady_time(), session().stores());
    session().commit();
  } catch (const StorageFailure& failure) {
    fail(failure.error());
  }
}

/// Checks, while there is nothing to write, that the database is still there.
void WriterThread::look() {
  if (!check_ || health_.health().state == HealthState::Damaged) return;
  try {
    check_();
  } catch (const StorageFailure& failure) {
    fail(failure.error());
  }
}

void WriterThread::maintain() {
  const auto begin = MaintenancePace::Clock::now();
  bool more = false;
  try {
    if (health_.health().state != HealthState::Damaged) {
      more = run_maintenance_step(session(), options_, steady_time(), retention_);
    }
  } catch (const StorageFailure& failure) {
    fail(failure.error());
  } catch (const std::exception& bug) {
    fail(internal_error(bug));
  }
  const auto end = MaintenancePace::Clock::now();
  pace_.stepped(begin, end, more);
  const auto deleted = retention_.report(end.time_since_epoch(), more);
  if (deleted && options_.purged) options_.purged(*deleted);
}

/// Finds out whether commits work again.
void WriterThread::probe() {
  if (health_.health().state == HealthState::Damaged) return;
  try {
    if (check_) check_();
    session().probe();
    succeed();
  } catch (const StorageFailure& failure) {
    fail(failure.error());
  } catch (const std::exception& bug) {
    fail(internal_error(bug));
  }
}

void WriterThread::succeed() {
  failing_ = false;
  health_.note(Finding::Writes);
}

/// After most failures the connection is opened again, because its memory is not reliable.
void WriterThread::fail(const Error& error) {
  ++counters_.failed_commits;
  const bool is_reliable = session_ && session_->is_reliable();
  if (session_) session_->rollback();
  if (!is_reliable) session_.reset();
  failing_ = true;
  const bool is_damaged = error.code == ErrorCode::StorageCorrupt;
  health_.note(is_damaged ? Finding::Damage : Finding::Writes, error.message);
}

sql::Session& WriterThread::session() {
  if (!session_) session_ = open_();
  return *session_;
}

bool Writer::begin(const IdempotentRequest& request) {
  const std::lock_guard lock(under_way_mutex_);
  return under_way_.emplace(request.caller, request.method, request.path, request.key).second;
}

void Writer::end(const IdempotentRequest& request) {
  const std::lock_guard lock(under_way_mutex_);
  under_way_.erase({request.caller, request.method, request.path, request.key});
}

Error Writer::in_progress() {
  return {ErrorCode::IdempotencyInProgress,
          "the first request with this Idempotency-Key is still running: try again soon"};
}

std::optional<Timestamp> Retention::time(const SteadyTime& clock, const Stores& stores) {
  if (!std::exchange(has_begun_, true)) {
    std::istringstream text(stores.log.mark(LogStore::Mark::Retention).value_or(""));
    State kept;
    if (text >> kept.time_ns >> kept.next_ns >> kept.held_ns >> kept.seen_ns) state_ = kept_ = kept;
  }
  const bool has_held = clock.held >= kSteadyDay;
  const std::int64_t now = clock.time.nanoseconds;
  const bool is_set_back = now < state_.seen_ns - nanoseconds(kLeastSetBack).count();
  const bool begins = state_.next_ns == 0 || clock.held < held_ || is_set_back;
  if (!has_held && !begins) state_.held_ns += (clock.held - held_).count();
  const bool is_day_over = has_held || state_.held_ns >= nanoseconds(kSteadyDay).count();
  if (begins || is_day_over) {
    const auto newest = stores.measurements.newest_received_at();
    const std::int64_t next = newest ? std::min(newest->nanoseconds, now) : now;
    if (is_day_over) state_.time_ns = has_held ? next : state_.next_ns;
    state_.next_ns = next;
    state_.held_ns = 0;
  }
  held_ = clock.held;
  state_.seen_ns = now;
  return state_.time_ns == 0 ? std::nullopt : std::optional(Timestamp{state_.time_ns});
}

void Retention::keep(Stores& stores) {
  const auto has_moved = [](std::int64_t from, std::int64_t to) {
    return to < from || to - from >= nanoseconds(kBetweenKeepings).count();
  };
  if (!has_moved(kept_.seen_ns, state_.seen_ns) && !has_moved(kept_.held_ns, state_.held_ns)) {
    return;
  }
  stores.log.set_mark(
      LogStore::Mark::Retention,
      fmt::format("{} {} {} {}", state_.time_ns, state_.next_ns, state_.held_ns, state_.seen_ns));
  kept_ = state_;
}

void Retention::deleted(std::int64_t keys, std::int64_t runs) {
  keys_ += keys;
  runs_ += runs;
}

std::optional<std::string> Retention::report(std::chrono::nanoseconds now, bool more) {
  const bool is_soon = reported_ && now - *reported_ < std::chrono::hours(1);
  if (keys_ + runs_ == 0 || more || is_soon) return std::nullopt;
  std::string sentence = fmt::format(
      "deleted {} idempotency keys and {} finished runs with their files: expired at {}", keys_,
      runs_, format_rfc3339({state_.time_ns}));
  keys_ = runs_ = 0;
  reported_ = now;
  return sentence;
}

}  // namespace fitgauge::store
