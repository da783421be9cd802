#pragma once

#include "nc/klartext/statement.hpp"
#include "nc/probing/touch_probe_cycle.hpp"

/// Which cycles can run: those of the probing library, the coordinate transformations written in
/// sub-lines, and machining cycles as motion.
namespace fitgauge::interpreter {

/// The cycle of the probing library, or null.
const probing::TouchProbeCycle* probing_cycle(klartext::CycleFamily family, int number);

/// 7 to 13, 19, 26, 32: `CYCL DEF 7.0`, `7.1`.
bool is_dotted_cycle(int number);

/// Whether a block of that cycle can run.
bool is_available(klartext::CycleFamily family, int number, bool dotted);

}  // namespace fitgauge::interpreter
