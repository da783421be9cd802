#include "db/sqlite/database_file.hpp"

#include <sqlite3.h>

#include "db/store/stores.hpp"

namespace fitgauge::store {
namespace {

constexpr int kForceFactor = 2;

/// Copies pages without readers; readers and writers continue.
void passive_checkpoint(const sqlite::Connection& connection) {
  sqlite3_wal_checkpoint_v2(connection.handle(), nullptr, SQLITE_CHECKPOINT_PASSIVE, nullptr,
                            nullptr);
}

/// After a piece, rests for this number of times its duration: six percent of a processor.
constexpr int kRest = 15;

}  // namespace

Checkpointer::Checkpointer(const OpenOptions& options)
    : options_(options), thread_("the checkpointer", [this](const auto& stop) { run(stop); }) {}

void Checkpointer::install(sqlite::Connection& writer) {
  const auto count = [](void* pages, sqlite3*, const char*, int in_log) {
    *static_cast<int*>(pages) = in_log;
    return SQLITE_OK;
  };
  sqlite3_wal_hook(writer.handle(), count, &pages_);
}

void Checkpointer::after_commit(sqlite::Connection& writer) {
  std::unique_lock lock(mutex_);
  // A second checkpoint at the same time would copy nothing.
  if (pages_ >= kForceFactor * options_.checkpoint_pages) {
    changed_.wait(lock, [this] { return state_ != State::Running; });
  }
  const bool forced = pages_ >= kForceFactor * options_.checkpoint_pages;
  const bool finished = state_ == State::Finished;
  if (finished) state_ = State::Idle;
  if (pages_ < options_.checkpoint_pages) return;
  if (finished || forced) {
    lock.unlock();
    passive_checkpoint(writer);
  } else if (state_ == State::Idle) {
    state_ = State::Running;
    changed_.notify_all();
  }
}

void Checkpointer::run(const std::stop_token& stop) {
  std::unique_lock lock(mutex_);
  while (changed_.wait(lock, stop, [this] { return state_ == State::Running; }) &&
         !stop.stop_requested()) {
    lock.unlock();
    try {
      checkpoint();
    } catch (const std::exception&) {  // the file cannot be opened: commits will report it
    }
    lock.lock();
    state_ = State::Finished;
    changed_.notify_all();
  }
}

void Checkpointer::checkpoint() {
  const sqlite::Connection connection(options_.directory / kDatabaseFile, sqlite::Mode::Write,
                                      options_.synchronous);
  passive_checkpoint(connection);
}

Scrub::Scrub(const OpenOptions& options, const Clock& clock, HealthMonitor& health,
             bool check_file_first)
    : options_(options), clock_(clock), health_(health) {
  if (check_file_first) {
    health.note(Finding::Check,
                fmt::format("{} is being checked", (options.directory / kDatabaseFile).string()));
  }
  thread_ = Thread("the scrub", [this, check_file_first](const std::stop_token& stop) {
    run(stop, check_file_first);
  });
}

void Scrub::run(const std::stop_token& stop, bool check_file_first) {
  if (check_file_first) check_file(stop);
  do {
    pass(stop);
  } while (wait_unless_stopped(stop, options_.scrub_interval));
}

void Scrub::check_file(const std::stop_token& stop) {
  const Result<void> checked = store::check_file(options_.directory / kDatabaseFile, stop);
  if (stop.stop_requested()) return;
  checked ? health_.note(Finding::Check) : health_.note(Finding::Damage, checked.error().message);
}

void Scrub::pass(const std::stop_token& stop) {
  constexpr std::chrono::milliseconds kBetweenGlances{5};
  while (options_.is_open && !options_.is_open()) {
    if (!wait_unless_stopped(stop, kBetweenGlances)) return;
  }
  try {
    sqlite::Session session(options_, clock_, sqlite::Mode::Read);
    Verifier verifier(session, options_.check_measurement);
    using Time = std::chrono::steady_clock;
    auto begin = Time::now();
    const auto go_on = [&] {
      const bool goes_on = wait_unless_stopped(stop, kRest * (Time::now() - begin));
      begin = Time::now();
      return goes_on;
    };
    if (const std::optional<std::string> finding = verifier.first_altered_row(go_on)) {
      health_.note(Finding::Damage, fmt::format("{}. Restore a backup", *finding));
    }
  } catch (const StorageFailure& failure) {
    // The next pass handles other failures (no memory, no descriptors).
    if (failure.error().code == ErrorCode::StorageCorrupt)
      health_.note(Finding::Damage, failure.error().message);
  } catch (const std::exception& bug) {
    if (options_.job_threw) {
      options_.job_threw({ErrorCode::Internal, fmt::format("the scrub failed: {}", bug.what())});
    }
  }
}

}  // namespace fitgauge::store
