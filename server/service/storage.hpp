#pragma once

// Names of the storage and of its readers, for declarations, and whether they may be used.

namespace fitgauge {
class Clock;
}

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
struct RowNames;

/// Receives the name of an event and a sentence, for the log of the service. Called on any thread.
using Tell = std::function<void(std::string_view event, const std::string& detail)>;

/// Receives the result of a function that does not block.
template <class T>
using Done = std::function<void(Result<T>)>;

/// The records of a data folder, for the services that read or store them: the database, the names
/// of the numbers in its rows, and the time of new ones. All of them outlive the services.
struct Records {
  Database& database_;
  TableCatalog& tables_;
  Origins& origins_;
  const Clock& clock_;
};

/// Whether the service may be used, and the activity of the database.
struct Readiness {
  std::vector<Error> findings;  ///< empty: ready
  std::string database;         ///< `ok`, or `checking` while a large file is still being read
};

}  // namespace fitgauge::app
