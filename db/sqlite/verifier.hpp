#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <set>
#include <stop_token>
#include <string>

#include "base/result.hpp"
#include "db/sql/sealed_table.hpp"
#include "db/sqlite/connection.hpp"
#include "db/store/open_options.hpp"

namespace fitgauge::store {

/// Runs SQLite's quick_check over a file through a read-only connection, which leaves it untouched.
/// Ends without a finding when it is stopped.
/// @errors StorageCorrupt with the first damage found.
Result<void> check_file(const std::filesystem::path& file, std::stop_token stop = {});

/// Goes through a whole database and notes what is wrong. Reads long lists in pages, so that it
/// does not hold up a running daemon's checkpoints.
class Verifier {
 public:
  Verifier(sqlite::Session& session, const MeasurementCheck& check)
      : session_(session), check_(check) {}

  VerifyReport run();

  /// Only rows, in pieces of some milliseconds, until one is not what was stored or `go_on`, called
  /// after each piece, says false. No transaction is open when it is called.
  std::optional<std::string> first_altered_row(const std::function<bool()>& go_on);

 private:
  void check_file();
  void check_schema();
  /// The revisions that are new since the last call.
  void check_tables();
  /// What has a digest of its own, and the files' revisions in force.
  void check_rows();
  void check_rows(const SealedTable& table);
  void check_files();
  void check_measurements(std::size_t page, const std::function<bool()>& go_on);
  void check_index();
  void check_measurement(const MeasurementRow& row);
  void note(std::string finding);

  sqlite::Session& session_;
  const MeasurementCheck& check_;
  VerifyReport report_;
  std::set<std::int64_t> revisions_;
  std::int64_t last_id_ = 0;
};

}  // namespace fitgauge::store
