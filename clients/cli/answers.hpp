#pragma once

#include "cli/context.hpp"

namespace fitgauge::cli {

/// The text of a verdict or of a record: the word, the value, the distance to the nearest limit.
std::string format_verdict(const JsonValue& document, const Terminal& terminal);

/// The text to send for a measured value. @param typed mm, with point or comma. @errors Usage
Outcome<std::string> measured_text(const std::string& typed);

/// Prints the record or verdict of an answer; the exit code is its verdict.
Outcome<ExitCode> show_verdict(const Context& context, const Answer& answer);

/// @errors NoAnswer for another word.
Outcome<ExitCode> verdict_exit_code(std::string_view word);

/// The colour a verdict has everywhere in fitgauge.
Colour verdict_colour(std::string_view word);

/// Returns the text of a limits document. @param terminal that shows it
std::string format_limits(const JsonValue& limits, const Terminal& terminal);

/// The text of a fit document.
std::string format_fit(const JsonValue& fit, const Terminal& terminal);

/// `+21`, `0`, `-7` from the document's number.
std::string signed_text(std::string_view number);

/// A tolerance interval about the zero line, the nominal size (ISO 286-1, 3.2.8).
struct ToleranceZone {
  std::string heading;     ///< `hole H7`
  std::string upper_name;  ///< ES or es
  std::string lower_name;  ///< EI or ei
  Length upper;
  Length lower;
  Colour colour = Colour::Cyan;
};

/// Draws the zones next to each other, larger sizes above, each with its deviations in µm. Every
/// zone is visible, however thin; with block characters the edges are drawn to half a line.
/// @param zero_line label at the end of the zero line: the nominal size
/// @param rows approximate number of lines for the zones
std::string draw_zones(std::span<const ToleranceZone> zones, const std::string& zero_line,
                       const Terminal& terminal, std::size_t rows = 14);

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
