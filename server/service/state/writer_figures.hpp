#pragma once

#include <cstddef>
#include <cstdint>

#include "base/histogram.hpp"

namespace fitgauge::app {

/// What the database's writer does, for metrics: now, and since the start.
struct WriterFigures {
  std::size_t queued = 0;  ///< jobs that wait
  const Histogram<12>& commit_seconds;
  const Histogram<9>& batch_jobs;
  std::uint64_t failures = 0;
  std::uint64_t log_pages = 0;  ///< in the write-ahead log
};

}  // namespace fitgauge::app
