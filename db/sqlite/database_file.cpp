#include "db/sqlite/database_file.hpp"

#include <SQLiteCpp/Backup.h>

#include "db/sqlite/data_directory.hpp"
#include "db/store/stores.hpp"

namespace fitgauge::store::sqlite {

int schema_version(Connection& connection) {
  return static_cast<int>(connection.query_integer("PRAGMA user_version"));
}

Result<void> check_history(Connection& connection, std::span<const Migration> known) {
  const int version = schema_version(connection);
  if (version > static_cast<int>(known.size())) return sql::newer_database(version, known.size());
  const Result<int> steps =
      sql::check_steps(connection, known.first(static_cast<std::size_t>(version)));
  if (!steps && steps.error().code != ErrorCode::DatabaseNewer) return steps.error();
  if (!steps || *steps != version) {
    return Error{ErrorCode::DatabaseForeign,
                 fmt::format("the database has schema {}, but {} migrations", version,
                             steps ? fmt::format("{}", *steps) : "more")};
  }
  return {};
}

void migrate(Connection& connection, std::span<const Migration> known, std::int64_t now_ns) {
  connection.execute("BEGIN IMMEDIATE");
  for (const Migration& migration :
       known.subspan(static_cast<std::size_t>(schema_version(connection)))) {
    connection.execute(std::string(migration.sql));
    sql::record_step(connection, migration, now_ns);
  }
  connection.execute(fmt::format("PRAGMA application_id = {}; PRAGMA user_version = {}; COMMIT",
                                 kApplicationId, known.size()));
}

}  // namespace fitgauge::store::sqlite

namespace fitgauge::store {
namespace {

namespace fs = std::filesystem;

Error unavailable(std::string message) {
  return {ErrorCode::StorageUnavailable, std::move(message)};
}

/// Gives a finished file its name, durably. The name is free: nothing is replaced.
Result<void> publish(const fs::path& finished, const fs::path& name) {
  TRY(sync_file(finished));
  TRY(rename_to_new(finished, name));
  return sync_file(name);
}

/// A temporary file of an earlier attempt.
void remove_leftover(const fs::path& file) {
  std::error_code ignored;
  for (const std::string_view suffix : {"", "-journal", "-wal", "-shm"}) {
    fs::remove(with_suffix(file, suffix), ignored);
  }
}

Result<void> create_file(const fs::path& file, std::span<const sqlite::Migration> known,
                         std::int64_t now_ns) {
  if (fs::exists(with_suffix(file, "-wal"))) {
    return Error{ErrorCode::DatabaseForeign,
                 fmt::format("{0} is missing, but its log {0}-wal exists: restore a backup, or "
                             "move the log away to start with a new database",
                             file.string())};
  }
  const fs::path draft = with_suffix(file, ".new");
  remove_leftover(draft);
  TRY(reserve_name(draft));
  {
    sqlite::Connection connection(draft, sqlite::Mode::Create);
    sqlite::migrate(connection, known, now_ns);
  }
  return publish(draft, file);
}

Result<void> upgrade_file(const fs::path& file, std::span<const sqlite::Migration> known,
                          int version, std::int64_t now_ns) {
  const fs::path backup = with_suffix(file, fmt::format(".schema-{}.backup", version));
  remove_leftover(backup);
  TRY(copy_database(file, backup));
  sqlite::Connection connection(file, sqlite::Mode::Write);
  sqlite::migrate(connection, known, now_ns);
  return {};
}

/// A kill while the file is changed to WAL mode, at the first start or with a restored backup,
/// leaves a rollback journal. A read-only connection may not roll it back and would refuse the
/// file.
void roll_back_interrupted_change(const fs::path& file) {
  if (!fs::exists(with_suffix(file, "-journal"))) return;
  sqlite::Connection connection(file, sqlite::Mode::Create);
  sqlite::schema_version(connection);
}

/// A read-only connection to a file in WAL mode leaves an empty log with its index. While this
/// object lives, the directory is only the caller's; its destructor removes new files.
class LeavesNoLog {
 public:
  explicit LeavesNoLog(const fs::path& file)
      : log_(with_suffix(file, "-wal")),
        index_(with_suffix(file, "-shm")),
        kept_(fs::exists(log_)) {}
  LeavesNoLog& operator=(LeavesNoLog&&) = delete;  // neither copied nor moved
  ~LeavesNoLog() {
    std::error_code ignored;
    if (kept_ || !fs::is_empty(log_, ignored) || ignored) return;
    fs::remove(log_, ignored);
    fs::remove(index_, ignored);
  }

 private:
  fs::path log_;
  fs::path index_;
  bool kept_;
};

/// Rows in the tree but not in the table were cut off: their ids would be used again.
Result<void> has_whole_log(sqlite::Connection& connection, const fs::path& file) {
  const std::int64_t signed_rows = connection.query_integer("SELECT size FROM log");
  const std::int64_t rows =
      connection.query_integer("SELECT coalesce(max(id), 0) FROM measurements");
  if (rows >= signed_rows) return {};
  return Error{ErrorCode::StorageCorrupt,
               fmt::format("{} has signed {} measurements and contains {}: the newest measurements "
                           "are missing. Restore a backup",
                           file.string(), signed_rows, rows)};
}

/// Opens the existing file read-only, so that a refused file stays unchanged.
Result<int> checked_version(const OpenOptions& options, const fs::path& file,
                            std::span<const sqlite::Migration> known) {
  // With a running daemon the log is the daemon's.
  std::optional<LeavesNoLog> leaves_no_log;
  if (options.access == Access::Serve) leaves_no_log.emplace(file);
  try {
    sqlite::Connection connection(file, sqlite::Mode::Read);
    const int version = sqlite::schema_version(connection);
    std::optional<Error> foreign;
    if (const Result<void> history = sqlite::check_history(connection, known); !history) {
      foreign = history.error();
      foreign->message.insert(0, file.string() + ": ");
      if (foreign->code == ErrorCode::DatabaseNewer) return *foreign;
    }
    if (options.access == Access::Serve && fs::file_size(file) <= options.check_at_open_limit) {
      TRY(check_file(file));
    }
    if (foreign) return *foreign;
    if (options.access == Access::Serve) TRY(has_whole_log(connection, file));
    return version;
  } catch (const StorageFailure& failure) {
    if (failure.error().code != ErrorCode::StorageCorrupt) throw;
    return Error{ErrorCode::StorageCorrupt, fmt::format("{} is damaged: {}. Restore a backup",
                                                        file.string(), failure.error().message)};
  }
}

Result<void> prepare_or_throw(const OpenOptions& options, std::span<const sqlite::Migration> known,
                              std::int64_t now_ns) {
  const fs::path file = options.directory / kDatabaseFile;
  TRY(check_kinds(file));
  if (!fs::exists(file)) {
    if (options.access == Access::Serve) return create_file(file, known, now_ns);
    return unavailable(fmt::format("{} does not exist: start fitgauged once", file.string()));
  }
  TRY(inspect_file(file, options.access));
  if (options.access == Access::Serve) {
    close_to_others(file);
    roll_back_interrupted_change(file);
  }
  const int version = TRY(checked_version(options, file, known));
  if (version == static_cast<int>(known.size())) return {};
  if (options.access == Access::Serve) return upgrade_file(file, known, version, now_ns);
  return unavailable(
      fmt::format("{} has an older schema: start fitgauged once to upgrade it", file.string()));
}

}  // namespace

Result<void> prepare_file(const OpenOptions& options, std::span<const sqlite::Migration> known,
                          std::int64_t now_ns) {
  try {
    return prepare_or_throw(options, known, now_ns);
  } catch (const StorageFailure& failure) {
    return failure.error();
  } catch (const fs::filesystem_error& failure) {
    return unavailable(failure.what());
  }
}

Result<void> copy_database(const fs::path& source, const fs::path& target) {
  if (fs::exists(fs::symlink_status(target))) {
    return unavailable(fmt::format("{} exists: name a new file for the backup", target.string()));
  }
  const fs::path draft = with_suffix(target, ".partial");
  remove_leftover(draft);
  const auto give_up = [&](Error error) {
    remove_leftover(draft);
    return error;
  };
  try {
    // Only the service's user and group may read it, whatever the umask.
    TRY(reserve_name(draft));
    sqlite::Connection from(source, sqlite::Mode::Read);
    sqlite::Connection to(draft, sqlite::Mode::Create);
    SQLite::Backup copy(to.database(), from.database());
    copy.executeStep();
    // One file without a log, readable from a read-only medium too.
    to.execute("PRAGMA journal_mode = DELETE");
    if (to.query_integer("SELECT count(*) FROM sqlite_schema WHERE name = 'log_marks'") > 0) {
      to.execute("INSERT OR IGNORE INTO log_marks VALUES ('copy', '', row_digest('copy', ''))");
    }
  } catch (const StorageFailure& failure) {
    return give_up(failure.error());
  } catch (const SQLite::Exception& failure) {
    return give_up(
        unavailable(fmt::format("cannot write {}: {}", target.string(), failure.what())));
  }
  if (const Result<void> published = publish(draft, target); !published) {
    return give_up(published.error());
  }
  return {};
}

}  // namespace fitgauge::store
