#pragma once

#include <chrono>
#include <condition_variable>
#include <filesystem>
#include <mutex>

#include "base/clock.hpp"
#include "base/thread.hpp"
#include "db/sql/health_monitor.hpp"
#include "db/store/open_options.hpp"

namespace fitgauge::store {

/// Reads the whole database again and again, once each scrub_interval, so that damage is found
/// before somebody needs the row: each measurement against the chain, each table revision and each
/// sealed row against its digest. On a thread of its own, which rests fifteen times as long as each
/// piece took. Tells the monitor the first finding. Destroying it stops it.
class Scrub {
 public:
  /// @param check_file_first whether SQLite's quick_check comes before: the file was too large to
  /// have that checked at the start.
  Scrub(const OpenOptions& options, const Clock& clock, HealthMonitor& health,
        bool check_file_first);

 private:
  void run(const std::stop_token& stop, bool check_file_first);
  void check_file(const std::stop_token& stop);
  void pass(const std::stop_token& stop);
  /// @returns false when it was stopped meanwhile.
  bool rest(const std::stop_token& stop, std::chrono::nanoseconds time);

  const OpenOptions& options_;
  const Clock& clock_;
  HealthMonitor& health_;
  std::mutex mutex_;
  std::condition_variable_any stopped_;
  Thread thread_;
};

}  // namespace fitgauge::store
