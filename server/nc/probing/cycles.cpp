#include "nc/probing/cycles.hpp"

#include <cassert>

namespace fitgauge::probing {

std::span<const TouchProbeCycle* const> cycles() {
  static const std::vector<const TouchProbeCycle*> kCycles = [] {
    std::vector<const TouchProbeCycle*> all;
    for (const auto& file :
         {kAlignmentCycles, kCalibrationCycles, kDottedCycles, kKinematicsCycles, kObjectCycles,
          kOtherCycles, kPresetCycles, kProbing3dCycles, kSizeCycles, kToolCycles}) {
      for (const TouchProbeCycle& cycle : file) all.push_back(&cycle);
    }
    std::ranges::sort(all, {}, [](const TouchProbeCycle* cycle) {
      return std::pair(cycle->descriptor.family == CycleFamily::CyclDef, cycle->descriptor.number);
    });
    return all;
  }();
  return kCycles;
}

const TouchProbeCycle* find_cycle(CycleFamily family, int number) {
  const auto found = std::ranges::find_if(cycles(), [&](const TouchProbeCycle* cycle) {
    return cycle->descriptor.family == family && cycle->descriptor.number == number;
  });
  return found == cycles().end() ? nullptr : *found;
}

CycleResult<void> run_cycle(const TouchProbeCycle& cycle, Arguments arguments,
                            machine::Machine& machine, CycleHost& host) {
  TRY(arguments.complete());
  if (cycle.check != nullptr) TRY(cycle.check(arguments));
  auto done = cycle.execute({std::move(arguments), machine, host});
  assert(done || done.error().number == 0 ||
         errors_of(cycle.descriptor).contains(done.error().number));
  return done;
}

}  // namespace fitgauge::probing
