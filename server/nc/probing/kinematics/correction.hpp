#pragma once

#include "nc/probing/kinematics/fit.hpp"
#include "nc/probing/touch_probe_cycle.hpp"

namespace fitgauge::probing {

/// What the machine lets a fit correct: with insignificant_corrections "note" everything.
FitOptions fit_options(const CycleContext& context, bool directions);

/// Takes the corrected model into the machine, if there is something to correct, and notes what is
/// left out. A correction beyond max_modification_mm waits for NC Start; where a stop ends the run
/// nothing is corrected.
/// @errors 1102 errors were found, and none of them is at least twice its uncertainty.
CycleResult<void> correct_kinematics(const CycleContext& context,
                                     std::span<const AxisErrors> errors, bool is_corrected,
                                     const machine::Kinematics& corrected);

}  // namespace fitgauge::probing
