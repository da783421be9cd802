#pragma once

#include <memory>
#include <string>

namespace fitgauge::http {

class Connection;

/// Where a BodyStream puts its next piece: exactly one call, from any thread. Dropped without a
/// call, or failed, the connection is closed, so that the client sees a truncated body as such.
class ChunkSink {
 public:
  explicit ChunkSink(std::shared_ptr<Connection> connection);
  ChunkSink(ChunkSink&&) noexcept;
  ChunkSink& operator=(ChunkSink&&) noexcept;
  ~ChunkSink();

  /// Sends `bytes` (an empty piece is skipped) and asks the stream for the next piece once they
  /// have left for the socket.
  void put(std::string bytes);

  /// Sends `bytes` and ends the body.
  void finish(std::string bytes = {});

  /// Ends the connection without ending the body.
  void fail();

 private:
  std::shared_ptr<Connection> connection_;
};

/// A body pulled piece by piece: the connection asks for the next one when the one before has left,
/// so a slow reader slows its own producer and nobody else. A reader that takes nothing for the
/// server's write timeout is dropped.
class BodyStream {
 public:
  BodyStream() = default;
  BodyStream(const BodyStream&) = delete;
  BodyStream& operator=(const BodyStream&) = delete;
  virtual ~BodyStream() = default;

  /// Called on an I/O thread: must not block. Answer now, or keep the sink and answer from another
  /// thread. Pieces of 16 to 64 KiB serve best.
  virtual void next(ChunkSink sink) = 0;

  /// Called on the I/O thread after each StreamedBody::heartbeat_interval in which the sink of
  /// next() was kept: must not block.
  virtual void idle() {}

  /// Called on the I/O thread when the connection has gone: next() is not called again and what a
  /// kept sink receives is dropped. A stream that keeps its sink drops it here.
  virtual void cancelled() {}
};

}  // namespace fitgauge::http
