#pragma once

#include <functional>
#include <memory>
#include <string>
#include <string_view>

#include "api/service/exposition.hpp"
#include "base/clock.hpp"
#include "daemon/config.hpp"
#include "plant/centre/forwarder.hpp"
#include "service/application.hpp"

namespace fitgauge::daemon {

/// Whether the settings of forwarding go together.
/// @errors ConfigInvalid: no address of a centre, http:// beyond this machine, a key that cannot be
///   read.
Result<void> check_forwarding(const Config& config);

/// As the log of the service has it: the event's name and a sentence.
using Tell = std::function<void(std::string_view event, const std::string& detail)>;

/// Starts to forward the log to the centre; null when there is none.
std::unique_ptr<forwarder::Forwarder> start_forwarder(const Config& config, app::Application& app,
                                                      Tell tell);
/// To the log of the service.
void tell_log(std::string_view event, const std::string& detail);

/// How much of the log the centre does not have, and for how long. @param forwarder may be null.
void write_outbox_metrics(const forwarder::Forwarder* forwarder, const Clock& clock,
                          api::Exposition& out);

}  // namespace fitgauge::daemon
