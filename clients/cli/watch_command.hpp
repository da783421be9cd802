#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>

#include "cli/context.hpp"
#include "cli/json_object.hpp"

namespace fitgauge::cli {

/// One of the Server-Sent Events (WHATWG HTML, 9.2).
struct Event {
  std::string type;
  std::string id;
  std::string data;
};

/// Reads a stream of events in pieces of any size. One reader serves one connection after the
/// other: last_id() is what the next one names.
class EventReader {
 public:
  /// Takes an event; false ends the reading.
  using Sink = std::function<bool(const Event&)>;

  explicit EventReader(Sink sink) : sink_(std::move(sink)) {}

  /// @returns false when the sink wanted no more.
  bool feed(std::string_view piece);

  /// Forgets what a connection left unfinished.
  void reconnect();

  const std::string& last_id() const { return last_id_; }
  void set_last_id(std::string id) { last_id_ = std::move(id); }

 private:
  bool take_line(std::string_view line);

  Sink sink_;
  std::string line_;
  Event event_;
  std::string last_id_;
};

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
