#include "nc/probing/touch_probe_cycle.hpp"

#include <cassert>

#include "nc/probing/cycle_descriptor.hpp"

namespace fitgauge::probing {

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
