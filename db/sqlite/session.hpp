#pragma once

#include <string_view>

#include "base/clock.hpp"
#include "sqlite/connection.hpp"
#include "sqlite/statement.hpp"
#include "store/open_options.hpp"
#include "store/stores.hpp"

namespace fitgauge::store {

/// The name of the database in its directory.
inline constexpr std::string_view kDatabaseFile = "fitgauge.db";

/// A connection with its stores and the statements that delimit a transaction.
struct Session {
  Session(const OpenOptions& options, const Clock& clock, sqlite::Mode mode)
      : connection(options.directory / kDatabaseFile, mode, options.synchronous),
        stores(connection, clock, options.idempotency_retention) {}

  sqlite::Connection connection;
  Stores stores;
  sqlite::Statement begin_reading{connection, "BEGIN"};
  sqlite::Statement begin_writing{connection, "BEGIN IMMEDIATE"};
  sqlite::Statement commit{connection, "COMMIT"};
  sqlite::Statement savepoint{connection, "SAVEPOINT job"};
  sqlite::Statement undo{connection, "ROLLBACK TO job"};
  sqlite::Statement release{connection, "RELEASE job"};
};

}  // namespace fitgauge::store
