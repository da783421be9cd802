#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "plant/lsv2/collector_options.hpp"
#include "plant/plant.hpp"

namespace fitgauge::connections {

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
