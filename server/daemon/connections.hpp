#pragma once

#include <memory>
#include <string>
#include <vector>

#include "app/application.hpp"
#include "collector/collector.hpp"
#include "daemon/config.hpp"

namespace fitgauge::daemon {

/// Reads the file of the connections; none for an empty path. Names of pattern files are relative
/// to its folder. @errors ConfigInvalid with file, line and key.
Result<std::vector<collector::MachineOptions>> read_connections(const std::string& path);

/// Begins to collect; goes before `app`. @errors as read_connections.
Result<std::unique_ptr<collector::Collector>> start_collector(const Config& config,
                                                              app::Application& app,
                                                              const Clock& clock);

}  // namespace fitgauge::daemon
