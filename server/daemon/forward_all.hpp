#pragma once

#include "base/result.hpp"
#include "daemon/config.hpp"

namespace fitgauge::daemon {

/// `fitgauged forward --all`: forwards all of the folder's log to the centre and ends; 1 when the
/// centre refuses it, or cannot be reached for a minute. Once more goes on where it ended.
Result<int> run_forward_all(const Config& config);

}  // namespace fitgauge::daemon
