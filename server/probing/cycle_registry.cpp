#include "probing/cycle_registry.hpp"

#include <algorithm>
#include <array>

#include "probing/cycles.hpp"

namespace fitgauge::probing {
namespace {

constexpr std::array kCycles{&kCycle417, &kCycle421, &kCycle422, &kCycle427, &kCycle247};

}  // namespace

std::span<const TouchProbeCycle* const> cycles() { return kCycles; }

const TouchProbeCycle* find_cycle(CycleFamily family, int number) {
  const auto found = std::ranges::find_if(kCycles, [&](const TouchProbeCycle* cycle) {
    return cycle->descriptor.family == family && cycle->descriptor.number == number;
  });
  return found == kCycles.end() ? nullptr : *found;
}

}  // namespace fitgauge::probing
