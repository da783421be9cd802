#pragma once

#include <chrono>
#include <cstddef>
#include <memory>
#include <string>
#include <variant>
#include <vector>

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
  /// The body has no end that a reader waits for: it ends regularly where ServerHooks::may_continue
  /// says so. Any other breaks off, so that nobody takes it for whole.
  bool is_endless = false;
  std::size_t held = 0;  ///< bytes that only the source keeps until the body has left
};

/// Bytes of its own, immutable bytes shared with others, or a stream.
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

/// The answer's bytes, made once, to be sent any number of times from any thread: handlers keep it
/// in their cache and return it. The engine puts in the Date and handles HEAD, If-None-Match and
/// closing connections. The gzip form is made when the first client asks for it.
/// @param packed the body in gzip, where there is one already.
/// @pre the body is not a stream.
std::shared_ptr<const PreparedResponse> prepare(const Response& response, std::string packed = {});

/// Bytes that a prepared answer takes, for those who keep many.
std::size_t size_in_memory(const PreparedResponse& answer);

}  // namespace fitgauge::http
