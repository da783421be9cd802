#pragma once

#include <string>

#include "daemon/config.hpp"

namespace fitgauge::daemon {

/// Runs the service until SIGTERM or SIGINT; SIGHUP reads the certificates again.
/// @param port_file receives the first port, in decimal, once the socket listens; may be empty.
/// @errors those of opening the database and of listening.
Result<void> serve(const Config& config, const std::string& port_file);

}  // namespace fitgauge::daemon
