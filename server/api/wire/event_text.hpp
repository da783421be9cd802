#pragma once

#include "api/resources.hpp"

namespace fitgauge::api {

// Server-Sent Events (WHATWG HTML, 9.2), one form for all event streams.

inline constexpr std::string_view kEventStreamType = "text/event-stream";

/// A comment line, so that both ends detect a lost connection.
inline constexpr std::string_view kEventHeartbeat = ":\n\n";

/// @param data one line of JSON.
inline void append_event(std::string& out, std::string_view type, std::string_view id,
                         std::string_view data) {
  out.append("event: ").append(type).append("\nid: ").append(id);
  out.append("\ndata: ").append(data).append("\n\n");
}

/// Appends no event, but the id that a reader names if it reconnects before the first event.
inline void append_event_id(std::string& out, std::string_view id) {
  out.append("id: ").append(id).append("\n\n");
}

/// A response for events: never cached, never delayed by a proxy.
inline Response event_response(http::Body events) {
  return Response(200, std::string(kEventStreamType), std::move(events))
      .with("Cache-Control", "no-store")
      .with("X-Accel-Buffering", "no");
}
inline Response event_response(std::shared_ptr<http::BodyStream> source) {
  return event_response(http::StreamedBody{
      .source = std::move(source), .heartbeat = std::string(kEventHeartbeat), .is_endless = true});
}

/// Adds the parameters by which a reader names its last event when it reconnects.
inline void add_last_event_id(std::vector<Parameter>& parameters) {
  parameters.push_back(
      query("last_event_id", "The id of the last event, for clients that cannot set the header"));
  parameters.push_back({.name = "Last-Event-ID",
                        .place = http::ParameterPlace::Header,
                        .description = "The id of the last event that was read"});
}

/// Returns the id of the last event, if given. The header of a browser overrides the query.
inline std::optional<std::string_view> last_event_id(const Request& request) {
  auto named = request.text("Last-Event-ID");
  if (!named) named = request.text("last_event_id");
  if (named && named->empty()) return std::nullopt;
  return named;
}

}  // namespace fitgauge::api
