#pragma once

#include <cstdint>
#include <span>

#include "klartext/statement.hpp"
#include "probing/touch_probe_cycle.hpp"

/// Which cycles can run: those of the probing library, the coordinate transformations written in
/// sub-lines, and drilling cycles as motion.
namespace fitgauge::interpreter {

/// The cycle of the probing library, or null.
const probing::TouchProbeCycle* probing_cycle(klartext::CycleFamily family, int number);

/// What a drilling cycle does along the tool axis.
struct DrillingCycle {
  std::uint16_t number;
  bool taps;   ///< retracts at the feed of the thread
  bool chips;  ///< Q202: the depth is reached in several infeeds
  std::span<const std::uint16_t> parameters;
};

/// 200 to 203, 205 to 207, 209, 240 and 241, or null.
const DrillingCycle* drilling_cycle(int number);

/// 7 to 13, 19, 26, 32: `CYCL DEF 7.0`, `7.1`.
bool is_dotted_cycle(int number);

/// Whether a block of that cycle can run.
bool is_available(klartext::CycleFamily family, int number, bool dotted);

}  // namespace fitgauge::interpreter
