#pragma once

#include <functional>
#include <string>
#include <string_view>

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

}  // namespace fitgauge::cli
