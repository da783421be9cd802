#include "sqlite/file_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <string>

#include "sqlite/connection.hpp"
#include "store/storage_failure.hpp"

namespace fitgauge::store {
namespace {

/// Instructions of SQLite's machine between two looks at the stop flag.
constexpr int kInstructions = 10'000;

Result<void> check_file(const std::filesystem::path& file, std::atomic<bool>* stop) {
  std::string finding;
  try {
    sqlite::Connection connection(file, sqlite::Mode::Read);
    if (stop != nullptr) {
      sqlite3_progress_handler(
          connection.handle(), kInstructions,
          [](void* flag) { return static_cast<std::atomic<bool>*>(flag)->load() ? 1 : 0; }, stop);
    }
    finding = connection.query_text("PRAGMA quick_check(1)");
  } catch (const StorageFailure& failure) {
    if (failure.error().code != ErrorCode::StorageCorrupt) return failure.error();
    finding = failure.error().message;
  }
  if (finding == "ok") return {};
  std::replace(finding.begin(), finding.end(), '\n', ' ');  // SQLite's heading is a line of its own
  return Error{
      ErrorCode::StorageCorrupt,
      fmt::format("{} is damaged: {}. Restore a backup in its place", file.string(), finding)};
}

}  // namespace

Result<void> check_file(const std::filesystem::path& file) { return check_file(file, nullptr); }

BackgroundCheck::BackgroundCheck(const std::filesystem::path& file, HealthMonitor& health) {
  health.checking(fmt::format("{} is being checked", file.string()));
  thread_ = std::thread(&BackgroundCheck::run, this, file, std::ref(health));
}

void BackgroundCheck::run(const std::filesystem::path& file, HealthMonitor& health) {
  const Result<void> checked = check_file(file, &stop_);
  if (stop_) return;
  if (checked) {
    health.check_passed();
  } else {
    health.damaged(checked.error().message);
  }
}

BackgroundCheck::~BackgroundCheck() {
  stop_ = true;
  thread_.join();
}

}  // namespace fitgauge::store
