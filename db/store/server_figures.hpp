#pragma once

#include <cstdint>
#include <optional>

namespace fitgauge::store {

/// What a database server says of itself, for metrics.
struct ServerFigures {
  std::int64_t database_bytes = 0;
  std::int64_t standbys = 0;  ///< servers that follow this one at the moment
  /// What the last of them does not have on its disk yet; nothing where there is none, or where the
  /// user may not see it.
  std::optional<std::int64_t> standby_behind_bytes{};
};

}  // namespace fitgauge::store
