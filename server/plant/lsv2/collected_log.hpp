#pragma once

#include "formats/measuring_log/measuring_log.hpp"
#include "plant/lsv2/link/link_client.hpp"
#include "plant/plant.hpp"
#include "record/measurement.hpp"
#include "service/tables/table_catalog.hpp"

namespace fitgauge::connections {

/// Files that are watched: a folder of the control and a name that may have `*` and `?`.
struct WatchedPath {
  std::string folder{};  ///< TNC:\nc_prog\, with its last stroke
  std::string name{};    ///< TCHPR*.TXT; letters count in either case
};

/// A pattern of FN 16 files and its file.
struct NamedPattern {
  std::string file{};
  log_reader::Pattern pattern;
};

/// One machine. All bounds are of one round.
struct MachineOptions {
  std::string name{};  ///< of the connection
  control_link::ControlAddress address{};
  std::optional<std::string> machine{};  ///< of its measurements
  std::vector<WatchedPath> paths{};
  std::vector<NamedPattern> patterns{};
  std::chrono::seconds interval{60};
  std::chrono::seconds longest_wait{600};  ///< of the back-off
  std::size_t most_file_bytes = std::size_t{8} << 20;
  std::size_t most_round_bytes = std::size_t{64} << 20;  ///< the rest is for the next round
  std::size_t most_entries = 10'000;                     ///< of a folder

  /// Returns the machine's name, or else the name of the connection.
  const std::string& machine_name() const { return machine && !machine->empty() ? *machine : name; }
};

/// Results of a file.
struct Taken {
  std::uint64_t logs = 0;          ///< read, whether new or not
  std::uint64_t measurements = 0;  ///< stored by this call
  std::uint64_t values_kept = 0;   ///< of new logs: no length, they stay in the file
  std::vector<std::string> unread{};
};

/// Stores the measurements of a machine's file, then the file itself, in `TNC:\collected\MACHINE\`.
/// Each log is stored once, however often it is read: the transaction of its measurements stores
/// its key for ever. Blocks; at most sixteen of its jobs wait for the writer. Thread-safe.
/// @errors FilePathInvalid: the path is too long; StorageBusy, StorageUnavailable: try again,
///   nothing is lost.
Result<Taken> take_logs(const Plant& plant, const MachineOptions& machine, const std::string& path,
                        const std::string& bytes);

}  // namespace fitgauge::connections
