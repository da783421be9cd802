#pragma once

#include "base/clock.hpp"
#include "base/thread.hpp"
#include "db/sql/session.hpp"
#include "db/sqlite/connection.hpp"
#include "db/store/open_options.hpp"

namespace fitgauge::store {

/// Checkpoints the write-ahead log on its own thread, so that commits do not wait until thousands
/// of pages are copied into the database. The log restarts only if all of it is copied between two
/// commits: the writer copies the commits during the thread's checkpoint. If a log grows faster
/// than the thread copies, the writer waits, so its length is bounded: kForceFactor times
/// checkpoint_pages and one transaction. A failed checkpoint is tried again; commits report a log
/// that grows.
class Checkpointer {
 public:
  explicit Checkpointer(const OpenOptions& options);
  Checkpointer& operator=(Checkpointer&&) = delete;  // neither copied nor moved
  ~Checkpointer();

  // By the writer.

  /// Disables the automatic checkpoints of SQLite, which run at a commit.
  void install(sqlite::Connection& writer);
  /// Runs between two transactions; waits for the thread if the log is kForceFactor times too long.
  void after_commit(sqlite::Connection& writer);

  int log_pages() const { return pages_; }  ///< at the last commit; the writer's

 private:
  enum class State : std::uint8_t { Idle, Running, Finished };

  void run();
  void checkpoint();

  const OpenOptions options_;
  int pages_ = 0;  ///< in the log; the writer's
  std::mutex mutex_;
  std::condition_variable changed_;
  State state_ = State::Idle;
  bool stopping_ = false;
  Thread thread_;
};

/// Reads the whole database once each scrub_interval, so that damage is found before somebody needs
/// the row: each measurement against the chain, each table revision and each sealed row against its
/// digest. Runs on its own thread, which rests fifteen times as long as each piece took. Reports
/// the first finding to the monitor. The destructor stops it.
class Scrub {
 public:
  /// @param check_file_first runs SQLite's quick_check first, if the file was too large for it at
  ///   the start.
  Scrub(const OpenOptions& options, const Clock& clock, HealthMonitor& health,
        bool check_file_first);

 private:
  void run(const std::stop_token& stop, bool check_file_first);
  void check_file(const std::stop_token& stop);
  void pass(const std::stop_token& stop);
  /// @returns false if it was stopped.
  bool rest(const std::stop_token& stop, std::chrono::nanoseconds time);

  const OpenOptions& options_;
  const Clock& clock_;
  HealthMonitor& health_;
  std::mutex mutex_;
  std::condition_variable_any stopped_;
  Thread thread_;
};

}  // namespace fitgauge::store
