#pragma once

#include "nc/probing/touch_probe_cycle.hpp"
#include "nc/run/nc_error.hpp"

namespace fitgauge::interpreter {

class Channel;

/// The words of a touch-probe cycle in sub-lines (0, 1, 3, 4) as its arguments.
/// @param first, last the blocks of its first and last sub-line.
NcResult<probing::Arguments> dotted_arguments(Channel& channel,
                                              const probing::TouchProbeCycle& cycle,
                                              std::uint32_t first, std::uint32_t last);

}  // namespace fitgauge::interpreter
