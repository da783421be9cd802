#pragma once

#include "nc/probing/touch_probe_cycle.hpp"

namespace fitgauge::probing {

/// Every cycle's definition, kCycle421 in the file of its number.
#define FITGAUGE_CYCLE(number) extern const TouchProbeCycle kCycle##number;
#include "nc/probing/cycles.inc"
#undef FITGAUGE_CYCLE

}  // namespace fitgauge::probing
