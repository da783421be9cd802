#pragma once

#include "run/active_cycle.hpp"
#include "run/nc_error.hpp"

namespace fitgauge::interpreter {

class Channel;

/// Runs a drilling cycle where the tool stands, as motion along the tool axis: to the set-up
/// clearance Q200 above the surface Q203, at feed to the depth Q201 (in infeeds Q202 where the
/// cycle has them), with its dwells, and back to the larger of the clearances Q200 and Q204.
/// @errors 1010 no feed, 1042 a depth of 0, and those of the machine and the budget.
NcResult<void> drill(Channel& channel, const DrillingDefinition& definition);

}  // namespace fitgauge::interpreter
