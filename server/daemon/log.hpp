#pragma once

#include <string>
#include <string_view>

#include "http/server.hpp"

namespace fitgauge::daemon {

/// JSON lines on stderr, one an event. Thread-safe.
void open_log(const std::string& level);

bool logs_requests();

void log_request(const http::FinishedRequest& request);
void log_info(std::string_view event, std::string_view detail);
void log_warning(std::string_view event, std::string_view detail);
void log_error(std::string_view event, std::string_view detail);

/// Writes what is buffered; before the process ends.
void flush_log();

}  // namespace fitgauge::daemon
