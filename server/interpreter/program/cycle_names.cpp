#include "program/cycle_names.hpp"

#include <algorithm>
#include <array>

#include "probing/cycle_registry.hpp"

namespace fitgauge::interpreter {
namespace {

// Which parameters a block of each drilling cycle may have, in the order of the control's dialog.
constexpr std::array<std::uint16_t, 11> k200{200, 201, 206, 202, 210, 203, 204, 211, 395, 207, 208};
constexpr std::array<std::uint16_t, 7> k201{200, 201, 206, 211, 208, 203, 204};
constexpr std::array<std::uint16_t, 9> k202{200, 201, 206, 211, 208, 203, 204, 214, 336};
constexpr std::array<std::uint16_t, 14> k203{200, 201, 206, 202, 210, 203, 204,
                                             212, 213, 205, 211, 208, 256, 395};
constexpr std::array<std::uint16_t, 17> k205{200, 201, 206, 202, 203, 204, 212, 205, 258,
                                             259, 257, 256, 211, 379, 253, 208, 395};
constexpr std::array<std::uint16_t, 6> k206{200, 201, 206, 211, 203, 204};
constexpr std::array<std::uint16_t, 5> k207{200, 201, 239, 203, 204};
constexpr std::array<std::uint16_t, 8> k209{200, 201, 239, 203, 204, 257, 256, 336};
constexpr std::array<std::uint16_t, 11> k240{200, 343, 201, 344, 206, 211, 203, 204, 341, 342, 395};
constexpr std::array<std::uint16_t, 19> k241{200, 201, 206, 211, 203, 204, 379, 253, 208, 426,
                                             427, 428, 429, 430, 435, 401, 202, 212, 205};

constexpr DrillingCycle kDrilling[] = {
    {200, false, true, k200},  {201, false, false, k201}, {202, false, false, k202},
    {203, false, true, k203},  {205, false, true, k205},  {206, true, false, k206},
    {207, true, false, k207},  {209, true, false, k209},  {240, false, false, k240},
    {241, false, false, k241},
};

constexpr std::array kDotted{7, 8, 9, 10, 11, 12, 13, 19, 26, 32};

}  // namespace

const probing::TouchProbeCycle* probing_cycle(klartext::CycleFamily family, int number) {
  return probing::find_cycle(family == klartext::CycleFamily::TchProbe
                                 ? probing::CycleFamily::TchProbe
                                 : probing::CycleFamily::CyclDef,
                             number);
}

const DrillingCycle* drilling_cycle(int number) {
  const auto* it = std::find_if(std::begin(kDrilling), std::end(kDrilling),
                                [&](const DrillingCycle& cycle) { return cycle.number == number; });
  return it == std::end(kDrilling) ? nullptr : it;
}

bool is_dotted_cycle(int number) {
  return std::find(kDotted.begin(), kDotted.end(), number) != kDotted.end();
}

bool is_available(klartext::CycleFamily family, int number, bool dotted) {
  if (const auto* cycle = probing_cycle(family, number)) {
    return cycle->descriptor.dotted == dotted;
  }
  if (family == klartext::CycleFamily::TchProbe) return false;
  return dotted ? is_dotted_cycle(number) : drilling_cycle(number) != nullptr;
}

}  // namespace fitgauge::interpreter
