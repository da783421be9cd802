#pragma once

#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <thread>

#include "sqlite/connection.hpp"
#include "store/open_options.hpp"

namespace fitgauge::store {

/// Copies the write-ahead log into the database on a thread of its own, so that no commit waits
/// until thousands of pages are copied. The log starts anew only when nothing in it is left to copy
/// between two commits: what was committed meanwhile the writer copies itself.
/// A copy that fails is tried again; that the log then grows is for the commits to report.
class Checkpointer {
 public:
  explicit Checkpointer(const OpenOptions& options);
  Checkpointer(const Checkpointer&) = delete;
  Checkpointer& operator=(const Checkpointer&) = delete;
  ~Checkpointer();

  // By the writer.

  /// From now on the log is copied when this says so, no more by SQLite at a commit.
  void take_over(sqlite::Connection& writer);
  /// Between two transactions.
  void go_on(sqlite::Connection& writer);

 private:
  enum class State : std::uint8_t { Idle, Copying, Copied };

  void run();
  void copy();

  const OpenOptions options_;
  int pages_ = 0;  ///< in the log; the writer's
  std::mutex mutex_;
  std::condition_variable changed_;
  State state_ = State::Idle;
  bool stopping_ = false;
  std::thread thread_;
};

}  // namespace fitgauge::store
