#include "nc/probing/cycles.hpp"

namespace fitgauge::probing {
namespace {

constexpr const TouchProbeCycle* kCycles[] = {
#define FITGAUGE_CYCLE(file, number) &file::kCycle##number,
#include "nc/probing/cycles.inc"
#undef FITGAUGE_CYCLE
};

}  // namespace

std::span<const TouchProbeCycle* const> cycles() { return kCycles; }

const TouchProbeCycle* find_cycle(CycleFamily family, int number) {
  const auto found = std::ranges::find_if(kCycles, [&](const TouchProbeCycle* cycle) {
    return cycle->descriptor.family == family && cycle->descriptor.number == number;
  });
  return found == std::ranges::end(kCycles) ? nullptr : *found;
}

}  // namespace fitgauge::probing
