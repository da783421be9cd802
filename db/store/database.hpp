#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "base/clock.hpp"
#include "store/health.hpp"
#include "store/open_options.hpp"
#include "store/read_pool.hpp"
#include "store/verify.hpp"
#include "store/writer.hpp"
#include "store/writer_counters.hpp"

namespace fitgauge::store {

/// The database `fitgauge.db` of a data directory, with its writer thread, its reader threads and,
/// for a large file, the thread that checks it. Thread-safe. Destroying it runs what is queued,
/// commits, checkpoints and closes.
class Database {
 public:
  /// Opens the database, creating it where the directory has none. The file is created aside and
  /// renamed, and an upgrade is one transaction after a backup, so that a kill leaves the old state
  /// or the new one. `clock` outlives the database.
  /// @errors DatabaseInUse when another instance serves the directory; DatabaseForeign when the
  /// file
  ///   is empty, not SQLite's, or not fitgauge's; DatabaseNewer; StorageCorrupt when the check
  ///   fails (the file is left untouched in all these); StorageUnavailable when the directory
  ///   cannot be written, or holds no database and access is Attach.
  static Result<std::unique_ptr<Database>> open(const OpenOptions& options, const Clock& clock);

  Database(const Database&) = delete;
  Database& operator=(const Database&) = delete;
  ~Database();

  Writer& writer();
  ReadPool& readers();

  /// Runs what is queued and ends the threads; what comes later is refused with ShuttingDown. After
  /// it no completion is under way: what jobs refer to may go.
  void drain();

  Health health() const;

  const WriterCounters& writer_counters() const;
  /// Jobs that wait for the writer.
  std::size_t writer_queue() const;

  /// Writes a consistent copy of the live database to a new file, on disk when it returns.
  /// Blocks; for commands and background threads.
  /// @errors StorageUnavailable, also when `file` exists: nothing is overwritten.
  Result<void> backup(const std::filesystem::path& file) const;

  /// Checks the file (every page, index and reference), the schema against this build's, each table
  /// revision against its digest, the chain of the hashes from before the log, and with `check`
  /// what only the caller can judge of each measurement. Blocks.
  Result<VerifyReport> verify(const MeasurementCheck& check = {}) const;

 private:
  struct Parts;
  explicit Database(std::unique_ptr<Parts> parts);

  std::unique_ptr<Parts> parts_;
};

}  // namespace fitgauge::store
