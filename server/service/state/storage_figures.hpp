#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

namespace fitgauge::app {

/// What the database does beside writing, for metrics.
struct StorageFigures {
  std::size_t readers_queued = 0;  ///< jobs that wait for a reader
  bool is_on_server = false;       ///< not in files of the data folder

  // What a server says of itself; nothing where there is none or it is away.
  std::optional<std::int64_t> server_bytes{};
  std::optional<std::int64_t> standbys{};
  std::optional<std::int64_t> standby_behind_bytes{};  ///< of the last of them
};

}  // namespace fitgauge::app
