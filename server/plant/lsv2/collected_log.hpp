#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <string>
#include <vector>

#include "plant/lsv2/collector.hpp"
#include "plant/plant.hpp"
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

/// What a file has given.
struct Taken {
  std::uint64_t logs = 0;          ///< read, whether new or not
  std::uint64_t measurements = 0;  ///< stored by this call
  std::uint64_t values_kept = 0;   ///< of new logs: no length, they stay in the file
  std::vector<std::string> unread{};
};

/// Stores what a file of a machine says, then the file itself, below `TNC:\collected\MACHINE\`.
/// However often and however far it came before, each log is stored once: its key is kept for ever
/// in the transaction that stores its measurements. Waits; at most sixteen jobs of it wait for the
/// writer. Thread-safe.
/// @errors FilePathInvalid: the path is too long to keep; StorageBusy, StorageUnavailable: try
///   again, nothing is lost.
Result<Taken> take_logs(const Plant& plant, const MachineOptions& machine, const std::string& path,
                        const std::string& bytes);

}  // namespace fitgauge::connections
