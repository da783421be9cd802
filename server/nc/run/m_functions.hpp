#pragma once

#include "nc/run/motion_words.hpp"
#include "nc/run/statements.hpp"

namespace fitgauge::interpreter {

/// M functions with effect at the start of the block: spindle and coolant on, TCPM.
NcResult<void> start_m_functions(Channel& channel, const std::vector<MCall>& calls);

/// M functions with effect at its end: spindle and coolant off, M140, stops, cycle call, end of the
/// program.
NcResult<Next> end_m_functions(Channel& channel, const MotionWords& words);

/// M140 MB, and MB of PLANE: away from the workpiece along the tool axis, in rapid traverse without
/// a feed.
NcResult<void> retract(Channel& channel, const MCall& call);

}  // namespace fitgauge::interpreter
