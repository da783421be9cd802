#pragma once

#include <mutex>
#include <string>
#include <vector>

#include "nc/program/control_disk.hpp"
#include "tables/iso286/tolerance_tables.hpp"

namespace fitgauge::app {

class TableCatalog;

/// 82553_hole.tab and 82553_shaft.tab as tolerance tables give them.
std::vector<interpreter::ProjectingDisk::Projection> project(const iso286::ToleranceTables& tables);

/// The same of the tolerance tables in use, projected once for each of their revisions.
/// Thread-safe.
class LiveTables {
 public:
  /// @param catalog outlives this.
  explicit LiveTables(const TableCatalog& catalog) : catalog_(catalog) {}

  /// Both tables of one revision; none where the tables failed their audit.
  std::vector<interpreter::ProjectingDisk::Projection> projections();

 private:
  const TableCatalog& catalog_;
  std::mutex mutex_;
  std::string revision_;
  std::vector<interpreter::ProjectingDisk::Projection> projections_;
};

}  // namespace fitgauge::app
