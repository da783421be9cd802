#include "db/sqlite/file_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "db/sqlite/connection.hpp"
#include "db/store/storage_failure.hpp"

namespace fitgauge::store {
namespace {

/// Instructions of SQLite's machine between two looks at the stop flag.
constexpr int kInstructions = 10'000;

}  // namespace

Result<void> check_file(const std::filesystem::path& file, std::stop_token stop) {
  std::string finding;
  try {
    sqlite::Connection connection(file, sqlite::Mode::Read);
    const auto is_stopped = [](void* token) {
      return static_cast<const std::stop_token*>(token)->stop_requested() ? 1 : 0;
    };
    if (stop.stop_possible()) {
      sqlite3_progress_handler(connection.handle(), kInstructions, is_stopped, &stop);
    }
    finding = connection.query_text("PRAGMA quick_check(1)");
  } catch (const StorageFailure& failure) {
    if (stop.stop_requested()) return {};
    if (failure.error().code != ErrorCode::StorageCorrupt) return failure.error();
    finding = failure.error().message;
  }
  if (finding == "ok" || stop.stop_requested()) return {};
  std::replace(finding.begin(), finding.end(), '\n', ' ');  // SQLite's heading is a line of its own
  return Error{
      ErrorCode::StorageCorrupt,
      fmt::format("{} is damaged: {}. Restore a backup in its place", file.string(), finding)};
}

}  // namespace fitgauge::store
