#pragma once

#include "api/service/metrics.hpp"
#include "base/clock.hpp"
#include "daemon/config.hpp"
#include "plant/centre/forwarder.hpp"
#include "plant/connections.hpp"
#include "service/application.hpp"

namespace fitgauge::daemon {

/// Reads the file of the connections; none for an empty path. Names of pattern files are relative
/// to its folder. @errors ConfigInvalid with file, line and key.
Result<std::vector<connections::Definition>> read_connections(const std::string& path);

/// Starts the connections; they must be destroyed before `app`. @errors as read_connections; those
/// of the storage.
Result<std::unique_ptr<connections::Connections>> start_connections(const Config& config,
                                                                    app::Application& app,
                                                                    const Clock& clock,
                                                                    const api::GaugesInUse& gauges);

/// Whether the settings of forwarding go together.
/// @errors ConfigInvalid: no centre's address, http:// beyond this machine, an unreadable key.
Result<void> check_forwarding(const Config& config);

/// Returns the centre's state of a history; none without a response within some seconds.
std::optional<app::AtCentre> ask_centre(const Config& config, std::string_view digits);

/// Starts to forward the log to the centre; null when there is none.
std::unique_ptr<forwarder::Forwarder> start_forwarder(const Config& config, app::Application& app,
                                                      forwarder::Tell tell);
/// Writes to the log of the service.
void tell_log(std::string_view event, const std::string& detail);

/// Writes number and age of records that the centre lacks. @param forwarder may be null.
void write_outbox_metrics(const forwarder::Forwarder* forwarder, const Clock& clock,
                          api::Exposition& out);

}  // namespace fitgauge::daemon
