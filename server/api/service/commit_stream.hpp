#pragma once

#include "http/response.hpp"
#include "service/events/event_service.hpp"

namespace fitgauge::api {

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
