#include "db/sqlite/prepared.hpp"

#include <cerrno>
#include <utility>

#include "db/sqlite/connection.hpp"

namespace fitgauge::store::sqlite {

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
  errno = 0;  // what a failure finds there is of this step
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

// A null pointer would bind NULL where an empty text is meant.
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

}  // namespace fitgauge::store::sqlite
