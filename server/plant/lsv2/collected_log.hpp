#pragma once

#include <cstddef>
#include <deque>
#include <memory>
#include <string>
#include <vector>

#include "plant/lsv2/collector_options.hpp"
#include "record/measurement.hpp"
#include "service/tables/table_catalog.hpp"

namespace fitgauge::connections {

/// One log, or one result of an FN 16 file, as it is to be stored. Owns what its measurements look
/// at, so it stays where it is.
struct CollectedLog {
  CollectedLog() = default;
  CollectedLog(const CollectedLog&) = delete;
  CollectedLog& operator=(const CollectedLog&) = delete;

  std::string text{};
  bool has_time = false;  ///< the control's, in its text
  std::string key{};      ///< the same for the same log of the same machine and path, and no other
  std::vector<app::Measurement> measurements{};  ///< none: nothing in it is a length
  std::size_t values_kept = 0;  ///< angles and figures of axes, they stay in the file

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

/// Reads the logs of touch-probe cycles, or else by the first pattern that finds a result. Of
/// a log that judges something every length it judges is stored; of one that judges nothing the
/// first length, indeterminate. Angles and figures of axes stay in the file.
Collected collect(const Origin& origin, const std::string& bytes);

}  // namespace fitgauge::connections
