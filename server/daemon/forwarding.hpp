#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
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

/// How many rows of a history the centre has; none where it does not say within some seconds.
std::optional<std::int64_t> ask_centre(const Config& config, std::string_view digits);

/// Starts to forward the log to the centre; null when there is none.
std::unique_ptr<forwarder::Forwarder> start_forwarder(const Config& config, app::Application& app,
                                                      Tell tell);
/// To the log of the service.
void tell_log(std::string_view event, const std::string& detail);

/// How much of the log the centre does not have, and for how long. @param forwarder may be null.
void write_outbox_metrics(const forwarder::Forwarder* forwarder, const Clock& clock,
                          api::Exposition& out);

}  // namespace fitgauge::daemon
