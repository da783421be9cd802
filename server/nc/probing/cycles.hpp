#pragma once

#include "nc/probing/touch_probe_cycle.hpp"

namespace fitgauge::probing {

/// Every cycle's definition, cycle_421_422::kCycle421 in cycle_421_422.cpp.
#define FITGAUGE_CYCLE(file, number)           \
  namespace file {                             \
  extern const TouchProbeCycle kCycle##number; \
  }
#include "nc/probing/cycles.inc"
#undef FITGAUGE_CYCLE

/// Every cycle of this library, by family and number: TCH PROBE first, then CYCL DEF.
std::span<const TouchProbeCycle* const> cycles();

/// Returns the cycle; null if there is none: the program then names an unavailable one.
const TouchProbeCycle* find_cycle(CycleFamily family, int number);

}  // namespace fitgauge::probing
