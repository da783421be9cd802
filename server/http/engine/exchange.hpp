#pragma once

#include "http/engine/answer.hpp"
#include "http/engine/body_reader.hpp"
#include "http/engine/request_head.hpp"
#include "http/server.hpp"

namespace fitgauge::http {

inline constexpr std::size_t kMaxSegments = 16;

/// A request's path, split at its slashes and then decoded.
class PathSegments {
 public:
  std::size_t count() const { return count_; }  ///< at most kMaxSegments
  /// There are more, which only a `{rest*}` reaches.
  bool is_longer() const { return is_longer_; }

  std::string_view segment(std::size_t index) const {
    return {path_.data() + begins_[index], begins_[index + 1] - begins_[index] - 1};
  }
  /// Everything from segment `index` on.
  std::string_view rest(std::size_t index) const {
    return {path_.data() + begins_[index], path_.size() - begins_[index]};
  }

 private:
  friend bool split_path(std::string_view path, std::string& decoded, PathSegments& out);

  /// A segment has ended; the next one would begin at `begin`.
  void end_segment(std::size_t begin) {
    if (count_ == kMaxSegments) {
      is_longer_ = true;
    } else {
      begins_[++count_] = static_cast<std::uint32_t>(begin);
    }
  }

  std::string_view path_;  ///< after its first slash, decoded
  std::array<std::uint32_t, kMaxSegments + 1> begins_{};
  std::size_t count_ = 0;
  bool is_longer_ = false;
};

/// @param decoded receives the path if it differs from the sent one; its capacity must have room
/// for path.size() more bytes, so that it does not move. `out` views it or `path`.
/// @returns false if the path does not begin with a slash or cannot be decoded.
bool split_path(std::string_view path, std::string& decoded, PathSegments& out);

/// The operations on one path shape.
struct Resource {
  static constexpr std::int16_t kNone = -1;

  std::array<std::int16_t, 7> routes{kNone, kNone, kNone, kNone, kNone, kNone, kNone};

  /// The index of the route for a method, GET's for HEAD, or kNone.
  std::int16_t route(Method method) const;
  /// `GET, HEAD, OPTIONS`
  std::string allow() const;
};

/// The routes as a tree of path segments; a literal goes before a parameter, a parameter before a
/// rest. Immutable after construction.
class RouteTree {
 public:
  /// Additional facts of a route for dispatch.
  struct Plan {
    struct Capture {
      std::size_t parameter = 0;
      std::size_t segment = 0;
      bool takes_rest = false;
    };
    std::vector<Capture> captures;  ///< in pattern order
    bool has_query = false;
    bool has_headers = false;
  };

  /// Adds the path parameters that `routes` leave out.
  explicit RouteTree(std::vector<Route>& routes);

  /// The resource at a path, or null.
  const Resource* find(const PathSegments& path) const { return descend(root_, path, 0); }
  const Plan& plan(std::size_t route) const { return plans_[route]; }

 private:
  struct Node {
    std::vector<std::pair<std::string, std::unique_ptr<Node>>> literals;
    std::unique_ptr<Node> parameter;
    std::unique_ptr<Node> rest;
    Resource resource;
    bool is_resource = false;
  };

  void add(Route& route, std::int16_t index);
  static const Resource* descend(const Node& node, const PathSegments& path, std::size_t depth);

  Node root_;
  std::vector<Plan> plans_;
};

/// Reads the decoded text of a parameter as its type; the value may view `text`.
/// @errors PathMalformed, QueryInvalid or RequestMalformed by the parameter's place, with its name
///   and accepted values; LengthMalformed, LengthTooFine, LengthOutOfRange for lengths.
Result<ArgumentValue> parse_argument(const Parameter& parameter, std::string_view text);

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

  /// Whether the request's handler answers later: call run_later(), otherwise run_now().
  bool has_to_wait() const;
  /// The handler's result, or the answer to its exception.
  Result<Response> run_now();
  void run_later(Responder responder);

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
  /// Returns whether an argument of the request replaces its Accept.
  bool names_form() const;
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
