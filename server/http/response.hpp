#pragma once

#include <chrono>
#include <cstddef>
#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "base/result.hpp"

namespace fitgauge::http {

class BodyStream;
class PreparedResponse;

struct Header {
  std::string name;
  std::string value;

  friend bool operator==(const Header&, const Header&) = default;
};

/// A body that is produced while it is sent.
struct StreamedBody {
  std::shared_ptr<BodyStream> source;
  /// Sent whenever the source has been silent for `heartbeat_interval`; empty for none.
  std::string heartbeat{};
  std::chrono::milliseconds heartbeat_interval = std::chrono::seconds(15);
  /// A body without an end: it ends regularly if ServerHooks::may_continue returns false. Any other
  /// body breaks off, so that no client regards it as complete.
  bool is_endless = false;
  std::size_t held = 0;  ///< bytes that only the source keeps until the body has left
};

/// Owned bytes, immutable shared bytes, or a stream.
using Body = std::variant<std::string, std::shared_ptr<const std::string>, StreamedBody>;

/// The answer of a handler. The engine adds Date, Content-Length or Transfer-Encoding, Connection,
/// ETag, X-Request-Id, X-Content-Type-Options, Cross-Origin-Resource-Policy and the fields of CORS;
/// it leaves the body out for HEAD, and answers 304 by itself when `etag` is set, the request is
/// GET or HEAD and its If-None-Match names it. It packs bodies of more than 1 KiB (is_packable) for
/// clients that prefer gzip, under an `etag` of their own.
struct Response {
  int status = 200;
  std::string content_type{};  ///< empty: no Content-Type field
  Body body{};
  std::vector<Header> headers{};
  std::string etag{};  ///< with its quotes: `"abc"` or `W/"abc"`
  /// When set, these bytes are the answer and every other member is ignored.
  std::shared_ptr<const PreparedResponse> prepared{};

  Response() = default;
  Response(int code, std::string type, Body content)
      : status(code), content_type(std::move(type)), body(std::move(content)) {}
  /// No body.
  explicit Response(int code) : status(code) {}
  /// A hot answer, serialised once and shared.
  Response(std::shared_ptr<const PreparedResponse> answer)  // NOLINT(google-explicit-constructor)
      : prepared(std::move(answer)) {}

  Response& with(std::string name, std::string value) & {
    headers.push_back({std::move(name), std::move(value)});
    return *this;
  }
  Response&& with(std::string name, std::string value) && {
    headers.push_back({std::move(name), std::move(value)});
    return std::move(*this);
  }
};

/// Returns the response's bytes, made once, to be sent any number of times from any thread:
/// handlers keep it in their cache. The engine adds the Date and handles HEAD, If-None-Match and
/// closing connections. The gzip form is made when the first client requests it.
/// @param packed the body in gzip, if it exists.
/// @pre the body is not a stream.
std::shared_ptr<const PreparedResponse> prepare(const Response& response, std::string packed = {});

/// Number of bytes of a prepared response, for caches.
std::size_t size_in_memory(const PreparedResponse& answer);

class Connection;

/// Receives the next piece of a BodyStream: exactly one call, from any thread. If it is dropped
/// without a call, or fails, the connection is closed, so that the client detects a truncated body.
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

/// A body in pieces: the connection requests the next piece when the previous one is sent, so a
/// slow reader slows only its own producer. A reader that reads nothing during the server's write
/// timeout is dropped.
class BodyStream {
 public:
  BodyStream& operator=(BodyStream&&) = delete;  // neither copied nor moved
  virtual ~BodyStream() = default;

  /// Called on an I/O thread: must not block. Answer now, or keep the sink and answer from another
  /// thread. Pieces of 16 to 64 KiB serve best.
  virtual void next(ChunkSink sink) = 0;

  /// Called on the I/O thread after each StreamedBody::heartbeat_interval while the sink of next()
  /// waits: must not block.
  virtual void idle() {}

  /// Called on the I/O thread when the connection is closed: next() is not called again and data
  /// for a waiting sink is dropped. A stream must release its sink here.
  virtual void cancelled() {}
};

/// The obligation to answer one request: exactly one call, from any thread; the response is posted
/// to the request's I/O thread. Destroyed without a call, it responds 500. The Request stays valid
/// as long as its Responder. A client that has disconnected is not an error.
/// Every Responder must be destroyed before its Server.
class Responder {
 public:
  explicit Responder(std::shared_ptr<Connection> connection);
  Responder(Responder&&) noexcept;
  Responder& operator=(Responder&&) noexcept;
  ~Responder();

  void answer(Response response);

  /// Answers with the error formatter's document.
  void fail(Error error);

 private:
  std::shared_ptr<Connection> connection_;
};

class Posts;

/// Collects what its thread posts to I/O threads, and posts it at the end, to each thread at once.
/// For a thread that answers many requests together: single responses would wake the I/O thread
/// each time. At most one on a thread. Responders used under it count as released when it has
/// ended.
class AnswerBatch {
 public:
  AnswerBatch();
  AnswerBatch& operator=(AnswerBatch&&) = delete;  // neither copied nor moved
  ~AnswerBatch();

 private:
  std::unique_ptr<Posts> posts_;
};

}  // namespace fitgauge::http
