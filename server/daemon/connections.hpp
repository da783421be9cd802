#pragma once

#include <memory>
#include <string>
#include <vector>

#include "daemon/config.hpp"
#include "plant/connections.hpp"
#include "service/application.hpp"

namespace fitgauge::daemon {

/// Reads the file of the connections; none for an empty path. Names of pattern files are relative
/// to its folder. @errors ConfigInvalid with file, line and key.
Result<std::vector<connections::Definition>> read_connections(const std::string& path);

/// Starts the connections; they go before `app`. @errors as read_connections; those of the storage.
Result<std::unique_ptr<connections::Connections>> start_connections(const Config& config,
                                                                    app::Application& app,
                                                                    const Clock& clock,
                                                                    const api::GaugesInUse& gauges);

}  // namespace fitgauge::daemon
