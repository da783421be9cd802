#pragma once

// Names of the storage and of its readers, for declarations.

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

}  // namespace fitgauge::app
