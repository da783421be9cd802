#pragma once

#include "base/result.hpp"

namespace fitgauge::store {
class Database;
}

namespace fitgauge::app {

class LogService;
class TableCatalog;

/// Whether the service may be used, and the activity of the database.
struct Readiness {
  std::vector<Error> findings;  ///< empty: ready
  std::string database;         ///< `ok`, or `checking` while a large file is still being read
};

Readiness readiness(const store::Database& database, const TableCatalog& tables,
                    const LogService& log);

/// Whether a daemon could start on the database at `address` (`postgresql://…`); changes nothing.
/// @errors StorageUnavailable, DatabaseNewer, DatabaseForeign, each naming the server's reason.
Result<void> check_database(const std::string& address);

}  // namespace fitgauge::app
