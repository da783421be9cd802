#pragma once

#include "api/services.hpp"

namespace fitgauge::api {

/// As TRY in a function that answers: gives the value of a result, or sends its error and returns.
#define TRY_OR_FAIL(responder, ...)                                  \
  __extension__({                                                    \
    auto tried_ = (__VA_ARGS__);                                     \
    if (!tried_) return (responder).fail(std::move(tried_).error()); \
    *std::move(tried_);                                              \
  })

/// For callbacks, which are copied.
using SharedResponder = std::shared_ptr<Responder>;
inline SharedResponder share(Responder responder) {
  return std::make_shared<Responder>(std::move(responder));
}

/// Responds with a result, or with its error.
inline auto answer_by(SharedResponder shared) {
  return [shared = std::move(shared)](Result<Response> made) {
    made ? shared->answer(*std::move(made)) : shared->fail(made.error());
  };
}

/// Answers with the response that `make` makes from a result.
template <class Make>
auto answer_with(Responder responder, Make make) {
  return [answer = answer_by(share(std::move(responder))), make = std::move(make)](auto found) {
    found ? answer(make(*std::move(found))) : answer(found.error());
  };
}

/// 200 with a JSON text.
inline Result<Response> json_response(Result<std::string> body) {
  return Response(200, "application/json", TRY(std::move(body)));
}

/// Bytes that came from outside, so that a browser does not run them.
inline Response foreign_bytes(std::string content_type, std::string bytes) {
  return Response(200, std::move(content_type), std::move(bytes))
      .with("Content-Security-Policy", "sandbox; default-src 'none'; style-src 'unsafe-inline'");
}

/// The status an error has when a handler returns it (RFC 9110 section 15).
int status_of(ErrorCode code);

/// The problem document (RFC 9457) of an error: type, title, status, detail, instance, code and, if
/// there are several, every bad field with its pointer.
/// @param status of a refusal by the HTTP engine; absent: by the error's code.
Response problem(const Error& error, std::optional<int> status, const Request& request);

}  // namespace fitgauge::api
