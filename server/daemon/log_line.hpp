#pragma once

#include <string>
#include <string_view>

#include "http/server.hpp"

namespace fitgauge::daemon {

/// In rising order; `Off` is above all.
enum class LogLevel { Debug, Info, Warning, Error, Off };

/// `warning` as the configuration names it. @pre one of its words.
LogLevel log_level_named(std::string_view word);

/// Each appends one line of JSON with its line feed: time (UTC, microseconds), level and what
/// happened.
void append_event_line(std::string& out, LogLevel level, std::string_view event,
                       std::string_view detail);
/// With the caller's name where the request had a key, and what a proxy says it asks for.
void append_request_line(std::string& out, LogLevel level, const http::FinishedRequest& finished);

}  // namespace fitgauge::daemon
