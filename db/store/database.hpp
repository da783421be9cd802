#pragma once

#include <filesystem>

#include "base/clock.hpp"
#include "db/store/jobs.hpp"
#include "db/store/measurement_row.hpp"

namespace fitgauge::store {

/// The current abilities of the database.
enum class HealthState {
  Ok,             ///< checked, reads and writes work
  Checking,       ///< reads and writes work; a large file is still being checked
  WritesFailing,  ///< the last commit failed (disk full, read-only, I/O error); retried every
                  ///< second
  Damaged,        ///< the check or a read found damage; writes are refused for good
};

/// `ok`, `checking`, `writes_failing`, `damaged`.
constexpr std::string_view word(HealthState state) {
  return word_of(state, {"ok", "checking", "writes_failing", "damaged"});
}

struct Health {
  HealthState state = HealthState::Ok;
  std::string reason{};  ///< the fault in one sentence; empty if Ok
};

/// Judges one measurement; returns its fault (`was altered …`), or nothing.
using MeasurementCheck = std::function<std::optional<std::string>(const MeasurementRow& row)>;

struct VerifyReport {
  std::int64_t measurements = 0;  ///< rows whose hash and check were computed
  /// One sentence each, the first altered measurement by its id; empty when all is well. After 100
  /// findings the rest is left out.
  std::vector<std::string> findings{};
};

/// Whether a commit waits until the disk has it. Only Full survives a power cut.
enum class Synchronous { Off, Normal, Full };

/// The program that opens the data directory.
enum class Access {
  Serve,   ///< the one daemon: creates and upgrades the database, holds the directory's lock
  Attach,  ///< a command beside a running daemon (backup, verify, keys): nothing is created or
           ///< upgraded
};

struct Stores;

struct OpenOptions {
  std::filesystem::path directory;
  std::string address{};  ///< of a server, `postgresql://…`; empty: the file in the directory
  Access access = Access::Serve;
  Synchronous synchronous =
      Synchronous::Full;  ///< less than Full only as a test's negative control

  bool commit_each = false;  ///< one commit for each job: the benchmark's peer
  std::size_t queue_limit =
      4096;              ///< write jobs and read jobs waiting, each; one more is StorageBusy
  unsigned readers = 2;  ///< reader threads, each with its own connection

  int checkpoint_pages = 4000;  ///< of the log: from here on it is checkpointed

  std::uintmax_t check_at_open_limit = std::uintmax_t{256} << 20;  ///< bytes; larger: in background
  std::chrono::milliseconds scrub_interval = std::chrono::hours(24);  ///< between two passes
  std::chrono::hours idempotency_retention{30 * 24};
  std::chrono::hours run_retention{90 * 24};  ///< finished runs with their files and traces
  std::int64_t event_retention = 100'000;     ///< events stored for replay

  /// The error of a stored measurement, for the scrub. Called on its thread; lives as long as the
  /// database.
  MeasurementCheck check_measurement{};
  /// Whether the service is open, for the scrub: it begins no earlier, since a start writes, and
  /// damage that is found refuses every write.
  std::function<bool()> is_open{};

  /// Called on the writer thread after each commit; calls its argument, which delivers the outcomes
  /// to the jobs. If it is not set, the writer delivers them.
  std::function<void(const std::function<void()>&)> around_outcomes{};

  /// Called once for each change of health, on the thread that noticed it. It must not block, throw
  /// or request the health.
  std::function<void(const Health&)> health_changed{};
  /// Called for each job that threw: a bug, answered with Internal. It must not block or throw.
  std::function<void(const Error&)> job_threw{};

  /// Runs and idempotency keys expire by it; without it by the clock, which then never jumps.
  std::function<SteadyTime()> steady_time{};
  /// Called on the writer thread with a sentence on runs and idempotency keys that were deleted.
  std::function<void(const std::string&)> purged{};

  /// Another daemon has added data that the application keeps in memory: table revisions, origins,
  /// log keys. Called inside a transaction, before a job sees rows that need them.
  /// @returns whether the application has loaded them.
  std::function<bool(const Stores&)> names_changed{};

  /// Called on the writer thread after each commit, when its jobs have their outcomes, and on
  /// another thread for commits of others; must not block. Must outlive the database.
  std::function<void()> committed{};
};

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
