#include "db/sqlite/connection.hpp"

#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>

#include "db/store/canonical_digest.hpp"
#include "db/store/stores.hpp"

namespace fitgauge::store::sqlite {
namespace {

constexpr int kBusyMilliseconds = 5'000;

constexpr std::size_t kMostRowsPerStatement = 32;
/// Number of cached statements, one for each combination of fields; other combinations use the
/// statement with all columns.
constexpr std::size_t kMostStatements = 64;

template <class T>
bool is_given(const T&) {
  return true;
}
template <class T>
bool is_given(const std::optional<T>& value) {
  return value.has_value();
}

constexpr unsigned kFields = [] {
  unsigned count = 0;
  for_each_field(MeasurementRow(), [&count](std::string_view, const auto&) { ++count; });
  return count;
}();

constexpr sql::Dialect kDialect{.has_seals = true, .streams = true};

int flags_of(Mode mode) {
  switch (mode) {
    case Mode::Read: return SQLite::OPEN_READONLY | SQLite::OPEN_NOMUTEX;
    case Mode::Write: return SQLite::OPEN_READWRITE | SQLite::OPEN_NOMUTEX;
    case Mode::Create: return SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE | SQLite::OPEN_NOMUTEX;
  }
  return 0;
}

/// Disables SQLite's memory statistics, which need a global lock for every allocation. Takes effect
/// only before the first connection of the process.
void configure_library() {
  static const int configured = sqlite3_config(SQLITE_CONFIG_MEMSTATUS, 0);
  static_cast<void>(configured);
}

/// A connection creates a log and its index next to the file. In a read-only folder it reads only
/// the file, unless there is a log: then somebody may have it open.
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
  return word_of(synchronous, {"OFF", "NORMAL", "FULL"});
}

void add_value(CanonicalDigest& digest, sqlite3_value* value) {
  const auto size = [&] { return static_cast<std::size_t>(sqlite3_value_bytes(value)); };
  switch (sqlite3_value_type(value)) {
    case SQLITE_NULL: digest.add(std::optional<std::int64_t>()); break;
    case SQLITE_INTEGER: digest.add(sqlite3_value_int64(value)); break;
    default: {
      const auto* bytes = static_cast<const char*>(sqlite3_value_blob(value));
      digest.add(std::string_view(bytes == nullptr ? "" : bytes, size()));
    }
  }
}

void row_digest(sqlite3_context* context, int count, sqlite3_value** values) noexcept {
  try {
    auto& digest = *static_cast<CanonicalDigest*>(sqlite3_user_data(context));
    std::for_each(values, values + count, [&](sqlite3_value* value) { add_value(digest, value); });
    const Digest result = digest.finish();
    sqlite3_result_blob(context, result.data(), static_cast<int>(result.size()), SQLITE_TRANSIENT);
  } catch (const std::exception&) {
    sqlite3_result_error_nomem(context);
  }
}

}  // namespace

Prepared::Prepared(Connection& connection, std::string sql)
    : connection_(connection), sql_(std::move(sql)) {
  sqlite3_stmt* statement = nullptr;
  sqlite3* const handle = connection_.handle();
  require_ok(handle,
             sqlite3_prepare_v3(handle, sql_.data(), static_cast<int>(sql_.size()),
                                SQLITE_PREPARE_PERSISTENT, &statement, nullptr),
             sql_);
  statement_.reset(statement);
}

bool Prepared::step() {
  errno = 0;  // a failure then finds only errors of this step
  const int code = sqlite3_step(statement_.get());
  if (code == SQLITE_ROW) return true;
  if (code != SQLITE_DONE) throw_failure(connection_.handle(), code, "storage");
  return false;
}

void Prepared::run() {
  const auto reset_at_end = [](sqlite3_stmt* statement) { sqlite3_reset(statement); };
  const std::unique_ptr<sqlite3_stmt, decltype(reset_at_end)> end(statement_.get(), reset_at_end);
  while (step()) {
  }
}

void Prepared::release_pages() noexcept { sqlite3_db_release_memory(connection_.handle()); }

void Prepared::bind_null(int index, sql::Kind /*kind*/) {
  require_ok(connection_.handle(), sqlite3_bind_null(statement_.get(), index), sql_);
}

void Prepared::bind_integer(int index, std::int64_t value) {
  require_ok(connection_.handle(), sqlite3_bind_int64(statement_.get(), index, value), sql_);
}

// A null pointer would bind NULL instead of an empty text.
void Prepared::bind_text(int index, std::string_view value) {
  const char* const data = value.data() == nullptr ? "" : value.data();
  require_ok(connection_.handle(),
             sqlite3_bind_text64(statement_.get(), index, data, value.size(), nullptr, SQLITE_UTF8),
             sql_);
}

void Prepared::bind_blob(int index, std::string_view bytes) {
  const void* const data = bytes.data() == nullptr ? "" : bytes.data();
  require_ok(connection_.handle(),
             sqlite3_bind_blob64(statement_.get(), index, data, bytes.size(), nullptr), sql_);
}

// The pointer is asked for before the size: that order converts the value first.
std::string_view Prepared::text(int column) const {
  const unsigned char* const data = sqlite3_column_text(statement_.get(), column);
  const auto size = static_cast<std::size_t>(sqlite3_column_bytes(statement_.get(), column));
  return {reinterpret_cast<const char*>(data), size};
}

std::string_view Prepared::blob(int column) const {
  const void* const data = sqlite3_column_blob(statement_.get(), column);
  const auto size = static_cast<std::size_t>(sqlite3_column_bytes(statement_.get(), column));
  return {static_cast<const char*>(data), size};
}

Connection::Connection(const std::filesystem::path& file, Mode mode, Synchronous synchronous)
    : sql::Connection(kDialect), database_(open(file, mode)) {
  sqlite3_extended_result_codes(handle(), 1);
  add_row_digest(handle());
  // temp_store: savepoints keep their undo data in memory, so no temporary directory is needed.
  // recursive_triggers: REPLACE also fires the triggers that refuse DELETE.
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
  return read_first<std::int64_t>(sql::Statement(*this, sql).query()).value_or(0);
}

std::string Connection::query_text(const std::string& sql) {
  return read_first<std::string>(sql::Statement(*this, sql).query()).value_or("");
}

void Connection::rollback() noexcept {
  if (sqlite3_get_autocommit(handle()) == 0) database_.tryExec("ROLLBACK");
}

void add_row_digest(sqlite3* handle) {
  auto digest = std::make_unique<CanonicalDigest>();
  const auto destroy = [](void* made) { delete static_cast<CanonicalDigest*>(made); };
  // SQLite destroys it even when this fails.
  require_ok(handle,
             sqlite3_create_function_v2(handle, "row_digest", -1,
                                        SQLITE_UTF8 | SQLITE_DETERMINISTIC | SQLITE_INNOCUOUS,
                                        digest.release(), row_digest, nullptr, nullptr, destroy),
             "storage");
}

MeasurementTable::MeasurementTable(Connection& connection)
    : connection_(connection),
      newest_(connection, "SELECT id FROM measurements ORDER BY id DESC LIMIT 1") {}

std::int64_t MeasurementTable::last_id() {
  return read_first<std::int64_t>(newest_.query()).value_or(0);
}

void MeasurementTable::append(std::span<const MeasurementRow> rows) {
  while (!rows.empty()) {
    // Powers of two: few statements fit every number of rows.
    const std::size_t count = std::min(std::bit_floor(rows.size()), kMostRowsPerStatement);
    insert(rows.first(count));
    rows = rows.subspan(count);
  }
}

MeasurementTable::Fields MeasurementTable::fields_of(std::span<const MeasurementRow> rows) {
  static_assert(kFields <= 8 * sizeof(Fields));
  Fields fields = 0;
  for (const MeasurementRow& row : rows) {
    unsigned bit = 0;
    for_each_field(row, [&](std::string_view /*column*/, const auto& value) {
      fields |= Fields{is_given(value)} << bit++;
    });
  }
  return fields;
}

std::string MeasurementTable::insert_sql(const Shape& shape) {
  std::string columns;
  std::string values = "(";
  unsigned bit = 0;
  for_each_field(MeasurementRow(), [&](std::string_view column, const auto&) {
    if (!contains(shape.fields, bit++)) return;
    columns += fmt::format("{}, ", column);
    values += "?,";
  });
  values += "?)";
  std::string sql = fmt::format("INSERT INTO measurements ({}hash) VALUES {}", columns, values);
  for (std::size_t i = 1; i < shape.rows; ++i) sql += ',' + values;
  return sql;
}

std::pair<const MeasurementTable::Shape, Prepared>& MeasurementTable::statement_for(
    const Shape& shape) {
  const auto found = statements_.find(shape);
  if (found != statements_.end()) return *found;
  const Shape made = statements_.size() < kMostStatements ? shape : Shape{kAllFields, shape.rows};
  return *statements_.try_emplace(made, connection_, insert_sql(made)).first;
}

void MeasurementTable::insert(std::span<const MeasurementRow> rows) {
  auto& made = statement_for({fields_of(rows), rows.size()});
  const Fields fields = made.first.fields;
  Prepared& statement = made.second;
  int index = 0;
  for (const MeasurementRow& row : rows) {
    unsigned bit = 0;
    for_each_field(row, [&](std::string_view /*column*/, const auto& value) {
      if (contains(fields, bit++)) sql::bind_value(statement, ++index, value);
    });
    sql::bind_value(statement, ++index, row.hash);
  }
  statement.run();
  // SQLite finds the end of the table without a search if it assigns the ids.
  if (const std::int64_t id = rows.back().id; connection_.last_inserted_id() != id) {
    throw std::logic_error(fmt::format("measurement {} was stored with another id", id));
  }
}

}  // namespace fitgauge::store::sqlite
