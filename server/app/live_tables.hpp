#pragma once

#include <mutex>
#include <string>
#include <vector>

#include "interpreter/control_disk.hpp"

namespace fitgauge::app {

class TableCatalog;

/// 82553_hole.tab and 82553_shaft.tab as the tolerance tables in use give them; projected once for
/// each revision of the tables. Thread-safe.
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
