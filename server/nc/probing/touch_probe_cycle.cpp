#include "nc/probing/touch_probe_cycle.hpp"

#include <cassert>

#include "nc/probing/cycle_descriptor.hpp"

namespace fitgauge::probing {

CycleResult<void> run_cycle(const TouchProbeCycle& cycle, Arguments arguments,
                            machine::Machine& machine, CycleHost& host) {
  if (auto completed = arguments.complete(); !completed) return completed;
  if (cycle.check != nullptr) {
    if (auto checked = cycle.check(arguments); !checked) return checked;
  }
  auto done = cycle.execute({arguments, machine, host});
  assert(done || done.error().number == 0 ||
         errors_of(cycle.descriptor).contains(done.error().number));
  return done;
}

}  // namespace fitgauge::probing
