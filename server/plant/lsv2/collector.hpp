#pragma once

#include <chrono>
#include <cstddef>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "formats/measuring_log/pattern.hpp"
#include "plant/lsv2/link/link_socket.hpp"
#include "plant/plant.hpp"

namespace fitgauge::connections {

/// Files that are watched: a folder of the control and a name that may have `*` and `?`.
struct WatchedPath {
  std::string folder{};  ///< TNC:\nc_prog\, with its last stroke
  std::string name{};    ///< TCHPR*.TXT; letters count in either case
};

/// A pattern of FN 16 files and the file that says it.
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

  /// Without a machine the connection's.
  const std::string& machine_name() const { return machine && !machine->empty() ? *machine : name; }
};

/// Reads measuring logs from a control over LSV-2. It logs in as INSPECT and FILE, and only lists
/// and reads. A machine that is away is asked again after twice the time, up to ten minutes.
/// @param plant outlives it.
std::unique_ptr<Worker> make(const MachineOptions& machine, const Plant& plant);

/// Logs in and lists the watched folders once. Waits.
ConnectionTest test_of(const MachineOptions& machine, const Plant&, const std::stop_token& stop);

}  // namespace fitgauge::connections
