#pragma once

namespace fitgauge::http {

class BodyStream;
class PreparedResponse;

/// Whether the service has failed, not the request (RFC 9110 section 15.6).
constexpr bool is_server_error(long status) { return status >= 500; }

struct Header {
  std::string name;
  std::string value;

  friend bool operator==(const Header&, const Header&) = default;
};

/// A body that is produced while it is sent.
struct StreamedBody {
  std::shared_ptr<BodyStream> source;
  /// Bytes to send when the source has been silent for `heartbeat_interval`; empty: none.
  std::string heartbeat{};
  std::chrono::milliseconds heartbeat_interval = std::chrono::seconds(15);
  /// true for a body without an end: it ends regularly if ServerHooks::may_continue returns false.
  /// Other bodies break off, so that no client regards them as complete.
  bool is_endless = false;
  std::size_t held = 0;  ///< bytes that only the source keeps until the body has left
};

/// Owned bytes, immutable shared bytes, or a stream.
using Body = std::variant<std::string, std::shared_ptr<const std::string>, StreamedBody>;

/// The response of a handler. The engine adds Date, Content-Length or Transfer-Encoding,
/// Connection, ETag, X-Request-Id, X-Content-Type-Options, Cross-Origin-Resource-Policy and the
/// fields of CORS. It omits the body for HEAD. It answers 304 itself if `etag` is set and
/// If-None-Match of a GET or HEAD names it. Clients that prefer gzip get bodies of more than 1 KiB
/// (is_packable) packed, with an `etag` for that form.
struct Response {
  int status = 200;
  std::string content_type{};  ///< empty: no Content-Type field
  Body body{};
  std::vector<Header> headers{};
  std::string etag{};  ///< with its quotes: `"abc"` or `W/"abc"`
  /// If set, these bytes are the response and every other member is ignored.
  std::shared_ptr<const PreparedResponse> prepared{};

  Response() = default;
  Response(int code, std::string type, Body content)
      : status(code), content_type(std::move(type)), body(std::move(content)) {}
  /// A response without a body.
  explicit Response(int code) : status(code) {}
  /// A frequent response, serialised once and shared.
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

/// Receives the next piece of a BodyStream: exactly one call, from any thread. A sink that is
/// dropped without a call, or fails, closes the connection, so that the client detects a truncated
/// body.
class ChunkSink {
 public:
  explicit ChunkSink(std::shared_ptr<Connection> connection) : connection_(std::move(connection)) {}
  ChunkSink(ChunkSink&&) noexcept = default;
  ChunkSink& operator=(ChunkSink&& other) noexcept {
    connection_.swap(other.connection_);
    return *this;
  }
  ~ChunkSink();

  /// Sends `bytes` unless empty, and asks the stream for the next piece when they have left.
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

  /// Called on the I/O thread after each heartbeat_interval while a sink waits: must not block.
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
  explicit Responder(std::shared_ptr<Connection> connection) : connection_(std::move(connection)) {}
  Responder(Responder&&) noexcept = default;
  Responder& operator=(Responder&& other) noexcept {
    connection_.swap(other.connection_);
    return *this;
  }
  ~Responder();

  void answer(Response response);

  /// Answers with the error formatter's document.
  void fail(Error error);

 private:
  std::shared_ptr<Connection> connection_;
};

class IoThread;

/// Collects the responses of its thread for I/O threads, and posts them at the end, to each thread
/// at once. Use it in a thread that answers many requests together, because each single response
/// would wake the I/O thread. At most one on a thread. Responders used with
/// it are released when it ends.
class AnswerBatch {
 public:
  AnswerBatch();
  AnswerBatch& operator=(AnswerBatch&&) = delete;  // neither copied nor moved
  ~AnswerBatch();

 private:
  friend class Connection;
  void add(IoThread& thread, std::function<void()> function);

  /// As few as there are I/O threads.
  std::vector<std::pair<IoThread*, std::vector<std::function<void()>>>> threads_;
};

}  // namespace fitgauge::http
