#pragma once

#include "nc/probing/touch_probe_cycle.hpp"

namespace fitgauge::probing {

/// The cycles of each file: of alignment/alignment_cycles.cpp, ...
extern const std::span<const TouchProbeCycle> kAlignmentCycles, kCalibrationCycles, kDottedCycles,
    kKinematicsCycles, kObjectCycles, kOtherCycles, kPresetCycles, kProbing3dCycles, kSizeCycles,
    kToolCycles;

/// Every cycle of this library, by family and number: TCH PROBE first, then CYCL DEF.
std::span<const TouchProbeCycle* const> cycles();

/// Returns the cycle; null if there is none: the program then names an unavailable one.
const TouchProbeCycle* find_cycle(CycleFamily family, int number);

}  // namespace fitgauge::probing
