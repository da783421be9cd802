#include "sqlite/statement.hpp"

#include <cerrno>
#include <utility>

#include "sqlite/connection.hpp"

namespace fitgauge::store::sqlite {

Statement::Statement(Connection& connection, std::string sql)
    : connection_(&connection), sql_(std::move(sql)) {}

void Statement::prepare() {
  sqlite3_stmt* statement = nullptr;
  sqlite3* const handle = connection_->handle();
  require_ok(handle,
             sqlite3_prepare_v3(handle, sql_.data(), static_cast<int>(sql_.size()),
                                SQLITE_PREPARE_PERSISTENT, &statement, nullptr),
             sql_);
  statement_.reset(statement);
}

bool Statement::step() {
  errno = 0;  // what a failure finds there is of this step
  const int code = sqlite3_step(prepared());
  if (code == SQLITE_ROW) return true;
  if (code != SQLITE_DONE) throw_failure(connection_->handle(), code, "storage");
  return false;
}

void Statement::release_pages() noexcept { sqlite3_db_release_memory(connection_->handle()); }

void Statement::reset() noexcept { sqlite3_reset(statement_.get()); }

void Statement::run_bound() {
  const Rows rows(*this);
  while (step()) {
  }
}

void Statement::bind_null(int index) {
  require_ok(connection_->handle(), sqlite3_bind_null(prepared(), index), sql_);
}

void Statement::bind_integer(int index, std::int64_t value) {
  require_ok(connection_->handle(), sqlite3_bind_int64(prepared(), index, value), sql_);
}

// A null pointer would bind NULL where an empty text is meant.
void Statement::bind_text(int index, std::string_view value) {
  const char* const data = value.data() == nullptr ? "" : value.data();
  require_ok(connection_->handle(),
             sqlite3_bind_text64(prepared(), index, data, value.size(), nullptr, SQLITE_UTF8),
             sql_);
}

void Statement::bind_blob(int index, const void* data, std::size_t size) {
  const void* const bytes = data == nullptr ? "" : data;
  require_ok(connection_->handle(), sqlite3_bind_blob64(prepared(), index, bytes, size, nullptr),
             sql_);
}

// The pointer is asked for before the size: that order converts the value first.
std::string_view Rows::text(int column) const {
  const unsigned char* const data = sqlite3_column_text(raw(), column);
  const auto size = static_cast<std::size_t>(sqlite3_column_bytes(raw(), column));
  return {reinterpret_cast<const char*>(data), size};
}

std::string_view Rows::blob(int column) const {
  const void* const data = sqlite3_column_blob(raw(), column);
  const auto size = static_cast<std::size_t>(sqlite3_column_bytes(raw(), column));
  return {static_cast<const char*>(data), size};
}

}  // namespace fitgauge::store::sqlite
