#pragma once

#include <vector>

#include "nc/klartext/syntax.hpp"
#include "nc/probing/touch_probe_cycle.hpp"
#include "nc/program/machining_cycles.hpp"

namespace fitgauge::interpreter {

/// A cycle block in Q parameters with its cycle and parameters found, so that a run looks nothing
/// up by name. At most one of the cycles; none: it is not available.
struct BoundCycle {
  const probing::TouchProbeCycle* probing = nullptr;
  const MachiningCycle* machining = nullptr;
  const probing::CycleDescriptor* global = nullptr;  ///< GLOBAL DEF
  /// One for each parameter of the block; not null, since the linker refuses unknown ones.
  std::vector<const probing::CycleParameter*> parameters{};

  /// Of its parameters; null when it is not available.
  const probing::CycleDescriptor* descriptor() const {
    if (probing != nullptr) return &probing->descriptor;
    return machining != nullptr ? &machining->descriptor : global;
  }
};

BoundCycle bind_cycle(const klartext::Program& program, const klartext::Cycle& cycle);

}  // namespace fitgauge::interpreter
