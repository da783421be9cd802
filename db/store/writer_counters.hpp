#pragma once

#include <atomic>
#include <cstdint>
#include <optional>

#include "base/histogram.hpp"

namespace fitgauge::store {

/// What a database server says of itself, for metrics.
struct ServerFigures {
  std::int64_t database_bytes = 0;
  std::int64_t standbys = 0;  ///< servers that follow this one at the moment
  /// What the last of them does not have on its disk yet; nothing where there is none, or where the
  /// user may not see it.
  std::optional<std::int64_t> standby_behind_bytes{};
};

/// What the writer has done since the start, for metrics. Written by the writer's thread, read by
/// any.
struct WriterCounters {
  /// From the transaction's begin until it is on disk.
  Histogram<12> commit_seconds{
      {0.0005, 0.001, 0.0025, 0.005, 0.01, 0.025, 0.05, 0.1, 0.25, 0.5, 1, 2.5}};
  Histogram<9> batch_jobs{{1, 2, 4, 8, 16, 32, 64, 256, 1024}};
  std::atomic<std::uint64_t> failed_commits{0};
  std::atomic<std::int64_t> own_rows{0};    ///< MeasurementsStore::log_size() after the last commit
  std::atomic<std::uint64_t> log_pages{0};  ///< in the write-ahead log after the last commit
};

}  // namespace fitgauge::store
