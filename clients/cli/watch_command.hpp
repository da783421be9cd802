#pragma once

#include <cstdint>
#include <string>

#include "cli/context.hpp"
#include "cli/event_reader.hpp"
#include "cli/json_object.hpp"

namespace fitgauge::cli {

struct WatchOptions {
  std::string source{};     ///< gauge, simulation or all
  std::string after{};      ///< the id of the last event that is known
  std::uint64_t count = 0;  ///< ends after so many; 0 never does
};

/// A record in one line: when, id, size, value, verdict, and what it is of.
std::string record_line(const JsonValue& record, const Terminal& terminal);

/// `fitgauge watch`: prints what happens as it happens. When the connection is lost it comes back
/// and goes on with the next event. @errors NoAnswer, Refused, KeyNeeded at the first connection.
Outcome<ExitCode> run_watch(const Context& context, const WatchOptions& options);

/// One line for an event; empty for one that another line tells already (a reject is recorded,
/// too).
std::string format_event(const Event& event, const Terminal& terminal);

/// `{"event":…,"id":…,"data":{…}}`
std::string event_json(const Event& event);

}  // namespace fitgauge::cli
