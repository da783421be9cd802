#pragma once

#include "base/length.hpp"
#include "nc/machine/probe_table.hpp"
#include "nc/probing/touch_probe_cycle.hpp"

namespace fitgauge::probing {

/// Adds a calibration of the touch probe to TCHPRAUTO.html beside the program.
/// @param residual the largest distance of a touch from the fitted circle.
/// @errors when the run's output budget is used up.
CycleResult<void> log_calibration(const CycleContext& context, const machine::ProbeSystem& before,
                                  const machine::ProbeSystem& after, Length residual);

}  // namespace fitgauge::probing
