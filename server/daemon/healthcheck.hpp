#pragma once

#include <filesystem>

#include "base/result.hpp"
#include "daemon/config.hpp"

namespace fitgauge::daemon {

/// Where a service that wants client certificates writes the port on 127.0.0.1 that answers health
/// checks without TLS, and nothing else.
std::filesystem::path health_port_file(const Config& config);

/// Asks the service that runs with this configuration for /readyz, as a container's health check
/// does without curl.
/// @errors NotReady saying what came back: no connection, no answer in 3 s, another status than
/// 200.
Result<void> healthcheck(const Config& config);

}  // namespace fitgauge::daemon
