#pragma once

#include "base/clock.hpp"
#include "store/open_options.hpp"
#include "store/sqlite/connection.hpp"
#include "store/stores.hpp"

namespace fitgauge::store {

/// The name of the database in its directory.
inline constexpr std::string_view kDatabaseFile = "fitgauge.db";

/// A connection with its stores.
struct Session {
  Session(const OpenOptions& options, const Clock& clock, sqlite::Mode mode)
      : connection(options.directory / kDatabaseFile, mode, options.synchronous),
        stores(connection, clock, options.idempotency_retention) {}

  sqlite::Connection connection;
  Stores stores;
};

}  // namespace fitgauge::store
