#include "probing/touch_probe_cycle.hpp"

#include <utility>

namespace fitgauge::probing {

CycleResult<void> run_cycle(const TouchProbeCycle& cycle, Arguments arguments,
                            machine::Machine& machine, CycleHost& host) {
  if (auto completed = arguments.complete(); !completed) return completed;
  return cycle.execute({arguments, machine, host});
}

}  // namespace fitgauge::probing
