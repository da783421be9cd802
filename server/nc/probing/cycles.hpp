#pragma once

#include "nc/probing/cycle_host.hpp"

namespace fitgauge::probing {

/// The input of one execution: its complete arguments, the machine and the program around it.
struct CycleContext : Arguments {
  machine::Machine& machine;
  CycleHost& host;

  const machine::MachineState& state() const { return machine.state(); }
};

using CycleFunction = CycleResult<void> (*)(const CycleContext&);

/// Checks of several values together, or of a text. Unknown values are missing.
using ArgumentCheck = CycleResult<void> (*)(const Arguments&);

/// A cycle: its description and its function. Static data without state, shared by all threads.
struct TouchProbeCycle {
  CycleDescriptor descriptor;
  CycleFunction execute;
  /// Checks the written values for the linker, and all values for run_cycle; may be null.
  ArgumentCheck check = nullptr;
};

/// A cycle of TCH PROBE. Those below 100 have one block per sub-line.
constexpr TouchProbeCycle cycle(std::uint16_t number, std::string_view name, CycleKind kind,
                                std::span<const CycleParameter> parameters,
                                std::span<const CycleOutput> results, const ErrorSet& errors,
                                CycleFunction execute, std::string_view simulated,
                                std::string_view not_simulated = {}) {
  return {{CycleFamily::TchProbe, number, name, kind, number < 100, parameters, results, errors,
           simulated, not_simulated},
          execute};
}

/// Makes a function of only the context from one with the difference of two cycles.
template <auto function, auto... arguments>
CycleResult<void> with(const CycleContext& context) {
  return function(context, arguments...);
}

/// Runs a function after `begin` has made its object.
template <auto begin, auto function, auto... arguments>
CycleResult<void> after(const CycleContext& context) {
  auto begun = TRY(begin(context));
  return function(context, begun, arguments...);
}

/// Completes and checks the arguments, then runs the cycle: motion, results, status, log, in that
/// order, the stop of Q309 last (decision 6). After an error the machine stops where it is.
/// @errors 1001 tool axis missing, 1004, 1011, 1017 arguments, and those of the cycle and machine.
CycleResult<void> run_cycle(const TouchProbeCycle& cycle, Arguments arguments,
                            machine::Machine& machine, CycleHost& host);

/// The cycles of each file: of alignment/alignment_cycles.cpp, ...
extern const std::span<const TouchProbeCycle> kAlignmentCycles, kCalibrationCycles, kDottedCycles,
    kKinematicsCycles, kObjectCycles, kOtherCycles, kPresetCycles, kProbing3dCycles, kSizeCycles,
    kToolCycles;

/// Every cycle of this library, by family and number: TCH PROBE first, then CYCL DEF.
std::span<const TouchProbeCycle* const> cycles();

/// Returns the cycle; null if there is none: the program then names an unavailable one.
const TouchProbeCycle* find_cycle(CycleFamily family, int number);

}  // namespace fitgauge::probing
