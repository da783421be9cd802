#pragma once

#include "http/engine/answer.hpp"
#include "http/engine/body_reader.hpp"
#include "http/engine/request_head.hpp"
#include "http/engine/route_tree.hpp"
#include "http/server.hpp"

namespace fitgauge::http {

/// One request from its head to its handler: finds the route, asks the guard, checks parameters,
/// media types and coding, and makes the answers of refusals. Knows nothing of sockets. One object
/// serves the requests of a connection one after the other.
class Exchange {
 public:
  Exchange(const RouteTable& routes, const ServerHooks& hooks,
           const std::vector<std::string>& allowed_origins, const Peer& peer)
      : routes_(routes), hooks_(hooks), allowed_origins_(allowed_origins), peer_(peer) {}

  /// Reads the head, which must stay in place until the next open().
  /// @returns the response if it is known; otherwise read the body, then call run().
  std::optional<Response> open(RequestHead& head, std::uint64_t id);

  /// Returns the response to a refused request, as far as it was read.
  Response refuse(RequestHead& head, std::uint64_t id, const Refusal& refusal) {
    if (head_ == nullptr) take(head, id);
    return error_response(refusal);
  }

  BodyReader::Plan body_plan() const;
  Refusal body_too_large() const;
  /// The client waits for 100 (Continue) before it sends the body.
  bool wants_continue() const { return wants_continue_; }
  /// @param body followed by Request::kBodyPadding bytes, unless it is empty.
  void set_body(const FileText& body) {
    static constexpr char kNothing[Request::kBodyPadding]{};
    request_.body_ = body.text.empty() ? FileText(std::string_view(kNothing, 0)) : body;
  }

  bool is_synchronous() const {
    return std::holds_alternative<SyncHandler>(request_.route()->handler);
  }
  /// The result of a synchronous handler, or the answer to its exception.
  Result<Response> run();
  void run(Responder responder);

  AnswerForm form(bool keep_alive) const;
  Response error_response(const Error& error, std::optional<int> status = std::nullopt) const;
  /// The answer when an asynchronous handler dropped its Responder.
  Response unanswered() const { return internal_error("the handler dropped its Responder"); }
  Response error_response(const Refusal& refusal) const {
    Response response = error_response(Error{refusal.code, refusal.message}, refusal.status);
    if (refusal.code == ErrorCode::EncodingUnsupported) response.with("Accept-Encoding", "gzip");
    return response;
  }

  const Request& request() const { return request_; }
  void clear();

 private:
  void take(RequestHead& head, std::uint64_t id);
  Response internal_error(std::string_view what) const {
    if (hooks_.handler_threw) hooks_.handler_threw(request_, what);
    return error_response({500, ErrorCode::Internal,
                           fmt::format("the request failed; its id is {}", request_.id_text())});
  }
  std::optional<Response> dispatch();
  Response answer_options(std::string allow) const;
  std::optional<Refusal> take_target();
  std::optional<Response> check_head();
  std::optional<Error> take_arguments(const PathSegments& path, const RouteTree::Plan& plan);
  std::optional<Error> take_query();
  std::optional<Error> take_headers();
  std::optional<Refusal> negotiate();
  std::optional<Refusal> check_expectation();
  std::optional<Refusal> check_body();

  const RouteTable& routes_;
  const ServerHooks& hooks_;
  const std::vector<std::string>& allowed_origins_;
  const Peer& peer_;
  RequestHead* head_ = nullptr;
  Request request_;
  std::string decoded_;  ///< decoded path and query; does not move
  bool wants_continue_ = false;
  bool gzip_ = false;  ///< the request's body
  Codings codings_{};  ///< of its answer
};

}  // namespace fitgauge::http
