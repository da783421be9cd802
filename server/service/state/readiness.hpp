#pragma once

#include "base/result.hpp"
#include "service/storage.hpp"

namespace fitgauge::app {

/// Whether the service may be used, and the activity of the database.
struct Readiness {
  std::vector<Error> findings;  ///< empty: ready
  std::string database;         ///< `ok`, or `checking` while a large file is still being read
};

Readiness readiness(const Database& database, const TableCatalog& tables, const LogService& log);

/// Whether a daemon could start on the database at `address` (`postgresql://…`); changes nothing.
/// @errors StorageUnavailable, DatabaseNewer, DatabaseForeign, each naming the server's reason.
Result<void> check_database(const std::string& address);

}  // namespace fitgauge::app
