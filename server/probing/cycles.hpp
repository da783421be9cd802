#pragma once

#include "probing/touch_probe_cycle.hpp"

/// Every cycle's definition, each in the file of its number; the registry lists them.
namespace fitgauge::probing {

extern const TouchProbeCycle kCycle247;
extern const TouchProbeCycle kCycle417;
extern const TouchProbeCycle kCycle421;
extern const TouchProbeCycle kCycle422;
extern const TouchProbeCycle kCycle427;

}  // namespace fitgauge::probing
