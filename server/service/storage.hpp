#pragma once

// Names of the storage and of its readers, for declarations, and whether they may be used.

namespace fitgauge::store {

class Database;
class DirectoryLock;
class KeyRing;
struct MeasurementRow;
struct Run;
struct Stores;
struct VerifyReport;

}  // namespace fitgauge::store

namespace fitgauge::app {

using store::Database;
using store::MeasurementRow;
using store::Stores;

class LogService;
class Origins;
class TableCatalog;

/// Whether the service may be used, and the activity of the database.
struct Readiness {
  std::vector<Error> findings;  ///< empty: ready
  std::string database;         ///< `ok`, or `checking` while a large file is still being read
};

}  // namespace fitgauge::app
