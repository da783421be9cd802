#include "nc/program/cycle_names.hpp"

#include <algorithm>
#include <array>

#include "nc/probing/cycle_registry.hpp"
#include "nc/program/machining_cycles.hpp"

namespace fitgauge::interpreter {
namespace {

constexpr std::array kDotted{7, 8, 9, 10, 11, 12, 13, 19, 26, 32};

}  // namespace

const probing::TouchProbeCycle* probing_cycle(klartext::CycleFamily family, int number) {
  if (family == klartext::CycleFamily::GlobalDef) return nullptr;
  return probing::find_cycle(family == klartext::CycleFamily::TchProbe
                                 ? probing::CycleFamily::TchProbe
                                 : probing::CycleFamily::CyclDef,
                             number);
}

bool is_dotted_cycle(int number) {
  return std::find(kDotted.begin(), kDotted.end(), number) != kDotted.end();
}

bool is_available(klartext::CycleFamily family, int number, bool dotted) {
  if (const auto* cycle = probing_cycle(family, number)) {
    return cycle->descriptor.dotted == dotted;
  }
  if (family == klartext::CycleFamily::TchProbe) return false;
  if (const auto* cycle = machining_cycle(number)) return cycle->descriptor.dotted == dotted;
  return dotted && is_dotted_cycle(number);
}

}  // namespace fitgauge::interpreter
