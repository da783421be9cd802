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

}  // namespace fitgauge::probing
