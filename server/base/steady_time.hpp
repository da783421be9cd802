#pragma once

#include <chrono>

#include "base/clock.hpp"

namespace fitgauge {

/// The machine's clock, and how far it can be relied on.
struct SteadyTime {
  Timestamp time{};
  /// The running time since the clock last jumped, or since the start. Sleep does not count.
  std::chrono::nanoseconds held = std::chrono::nanoseconds::max();
};

}  // namespace fitgauge
