#pragma once

#include "api/resources.hpp"
#include "service/events/event_service.hpp"

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

/// Streams the news after each commit to one reader. Owns at most one piece, so a slow reader needs
/// no memory and falls behind; the connection drops a reader that reads nothing.
class CommitStream : public http::BodyStream,
                     public app::CommitListener,
                     public std::enable_shared_from_this<CommitStream> {
 public:
  explicit CommitStream(app::EventService& events) : events_(events) {}

  void next(http::ChunkSink sink) final {
    if (!std::exchange(begun_, true)) events_.add(shared_from_this());
    {
      const std::lock_guard lock(mutex_);
      sink_ = std::move(sink);
      reading_ = std::exchange(missed_, false);
      if (!reading_) return;
    }
    read();
  }
  void cancelled() final {
    events_.remove(shared_from_this());
    const std::lock_guard lock(mutex_);
    sink_.reset();
  }
  void committed() final {
    {
      const std::lock_guard lock(mutex_);
      if (reading_ || !sink_) {
        missed_ = true;
        return;
      }
      reading_ = true;
    }
    read();
  }

 protected:
  /// Reads once, and ends with took() or fail() on any thread.
  virtual void read() = 0;
  /// @param piece empty: nothing is sent yet. @param more than was read is there already
  void took(std::string piece, bool more = false) {
    std::optional<http::ChunkSink> sink;
    {
      const std::lock_guard lock(mutex_);
      missed_ = missed_ || more;
      reading_ = piece.empty() && missed_ && sink_;
      if (reading_) missed_ = false;
      if (!piece.empty()) sink = std::exchange(sink_, std::nullopt);
      if (!reading_ && !sink) return;
    }
    if (sink) {
      sink->put(std::move(piece));
    } else {
      read();
    }
  }
  void fail() {
    std::optional<http::ChunkSink> sink;
    {
      const std::lock_guard lock(mutex_);
      sink = std::exchange(sink_, std::nullopt);
      reading_ = false;
    }
    if (sink) sink->fail();
  }

  app::EventService& events_;

 private:
  bool begun_ = false;  // of the connection's thread
  std::mutex mutex_;
  std::optional<http::ChunkSink> sink_;  ///< receiver of the next piece; none while one is sent
  bool reading_ = false;
  bool missed_ = true;  ///< there may be more to read: a commit came during the read
};

}  // namespace fitgauge::api
