#pragma once

#include <SQLiteCpp/Database.h>
#include <sqlite3.h>

#include <filesystem>

#include "base/clock.hpp"
#include "db/sql/connection.hpp"
#include "db/sql/session.hpp"
#include "db/sql/statement.hpp"
#include "db/sqlite/data_directory.hpp"
#include "db/store/database.hpp"
#include "db/store/measurement_row.hpp"

namespace fitgauge::store::sqlite {

class Connection;

/// A statement of a connection. SQLiteCpp's own lacks the persistent flag and copies a shared
/// pointer for each column read.
class Prepared final : public sql::Prepared {
 public:
  Prepared(Connection& connection, std::string sql);

  void bind_null(int index, sql::Kind kind) override;
  void bind_integer(int index, std::int64_t value) override;
  void bind_text(int index, std::string_view value) override;
  void bind_blob(int index, std::string_view bytes) override;

  void run() override;
  bool step() override;
  void reset() noexcept override { sqlite3_reset(statement_.get()); }

  int columns() const override { return sqlite3_column_count(statement_.get()); }
  bool is_null(int column) const override {
    return sqlite3_column_type(statement_.get(), column) == SQLITE_NULL;
  }
  std::int64_t integer(int column) const override {
    return sqlite3_column_int64(statement_.get(), column);
  }
  std::string_view text(int column) const override;
  std::string_view blob(int column) const override;

  void release_pages() noexcept override;

 private:
  struct Finalize {
    void operator()(sqlite3_stmt* statement) const { sqlite3_finalize(statement); }
  };

  Connection& connection_;
  const std::string sql_;
  std::unique_ptr<sqlite3_stmt, Finalize> statement_;
};

enum class Mode {
  Read,    ///< an existing file, nothing is written to it
  Write,   ///< an existing file in WAL mode
  Create,  ///< a new file with a rollback journal: complete once it is closed
};

/// A connection to one file with fitgauge's settings. Used by one thread at a time. Failures are
/// thrown as in sqlite/failure.hpp; after a failure the connection is closed and opened again.
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

namespace fitgauge::store {

/// The name of the database in its directory.
inline constexpr std::string_view kDatabaseFile = "fitgauge.db";

namespace sqlite {

/// A connection to the file with its stores.
class Session : public sql::Session {
 public:
  Session(const OpenOptions& options, const Clock& clock, Mode mode)
      : connection(options.directory / kDatabaseFile, mode, options.synchronous),
        stores_(connection, clock, options.idempotency_retention) {}

  Stores& stores() override { return stores_; }
  void begin_reading() override { begin_reading_.run(); }
  void begin_writing() override { begin_writing_.run(); }
  void commit() override { commit_.run(); }
  /// A disk that is full has taken nothing, and SQLite knows what it has.
  bool is_reliable() const override { return sqlite3_errcode(connection.handle()) == SQLITE_FULL; }
  void rollback() noexcept override { connection.rollback(); }
  void savepoint() override { savepoint_.run(); }
  void undo() override { undo_.run(); }
  void settle() override {}
  void release() override { release_.run(); }
  void probe() override {
    connection.execute("UPDATE storage_probe SET probed_at = probed_at + 1");
  }
  void tidy_up(WriterCounters& /*counters*/) override {}

  Connection connection;

 private:
  Stores stores_;
  sql::Statement begin_reading_{connection, "BEGIN"};
  sql::Statement begin_writing_{connection, "BEGIN IMMEDIATE"};
  sql::Statement commit_{connection, "COMMIT"};
  sql::Statement savepoint_{connection, "SAVEPOINT job"};
  sql::Statement undo_{connection, "ROLLBACK TO job"};
  sql::Statement release_{connection, "RELEASE job"};
};

}  // namespace sqlite

}  // namespace fitgauge::store

namespace fitgauge::store::sqlite {

/// Lets the statements of a connection call `row_digest(value, …)`.
void add_row_digest(sqlite3* handle);

/// Inserts many rows with one statement, and only the columns that some of them use. One statement
/// for each row, with every column, takes 1.5 times as long.
class MeasurementTable final : public sql::MeasurementTable {
 public:
  explicit MeasurementTable(Connection& connection);

  void append(std::span<const MeasurementRow> rows) override;
  std::int64_t last_id() override;

 private:
  /// A set of fields, one bit each in the order of for_each_field.
  __extension__ using Fields = unsigned __int128;
  /// The purpose of a statement.
  struct Shape {
    Fields fields = 0;
    std::size_t rows = 0;

    // NOLINTNEXTLINE(modernize-use-nullptr): the zero is the compiler's
    friend auto operator<=>(const Shape&, const Shape&) = default;
  };

  static constexpr Fields kAllFields = ~Fields{0};
  static bool contains(Fields fields, unsigned bit) { return ((fields >> bit) & 1U) != 0; }
  static Fields fields_of(std::span<const MeasurementRow> rows);
  static std::string insert_sql(const Shape& shape);
  std::pair<const Shape, Prepared>& statement_for(const Shape& shape);
  void insert(std::span<const MeasurementRow> rows);

  Connection& connection_;
  sql::Statement newest_;
  std::map<Shape, Prepared> statements_;
};

}  // namespace fitgauge::store::sqlite
