#include "db/store/database.hpp"

#include <unistd.h>

#include <filesystem>

#include "db/sql/session.hpp"
#include "db/sqlite/connection.hpp"
#include "db/sqlite/data_directory.hpp"
#include "db/sqlite/database_file.hpp"
#include "db/store/stores.hpp"

namespace fitgauge::store::sqlite {
namespace {

/// The writer's session with the checkpoints of its commits. It is the last connection to close,
/// and so checkpoints.
class WriterSession final : public Session {
 public:
  using Check = std::function<Result<void>()>;

  /// @param check whether lock and database are still the files that were opened.
  WriterSession(const OpenOptions& options, const Clock& clock, Mode mode, Check check,
                LogFiles& log)
      : Session(options, clock, mode), check_(std::move(check)), log_(log), checkpointer_(options) {
    checkpointer_.install(connection);
    connection.query_integer("SELECT count(*) FROM sqlite_schema");  // opens the log
    log_.remember();
  }
  /// The last connection that closes removes the log by its name, which may be another database's.
  /// What a removed log held goes into the database.
  ~WriterSession() override {
    const bool has_database{check_()};
    if (has_database && log_.check()) {
      log_.forget();
      return;
    }
    sqlite3* const handle = connection.handle();
    if (has_database && log_.is_log_gone()) {
      sqlite3_wal_checkpoint_v2(handle, nullptr, SQLITE_CHECKPOINT_FULL, nullptr, nullptr);
    }
    sqlite3_db_config(handle, SQLITE_DBCONFIG_NO_CKPT_ON_CLOSE, 1, nullptr);
  }

  void tidy_up(WriterCounters& counters) override {
    counters.log_pages = static_cast<std::uint64_t>(checkpointer_.log_pages());
    checkpointer_.after_commit(connection);
  }

 private:
  const Check check_;
  LogFiles& log_;
  Checkpointer checkpointer_;
};

/// Whether a command can only read: the folder is on a read-only file system, or another user's.
bool is_read_only(const OpenOptions& options) {
  return options.access == Access::Attach && ::access(options.directory.c_str(), W_OK) != 0;
}

/// Members are destroyed from the last to the first: the writer closes after the readers, and so
/// checkpoints; the lock is released last.
class FileDatabase final : public Database {
 public:
  FileDatabase(std::optional<DirectoryLock> held, const OpenOptions& chosen, const Clock& time)
      : lock_(std::move(held)),
        options_(chosen),
        clock_(time),
        file_(chosen.directory / kDatabaseFile),
        identity_(identity_of(file_)),
        log_files_(file_),
        monitor_(chosen.health_changed),
        writer_(
            chosen, time, monitor_,
            [this]() -> std::unique_ptr<sql::Session> {
              require_own_files();
              const Mode mode = is_read_only(options_) ? Mode::Read : Mode::Write;
              return std::make_unique<WriterSession>(
                  options_, clock_, mode, [this] { return check_database(); }, log_files_);
            },
            [this] { require_own_files(); }),
        readers_(chosen, monitor_, [this] {
          require_own_files();
          return std::make_unique<Session>(options_, clock_, Mode::Read);
        }) {
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
    readers_.stop();
    writer_.stop();
  }

  /// Looks at the files as well: a file that was removed is noticed while nobody writes.
  Health health() const override {
    const Health known = monitor_.health();
    if (known.state == HealthState::Damaged) return known;
    const auto own = check_files();
    return own ? known : Health{HealthState::WritesFailing, own.error().message};
  }

  Result<void> backup(const std::filesystem::path& file) const override {
    TRY(check_files());
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
  static FileIdentity identity_of(const std::filesystem::path& file) {
    auto identity = FileIdentity::of(file);
    if (!identity) throw StorageFailure(identity.error());
    return *std::move(identity);
  }

  Result<void> check_database() const {
    TRY(lock_ ? lock_->check() : Result<void>());
    return identity_.check();
  }
  /// Checks that lock, database and log are still the opened files.
  Result<void> check_files() const {
    TRY(check_database());
    return log_files_.check();
  }
  void require_own_files() const {
    if (const auto own = check_files(); !own) throw StorageFailure(own.error());
  }

  std::optional<DirectoryLock> lock_;
  const OpenOptions options_;
  const Clock& clock_;
  const std::filesystem::path file_;
  const FileIdentity identity_;
  LogFiles log_files_;
  HealthMonitor monitor_;
  WriterThread writer_;
  ReaderThreads readers_;
  std::optional<Scrub> scrub_;
};

}  // namespace

Result<std::unique_ptr<Database>> open_database(const OpenOptions& options, const Clock& clock) {
  std::optional<DirectoryLock> lock;
  if (options.access == Access::Serve) {
    auto held = TRY(DirectoryLock::acquire(options.directory));
    lock.emplace(std::move(held));
  }
  TRY(prepare_file(options, migrations(), clock.now().nanoseconds));
  try {
    return std::unique_ptr<Database>(
        std::make_unique<FileDatabase>(std::move(lock), options, clock));
  } catch (const StorageFailure& failure) {
    return failure.error();
  }
}

}  // namespace fitgauge::store::sqlite
