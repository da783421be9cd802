#pragma once

#include <SQLiteCpp/Database.h>

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

#include "db/sql/connection.hpp"
#include "db/sqlite/failure.hpp"
#include "db/store/open_options.hpp"

namespace fitgauge::store::sqlite {

enum class Mode {
  Read,    ///< an existing file, nothing is written to it
  Write,   ///< an existing file in WAL mode
  Create,  ///< a new file with a rollback journal: complete once it is closed
};

/// A connection to one file with fitgauge's settings. Used by one thread at a time. Every failure
/// is thrown as sqlite/failure.hpp says; after one the connection is closed and opened again.
class Connection final : public sql::Connection {
 public:
  Connection(const std::filesystem::path& file, Mode mode,
             Synchronous synchronous = Synchronous::Full);
  ~Connection() override;

  std::unique_ptr<sql::Prepared> prepare(const std::string& sql) override;
  sql::MeasurementTable& measurements() override;

  void execute(const std::string& sql);
  std::int64_t query_integer(const std::string& sql);
  std::string query_text(const std::string& sql);
  std::int64_t last_inserted_id() const { return sqlite3_last_insert_rowid(handle()); }

  /// Undoes the open transaction, if there is one. Never throws.
  void rollback() noexcept;

  SQLite::Database& database() { return database_; }
  sqlite3* handle() const { return database_.getHandle(); }

 private:
  SQLite::Database database_;
  std::unique_ptr<sql::MeasurementTable> measurements_;
};

}  // namespace fitgauge::store::sqlite
