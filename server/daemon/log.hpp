#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "http/server.hpp"

namespace fitgauge::daemon {

// JSON lines on stderr, one an event; docs/reference/log.md lists them. Thread-safe, and nobody
// waits: the lines go through a bounded queue, and what its reader is too slow for is counted and
// said. Without an open log nothing is written.

void open_log(const std::string& level);

/// An answer of 5xx is an error; the others are information.
void log_request(const http::FinishedRequest& finished);
void log_info(std::string_view event, std::string_view detail);
void log_warning(std::string_view event, std::string_view detail);
void log_error(std::string_view event, std::string_view detail);

/// Lines lost since the start.
std::uint64_t log_lines_lost();

/// Writes what is queued, for a second at most; before the process ends. No thread may log any
/// more.
void close_log();

}  // namespace fitgauge::daemon
