#pragma once

#include <filesystem>

#include "base/clock.hpp"
#include "base/thread.hpp"
#include "db/sql/sealed_table.hpp"
#include "db/sql/session.hpp"
#include "db/sqlite/connection.hpp"
#include "db/store/database.hpp"

namespace fitgauge::store {

/// Runs SQLite's quick_check over a file through a read-only connection, which leaves it untouched.
/// Ends without a finding when it is stopped.
/// @errors StorageCorrupt with the first damage found.
Result<void> check_file(const std::filesystem::path& file, std::stop_token stop = {});

/// Checks a whole database and notes its faults. Reads long lists in pages, so that a running
/// daemon can checkpoint.
class Verifier {
 public:
  Verifier(sqlite::Session& session, const MeasurementCheck& check)
      : session_(session), check_(check) {}

  VerifyReport run();

  /// Checks only rows, in pieces of some milliseconds, until an altered row, or until `go_on`,
  /// called after each piece without an open transaction, returns false.
  std::optional<std::string> first_altered_row(const std::function<bool()>& go_on);

 private:
  void check_file();
  void check_schema();
  /// The revisions that are new since the last call.
  void check_tables();
  /// Objects with their own digest, and the current revisions of the files.
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

namespace fitgauge::store::sqlite {

/// `FtGg` in the header of the file: whose database it is.
inline constexpr std::int32_t kApplicationId = 0x46744767;

using sql::Migration;

/// The number of the last step applied, which is SQLite's user_version.
int schema_version(Connection& connection);

/// Compares the migrations of a database with `known`.
/// @errors DatabaseNewer if it has more; DatabaseForeign if the text of a migration differs.
Result<void> check_history(Connection& connection, std::span<const Migration> known);

/// Applies the missing steps in one transaction.
void migrate(Connection& connection, std::span<const Migration> known, std::int64_t now_ns);

}  // namespace fitgauge::store::sqlite

namespace fitgauge::store {

/// Makes `fitgauge.db` of the options' directory ready for use with the schema `known`: creates it
/// or checks it, and upgrades it after a backup (`fitgauge.db.schema-N.backup`).
/// With Access::Attach it must be there and have just this schema.
/// @errors as open_database(), except DatabaseInUse.
Result<void> prepare_file(const OpenOptions& options, std::span<const sqlite::Migration> known,
                          std::int64_t now_ns);

/// Copies the live database into a new file, durable when it returns.
/// @errors StorageUnavailable, also when `target` exists.
Result<void> copy_database(const std::filesystem::path& source,
                           const std::filesystem::path& target);

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

  // By the writer.

  /// Disables the automatic checkpoints of SQLite, which run at a commit.
  void install(sqlite::Connection& writer);
  /// Runs between two transactions; waits for the thread if the log is kForceFactor times too long.
  void after_commit(sqlite::Connection& writer);

  int log_pages() const { return pages_; }  ///< at the last commit; the writer's

 private:
  enum class State : std::uint8_t { Idle, Running, Finished };

  void run(const std::stop_token& stop);
  void checkpoint();

  const OpenOptions options_;
  int pages_ = 0;  ///< in the log; the writer's
  std::mutex mutex_;
  std::condition_variable_any changed_;
  State state_ = State::Idle;
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

  const OpenOptions& options_;
  const Clock& clock_;
  HealthMonitor& health_;
  Thread thread_;
};

}  // namespace fitgauge::store
