#pragma once

#include <vector>

#include "interpreter/motion_words.hpp"
#include "interpreter/statements.hpp"

namespace fitgauge::interpreter {

/// Whether the M function is one of the control's; what a machine builder adds is not available.
bool is_m_function(int number);

/// Those that take effect at the start of the block: spindle and coolant on, TCPM.
NcResult<void> start_m_functions(Channel& channel, const std::vector<MCall>& calls);

/// Those that take effect at its end: spindle and coolant off, M140, stops, cycle call, end of the
/// program.
NcResult<Next> end_m_functions(Channel& channel, const MotionWords& words);

}  // namespace fitgauge::interpreter
