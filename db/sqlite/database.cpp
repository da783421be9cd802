#include "store/database.hpp"

#include <system_error>
#include <utility>

#include "sqlite/data_directory.hpp"
#include "sqlite/database_file.hpp"
#include "sqlite/read_pool_engine.hpp"
#include "sqlite/scrub.hpp"
#include "sqlite/verifier.hpp"
#include "sqlite/writer_engine.hpp"
#include "store/storage_failure.hpp"

namespace fitgauge::store {

/// Destroyed from the last member to the first: the writer closes after the readers, and so
/// checkpoints; the lock goes last.
struct Database::Parts {
  Parts(std::optional<DirectoryLock> held, const OpenOptions& chosen, const Clock& time)
      : lock(std::move(held)),
        options(chosen),
        clock(time),
        file(chosen.directory / kDatabaseFile),
        monitor(chosen.health_changed),
        writer_engine(chosen, time, monitor),
        reader_engine(chosen, time, monitor),
        writer(writer_engine),
        readers(reader_engine) {
    const bool too_large_for_the_start =
        std::filesystem::file_size(file) > options.check_at_open_limit;
    if (options.access == Access::Serve) {
      scrub.emplace(options, clock, monitor, too_large_for_the_start);
    }
  }

  std::optional<DirectoryLock> lock;
  OpenOptions options;
  const Clock& clock;
  std::filesystem::path file;
  HealthMonitor monitor;
  Writer::Engine writer_engine;
  ReadPool::Engine reader_engine;
  Writer writer;
  ReadPool readers;
  std::optional<Scrub> scrub;
};

Database::Database(std::unique_ptr<Parts> parts) : parts_(std::move(parts)) {}
Database::~Database() = default;

Result<std::unique_ptr<Database>> Database::open(const OpenOptions& options, const Clock& clock) {
  std::optional<DirectoryLock> lock;
  if (options.access == Access::Serve) {
    Result<DirectoryLock> held = DirectoryLock::acquire(options.directory);
    if (!held) return held.error();
    lock.emplace(*std::move(held));
  }
  const Result<void> prepared =
      prepare_file(options, sqlite::migrations(), clock.now().nanoseconds);
  if (!prepared) return prepared.error();
  try {
    return std::unique_ptr<Database>(
        new Database(std::make_unique<Parts>(std::move(lock), options, clock)));
  } catch (const StorageFailure& failure) {
    return failure.error();
  }
}

Writer& Database::writer() { return parts_->writer; }
ReadPool& Database::readers() { return parts_->readers; }
/// The readers first: the last connection to close, the writer's, checkpoints.
void Database::drain() {
  parts_->scrub.reset();
  parts_->reader_engine.stop();
  parts_->writer_engine.stop();
}

Health Database::health() const { return parts_->monitor.health(); }
const WriterCounters& Database::writer_counters() const { return parts_->writer_engine.counters(); }
std::size_t Database::writer_queue() const { return parts_->writer_engine.queued(); }

Result<void> Database::backup(const std::filesystem::path& file) const {
  return copy_database(parts_->file, file);
}

Result<VerifyReport> Database::verify(const MeasurementCheck& check) const {
  try {
    Session session(parts_->options, parts_->clock, sqlite::Mode::Read);
    return Verifier(session, check).run();
  } catch (const StorageFailure& failure) {
    return failure.error();
  }
}

}  // namespace fitgauge::store
