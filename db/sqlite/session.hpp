#pragma once

#include <string_view>

#include "base/clock.hpp"
#include "db/sql/session.hpp"
#include "db/sql/statement.hpp"
#include "db/sqlite/connection.hpp"
#include "db/store/open_options.hpp"

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
