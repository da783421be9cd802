#include "nc/program/bound_cycle.hpp"

#include "nc/program/cycle_arguments.hpp"
#include "nc/program/cycle_names.hpp"
#include "nc/program/global_definitions.hpp"

namespace fitgauge::interpreter {

BoundCycle bind_cycle(const klartext::Program& program, const klartext::Cycle& cycle) {
  BoundCycle bound;
  if (cycle.family == klartext::CycleFamily::GlobalDef) {
    bound.global = global_definition(cycle.number);
  } else if (const auto* probing = probing_cycle(cycle.family, cycle.number);
             probing != nullptr && !probing->descriptor.dotted) {
    bound.probing = probing;
  } else if (cycle.family == klartext::CycleFamily::CyclDef) {
    const auto* machining = machining_cycle(cycle.number);
    if (machining != nullptr && !machining->descriptor.dotted) bound.machining = machining;
  }
  const probing::CycleDescriptor* descriptor = bound.descriptor();
  if (descriptor == nullptr) return bound;
  for (const klartext::CycleParameter& written : program.view(cycle.parameters)) {
    bound.parameters.push_back(find_parameter(*descriptor, written.parameter));
  }
  return bound;
}

}  // namespace fitgauge::interpreter
