#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "db/store/health.hpp"
#include "db/store/read_pool.hpp"
#include "db/store/verify.hpp"
#include "db/store/writer.hpp"
#include "db/store/writer_counters.hpp"

namespace fitgauge::store {

/// A database of some engine, with its writer thread and its reader threads. Thread-safe.
/// Destroying it runs what is queued, commits and closes. An engine's `open_database` opens it.
class Database {
 public:
  Database() = default;
  Database(const Database&) = delete;
  Database& operator=(const Database&) = delete;
  virtual ~Database() = default;

  virtual Writer& writer() = 0;
  virtual ReadPool& readers() = 0;

  /// Runs what is queued and ends the threads; what comes later is refused with ShuttingDown. When
  /// it returns no completion runs any more: what the jobs refer to may be destroyed.
  virtual void drain() = 0;

  virtual Health health() const = 0;

  virtual const WriterCounters& writer_counters() const = 0;
  /// Jobs that wait for the writer.
  virtual std::size_t writer_queue() const = 0;
  /// Jobs that wait for a reader.
  virtual std::size_t reader_queue() const = 0;
  /// What the server said a few seconds ago; nothing where there is none or it is away. Does not
  /// wait.
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
