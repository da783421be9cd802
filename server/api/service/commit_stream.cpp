#include "api/service/commit_stream.hpp"

namespace fitgauge::api {

void CommitStream::next(http::ChunkSink sink) {
  if (!std::exchange(begun_, true)) events_.add(shared_from_this());
  {
    const std::lock_guard lock(mutex_);
    sink_ = std::move(sink);
    reading_ = std::exchange(missed_, false);
    if (!reading_) return;
  }
  read();
}

void CommitStream::committed() {
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

void CommitStream::cancelled() {
  events_.remove(shared_from_this());
  const std::lock_guard lock(mutex_);
  sink_.reset();
}

void CommitStream::took(std::string piece, bool more) {
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

void CommitStream::fail() {
  std::optional<http::ChunkSink> sink;
  {
    const std::lock_guard lock(mutex_);
    sink = std::exchange(sink_, std::nullopt);
    reading_ = false;
  }
  if (sink) sink->fail();
}

}  // namespace fitgauge::api
