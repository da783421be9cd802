#pragma once

#include <atomic>
#include <filesystem>
#include <thread>

#include "base/result.hpp"
#include "sqlite/health_monitor.hpp"

namespace fitgauge::store {

/// Runs SQLite's quick_check over a file through a read-only connection, which leaves it untouched.
/// @errors StorageCorrupt with the first damage found.
Result<void> check_file(const std::filesystem::path& file);

/// The same on a thread of its own, reporting to the monitor. Destroying it stops the check.
class BackgroundCheck {
 public:
  BackgroundCheck(const std::filesystem::path& file, HealthMonitor& health);
  BackgroundCheck(const BackgroundCheck&) = delete;
  BackgroundCheck& operator=(const BackgroundCheck&) = delete;
  ~BackgroundCheck();

 private:
  void run(const std::filesystem::path& file, HealthMonitor& health);

  std::atomic<bool> stop_ = false;
  std::thread thread_;
};

}  // namespace fitgauge::store
