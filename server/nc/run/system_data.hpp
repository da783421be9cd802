#pragma once

#include "nc/klartext/expression.hpp"
#include "nc/run/nc_error.hpp"

namespace fitgauge::interpreter {

class Channel;

/// FN 18: SYSREAD. Always metric, in INCH programs too.
/// @errors an ID or NR this control does not have (decision 3), no such tool, preset or axis.
NcResult<double> read_system_data(Channel& channel, klartext::NodeIndex address);

/// FN 17: SYSWRITE of ID50 (tool table), ID500 (datum table) and ID503 (preset table).
NcResult<void> write_system_data(Channel& channel, klartext::NodeIndex address, double value);

}  // namespace fitgauge::interpreter
