#pragma once

#include "cli/context.hpp"

namespace fitgauge::cli {

/// One of the Server-Sent Events (WHATWG HTML, 9.2).
struct Event {
  std::string type;
  std::string id;
  std::string data;
};

/// Reads a stream of events in pieces of any size, over several connections: last_id() is for the
/// next one.
class EventReader {
 public:
  /// Receives an event; returns false to end the reading.
  using Sink = std::function<bool(const Event&)>;

  explicit EventReader(Sink sink) : sink_(std::move(sink)) {}

  /// @returns false if the sink ended the stream.
  bool feed(std::string_view piece);

  /// Discards the incomplete event of a connection.
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

/// A record in one line: time, id, size, value, verdict, and labels.
std::string record_line(const JsonValue& record, const Terminal& terminal);

/// One line for an event; empty if another event has the same content (a reject is recorded, too).
std::string format_event(const Event& event, const Terminal& terminal);

/// `{"event":…,"id":…,"data":{…}}`
std::string event_json(const Event& event);

}  // namespace fitgauge::cli
