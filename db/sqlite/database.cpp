#include "db/sqlite/database.hpp"

#include <filesystem>
#include <optional>

#include "db/sql/read_pool_engine.hpp"
#include "db/sql/writer_engine.hpp"
#include "db/sqlite/checkpointer.hpp"
#include "db/sqlite/data_directory.hpp"
#include "db/sqlite/database_file.hpp"
#include "db/sqlite/scrub.hpp"
#include "db/sqlite/session.hpp"
#include "db/sqlite/verifier.hpp"
#include "db/store/storage_failure.hpp"

namespace fitgauge::store::sqlite {
namespace {

/// The writer's session with the checkpoints of what it commits. It closes last of all connections,
/// and so checkpoints.
class WriterSession final : public Session {
 public:
  WriterSession(const OpenOptions& options, const Clock& clock)
      : Session(options, clock, Mode::Write), checkpointer_(options) {
    checkpointer_.install(connection);
  }

  void tidy_up(WriterCounters& counters) override {
    counters.log_pages = static_cast<std::uint64_t>(checkpointer_.log_pages());
    checkpointer_.after_commit(connection);
  }

 private:
  Checkpointer checkpointer_;
};

/// Destroyed from the last member to the first: the writer closes after the readers, and so
/// checkpoints; the lock goes last.
class FileDatabase final : public Database {
 public:
  FileDatabase(std::optional<DirectoryLock> held, const OpenOptions& chosen, const Clock& time)
      : lock_(std::move(held)),
        options_(chosen),
        clock_(time),
        file_(chosen.directory / kDatabaseFile),
        monitor_(chosen.health_changed),
        writer_engine_(chosen, time, monitor_,
                       [this] { return std::make_unique<WriterSession>(options_, clock_); }),
        reader_engine_(chosen, monitor_,
                       [this] { return std::make_unique<Session>(options_, clock_, Mode::Read); }),
        writer_(writer_engine_),
        readers_(reader_engine_) {
    const bool too_large_for_the_start =
        std::filesystem::file_size(file_) > options_.check_at_open_limit;
    if (options_.access == Access::Serve) {
      scrub_.emplace(options_, clock_, monitor_, too_large_for_the_start);
    }
  }

  Writer& writer() override { return writer_; }
  ReadPool& readers() override { return readers_; }

  /// The readers first: the last connection to close, the writer's, checkpoints.
  void drain() override {
    scrub_.reset();
    reader_engine_.stop();
    writer_engine_.stop();
  }

  Health health() const override { return monitor_.health(); }
  const WriterCounters& writer_counters() const override { return writer_engine_.counters(); }
  std::size_t writer_queue() const override { return writer_engine_.queued(); }
  std::size_t reader_queue() const override { return reader_engine_.queued(); }

  Result<void> backup(const std::filesystem::path& file) const override {
    return copy_database(file_, file);
  }

  Result<VerifyReport> verify(const MeasurementCheck& check) const override {
    try {
      Session session(options_, clock_, Mode::Read);
      return Verifier(session, check).run();
    } catch (const StorageFailure& failure) {
      return failure.error();
    }
  }

 private:
  std::optional<DirectoryLock> lock_;
  const OpenOptions options_;
  const Clock& clock_;
  const std::filesystem::path file_;
  HealthMonitor monitor_;
  Writer::Engine writer_engine_;
  ReadPool::Engine reader_engine_;
  Writer writer_;
  ReadPool readers_;
  std::optional<Scrub> scrub_;
};

}  // namespace

Result<std::unique_ptr<Database>> open_database(const OpenOptions& options, const Clock& clock) {
  std::optional<DirectoryLock> lock;
  if (options.access == Access::Serve) {
    Result<DirectoryLock> held = DirectoryLock::acquire(options.directory);
    if (!held) return held.error();
    lock.emplace(*std::move(held));
  }
  const Result<void> prepared = prepare_file(options, migrations(), clock.now().nanoseconds);
  if (!prepared) return prepared.error();
  try {
    return std::unique_ptr<Database>(
        std::make_unique<FileDatabase>(std::move(lock), options, clock));
  } catch (const StorageFailure& failure) {
    return failure.error();
  }
}

}  // namespace fitgauge::store::sqlite
