#pragma once

#include <string>
#include <string_view>

namespace fitgauge::api {

// The text of Server-Sent Events (WHATWG HTML, 9.2).

inline constexpr std::string_view kEventStreamType = "text/event-stream";

/// A comment line, so that both ends notice a connection that is gone.
inline constexpr std::string_view kEventHeartbeat = ":\n\n";

/// @param data one line of JSON.
inline void append_event(std::string& out, std::string_view type, std::string_view id,
                         std::string_view data) {
  out.append("event: ").append(type).append("\nid: ").append(id);
  out.append("\ndata: ").append(data).append("\n\n");
}

/// No event, but the id a reader names when it comes back before there was one.
inline void append_event_id(std::string& out, std::string_view id) {
  out.append("id: ").append(id).append("\n\n");
}

}  // namespace fitgauge::api
