#pragma once

#include <filesystem>

#include "base/clock.hpp"
#include "db/store/jobs.hpp"
#include "db/store/open_options.hpp"

namespace fitgauge::store {

/// Figures of a database server, for metrics; its members are columns in their order (sql::row_of).
struct ServerFigures {
  std::int64_t database_bytes = 0;
  std::int64_t standbys = 0;  ///< servers that follow this one at the moment
  /// Bytes that the slowest standby does not have on its disk yet; absent without a standby, or if
  /// the user may not see it.
  std::optional<std::int64_t> standby_behind_bytes{};
};

/// A database of some engine, with its writer thread and its reader threads. Thread-safe. The
/// destructor runs queued jobs, commits and closes. An engine's `open_database` opens it.
class Database {
 public:
  Database& operator=(Database&&) = delete;  // neither copied nor moved
  virtual ~Database() = default;

  virtual Writer& writer() = 0;
  virtual ReadPool& readers() = 0;

  /// Runs queued jobs and ends the threads; later jobs are refused with ShuttingDown. After it
  /// returns no completion runs, so data of the jobs may be destroyed.
  virtual void drain() = 0;

  virtual Health health() const = 0;

  /// State of the server, a few seconds old; absent if there is no server or it is unreachable.
  /// Never blocks.
  virtual std::optional<ServerFigures> server_figures() const { return std::nullopt; }

  /// Writes a consistent copy of the live database to a new file, on disk when it returns.
  /// Blocks; for commands and background threads.
  /// @errors StorageUnavailable, also when `file` exists: nothing is overwritten.
  virtual Result<void> backup(const std::filesystem::path& file) const = 0;

  /// Checks the file (every page, index and reference), the schema against this build's, each table
  /// revision against its digest, and with `check`
  /// what only the caller can judge of each measurement. Blocks.
  virtual Result<VerifyReport> verify(const MeasurementCheck& check) const = 0;
  Result<VerifyReport> verify() const { return verify({}); }
};

}  // namespace fitgauge::store

namespace fitgauge::store::postgres {

/// Opens the schema `fitgauge` of the database at OpenOptions::address, which several daemons
/// share; creates it if it does not exist. `clock` must outlive the database.
/// @errors StorageUnavailable while the server cannot be reached, or has no such schema and access
///   is Attach; DatabaseForeign, DatabaseNewer.
Result<std::unique_ptr<Database>> open_database(const OpenOptions& options, const Clock& clock);

/// Checks if a daemon could start on it: it accepts connections and writes, and has this build's
/// schema or none. Changes nothing. @errors StorageUnavailable, DatabaseNewer, DatabaseForeign.
Result<void> check_server(const std::string& address);

}  // namespace fitgauge::store::postgres

namespace fitgauge::store::sqlite {

/// Opens `fitgauge.db` of a data directory, creating it where the directory has none, with a thread
/// that checks it. The file is created aside and renamed, and an upgrade is one transaction after a
/// backup, so that a kill leaves the old state or the new one. `clock` outlives the database, whose
/// end checkpoints.
/// @errors DatabaseInUse when another instance serves the directory; DatabaseForeign when the file
///   is empty, not SQLite's, or not fitgauge's; DatabaseNewer; StorageCorrupt when the check fails
///   (the file is left untouched in all these); StorageUnavailable when the directory cannot be
///   written, or holds no database and access is Attach.
Result<std::unique_ptr<Database>> open_database(const OpenOptions& options, const Clock& clock);

}  // namespace fitgauge::store::sqlite
