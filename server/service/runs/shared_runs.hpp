#pragma once

#include <condition_variable>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <stop_token>

#include "base/thread.hpp"
#include "service/runs/active_run.hpp"
#include "service/runs/stored_run.hpp"

namespace fitgauge::store {
class Database;
}

namespace fitgauge::app {

/// What daemons that share a database tell each other of their runs, through it: which are to be
/// cancelled, and how those stand that somebody follows at another daemon than the one that runs
/// them. Looks four times a second, and only while there is such a run. Thread-safe.
class SharedRuns {
 public:
  /// What this daemon runs.
  struct Own {
    std::function<bool()> has_any;
    std::function<void(std::int64_t id)> cancel;  ///< where it is this daemon's
  };

  SharedRuns(store::Database& database, Own own);
  SharedRuns(const SharedRuns&) = delete;
  SharedRuns& operator=(const SharedRuns&) = delete;
  ~SharedRuns();

  /// Ends what is followed with ShuttingDown, also what comes later. Blocks.
  void stop();

  /// A run of another daemon for those who follow it: its state, and at once after its end all
  /// that it has printed. It ends with an Error where the database cannot be read meanwhile.
  std::shared_ptr<ActiveRun> follow(const StoredRun& run);

 private:
  using Followed = std::map<std::int64_t, std::weak_ptr<ActiveRun>>;

  void run(const std::stop_token& stop);
  void look(const Followed& followed, bool runs_any);
  Followed followed();
  void end(const Followed& followed, const Error& error);

  store::Database& database_;
  const Own own_;
  std::mutex mutex_;
  std::condition_variable_any ended_;
  Followed followed_;
  bool stopped_ = false;
  Thread thread_;  // ends before what it uses
};

}  // namespace fitgauge::app
