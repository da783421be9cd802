#include "db/sqlite/connection.hpp"

#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include "db/sql/statement.hpp"
#include "db/sqlite/data_directory.hpp"
#include "db/sqlite/measurement_table.hpp"
#include "db/sqlite/prepared.hpp"
#include "db/sqlite/row_digest.hpp"
#include "db/store/storage_failure.hpp"

namespace fitgauge::store::sqlite {
namespace {

constexpr int kBusyMilliseconds = 5'000;

constexpr sql::Dialect kDialect{.has_seals = true, .streams = true};

int flags_of(Mode mode) {
  switch (mode) {
    case Mode::Read: return SQLite::OPEN_READONLY | SQLite::OPEN_NOMUTEX;
    case Mode::Write: return SQLite::OPEN_READWRITE | SQLite::OPEN_NOMUTEX;
    case Mode::Create: return SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE | SQLite::OPEN_NOMUTEX;
  }
  return 0;
}

/// Without its memory statistics SQLite takes no global lock for every allocation. Takes effect
/// before the first connection of the process only.
void configure_library() {
  static const int configured = sqlite3_config(SQLITE_CONFIG_MEMSTATUS, 0);
  static_cast<void>(configured);
}

/// A connection makes a log and its index beside the file. In a folder that it may not write to it
/// reads the file alone, unless there is a log to read as well: then somebody may have it open.
bool is_at_rest(const std::filesystem::path& file) {
  const auto is_there = [&file](const char* suffix) {
    struct stat status {};
    return ::stat((file.string() + suffix).c_str(), &status) == 0 && status.st_size > 0;
  };
  return ::access(folder_of(file).c_str(), W_OK) != 0 && !is_there("-wal") && !is_there("-shm");
}

SQLite::Database open(const std::filesystem::path& file, Mode mode) {
  configure_library();
  try {
    if (mode != Mode::Read || !is_at_rest(file)) {
      return {file.string(), flags_of(mode), kBusyMilliseconds};
    }
    std::string uri = "file:";
    for (const char c : std::filesystem::absolute(file).string()) {
      c == '%' || c == '?' || c == '#' ? uri += fmt::format("%{:02X}", c) : uri += c;
    }
    return {uri + "?immutable=1", flags_of(mode) | SQLite::OPEN_URI, kBusyMilliseconds};
  } catch (const SQLite::Exception& failure) {
    throw_failure(nullptr, failure.getExtendedErrorCode(), "opening " + file.string());
  }
}

std::string_view name_of(Synchronous synchronous) {
  switch (synchronous) {
    case Synchronous::Off: return "OFF";
    case Synchronous::Normal: return "NORMAL";
    case Synchronous::Full: return "FULL";
  }
  return "FULL";
}

}  // namespace

Connection::Connection(const std::filesystem::path& file, Mode mode, Synchronous synchronous)
    : sql::Connection(kDialect), database_(open(file, mode)) {
  sqlite3_extended_result_codes(handle(), 1);
  add_row_digest(handle());
  // temp_store: savepoints keep what they may undo in memory, so no temporary directory is needed.
  // recursive_triggers: REPLACE, too, fires the triggers that refuse DELETE.
  execute(
      "PRAGMA foreign_keys = ON; PRAGMA recursive_triggers = ON; PRAGMA trusted_schema = OFF;"
      "PRAGMA cell_size_check = ON; PRAGMA temp_store = MEMORY; PRAGMA cache_size = -4000;");
  if (mode == Mode::Read) return;
  execute(fmt::format("PRAGMA synchronous = {}", name_of(synchronous)));
  if (mode == Mode::Write) {
    execute(
        "PRAGMA journal_mode = WAL; PRAGMA wal_autocheckpoint = 4000;"
        "PRAGMA journal_size_limit = 67108864; PRAGMA cache_size = -16000;");
  }
}

Connection::~Connection() = default;

std::unique_ptr<sql::Prepared> Connection::prepare(const std::string& sql) {
  return std::make_unique<Prepared>(*this, sql);
}

sql::MeasurementTable& Connection::measurements() {
  if (!measurements_) measurements_ = std::make_unique<MeasurementTable>(*this);
  return *measurements_;
}

void Connection::execute(const std::string& sql) {
  require_ok(handle(), sqlite3_exec(handle(), sql.c_str(), nullptr, nullptr, nullptr), "storage");
}

std::int64_t Connection::query_integer(const std::string& sql) {
  sql::Statement statement(*this, sql);
  sql::Rows rows = statement.query();
  return rows.next() ? rows.get<std::int64_t>(0) : 0;
}

std::string Connection::query_text(const std::string& sql) {
  sql::Statement statement(*this, sql);
  sql::Rows rows = statement.query();
  return rows.next() ? rows.get<std::string>(0) : std::string();
}

void Connection::rollback() noexcept {
  if (sqlite3_get_autocommit(handle()) == 0) database_.tryExec("ROLLBACK");
}

}  // namespace fitgauge::store::sqlite
