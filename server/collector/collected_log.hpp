#pragma once

#include <cstddef>
#include <deque>
#include <memory>
#include <string>
#include <vector>

#include "app/measurements/measurement.hpp"
#include "app/tables/table_catalog.hpp"
#include "collector/collector_options.hpp"

namespace fitgauge::collector {

/// One log, or one result of an FN 16 file, as it is to be stored. Owns what its measurements look
/// at, so it stays where it is.
struct CollectedLog {
  CollectedLog() = default;
  CollectedLog(const CollectedLog&) = delete;
  CollectedLog& operator=(const CollectedLog&) = delete;

  std::string text{};
  bool has_time = false;  ///< the control's, in its text
  std::string key{};      ///< the same for the same log of the same machine and path, and no other
  std::vector<app::Measurement> measurements{};  ///< none: nothing in it is a size
  std::size_t values_kept = 0;  ///< that are no size of a part and stay in the file

  app::TableCatalog::Tables tables{};
  std::deque<std::string> texts{};
};

/// What a file holds.
struct Collected {
  std::vector<std::shared_ptr<CollectedLog>> logs{};
  std::vector<std::string> unread{};  ///< `line 5: …`
};

/// Where a file comes from and by what it is judged.
struct Origin {
  const MachineOptions& machine;
  const std::string& path;  ///< on the control
  const app::TableCatalog& tables;
  Timestamp now;  ///< of results that tell no time
};

/// Reads the logs of touch-probe cycles, or else by the first pattern that finds a result. A size
/// is stored where its limits, or without limits its nominal size, are above 0: a coordinate about
/// zero, an angle or a form of its own is no size. Of a log that judges something what it does not
/// judge stays in the file; of one that judges nothing the first size is stored, indeterminate.
Collected collect(const Origin& origin, const std::string& bytes);

}  // namespace fitgauge::collector
