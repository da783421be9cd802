#pragma once

#include "base/result.hpp"
#include "daemon/config.hpp"

namespace fitgauge::daemon {

/// Asks the service that runs with this configuration for /readyz, as a container's health check
/// does without curl.
/// @errors NotReady saying what came back: no connection, no answer in 3 s, another status than
/// 200.
Result<void> healthcheck(const Config& config);

}  // namespace fitgauge::daemon
