#include "http/engine/exchange.hpp"

namespace fitgauge::http {

namespace {

constexpr std::size_t kKeptCapacity = 512;
constexpr std::string_view kAllMethods = "GET, HEAD, POST, PUT, DELETE, PATCH, OPTIONS";
/// The fields that a page of an allowed origin may send.
constexpr std::string_view kAllowedFields =
    "Authorization, Content-Type, Idempotency-Key, If-Match, If-None-Match, Last-Event-ID, Prefer, "
    "X-API-Key, X-Request-Id";

bool is_request_id(std::string_view text) {
  return !text.empty() && text.size() <= 64 && std::ranges::all_of(text, [](char c) {
    return is_ascii_alphanumeric(c) || c == '.' || c == '_' || c == '-';
  });
}

using HexPair = std::array<char, 2>;
constexpr auto kHexPairs = [] {
  constexpr std::string_view kDigits = "0123456789abcdef";
  std::array<HexPair, 256> pairs{};
  for (std::size_t i = 0; i < pairs.size(); ++i) pairs[i] = {kDigits[i / 16], kDigits[i % 16]};
  return pairs;
}();

Response with_allow(Response response, std::string allow) {
  response.prepared = nullptr;
  return std::move(response).with("Allow", std::move(allow));
}

}  // namespace

void Exchange::clear() {
  head_ = nullptr;
  request_.route_ = nullptr;
  request_.head_ = nullptr;
  request_.body_ = request_.path_ = request_.query_ = request_.response_type_ = {};
  request_.given_id_ = request_.allowed_origin_ = {};
  codings_ = {};
  request_.media_type_.clear();
  request_.arguments_.clear();
  request_.caller_.reset();
  decoded_.clear();
  if (decoded_.capacity() > kKeptCapacity) decoded_ = {};
  wants_continue_ = gzip_ = false;
}

void Exchange::take(RequestHead& head, std::uint64_t id) {
  head_ = &head;
  request_.head_ = &head;
  request_.peer_ = &peer_;
  request_.id_ = id;
  for (std::size_t i = request_.own_id_.size(); i > 0; id >>= 8)
    std::memcpy(&request_.own_id_[i -= 2], &kHexPairs[id & 0xff], 2);
  request_.method_ = method_named(head.method);
  if (head.has_request_id) {
    const std::string_view given = head.find("X-Request-Id").value_or("");
    if (is_request_id(given)) request_.given_id_ = given;
  }
  if (head.has_origin && !allowed_origins_.empty()) {
    const auto origin = head.find_list("Origin");
    const auto allowed = std::ranges::find(allowed_origins_, origin);
    if (allowed != allowed_origins_.end()) request_.allowed_origin_ = *allowed;
  }
  if (head.has_accept_encoding && !head.http_1_0)
    codings_ = accepted_codings(head.find_list("Accept-Encoding").value_or(""));
}

std::optional<Response> Exchange::open(RequestHead& head, std::uint64_t id) {
  take(head, id);
  try {
    return dispatch();
  } catch (const std::exception& error) {
    return internal_error(error.what());
  }
}

std::optional<Response> Exchange::dispatch() {
  if (head_->target == "*" && request_.method_ == Method::Options)
    return Response(204).with("Allow", std::string(kAllMethods));
  if (auto refusal = take_target()) return error_response(*refusal);

  decoded_.reserve(head_->target.size());
  PathSegments segments;
  if (!split_path(request_.path_, decoded_, segments)) {
    return error_response(
        {400, ErrorCode::PathMalformed,
         "path must be UTF-8 without NUL, and have % only before two hexadecimal digits"});
  }
  const Resource* const resource = routes_.tree().find(segments);
  if (resource == nullptr) {
    return error_response(
        {404, ErrorCode::NotFound, "path not found: /openapi.json lists the paths"});
  }
  const std::int16_t index = resource->route(request_.method_);
  if (index == Resource::kNone) {
    std::string allow = resource->allow();
    if (request_.method_ == Method::Options) return answer_options(std::move(allow));
    Response refused = error_response(
        {405, ErrorCode::MethodNotAllowed, fmt::format("method must be one of: {}", allow)});
    return with_allow(std::move(refused), std::move(allow));
  }
  const auto route_index = static_cast<std::size_t>(index);
  request_.route_ = &routes_.routes()[route_index];
  if (hooks_.guard) {
    auto answer = hooks_.guard(request_, *request_.route_);
    if (!answer) return error_response(answer.error());
    if (*answer) return *std::move(answer);
  }
  if (const auto error = take_arguments(segments, routes_.tree().plan(route_index))) {
    const bool is_readable = error->code == ErrorCode::LengthTooFine ||
                             error->code == ErrorCode::LengthOutOfRange ||
                             error->code == ErrorCode::SizeOutOfRange;
    return error_response(*error, is_readable ? 422 : 400);
  }
  return check_head();
}

/// A preflight (OPTIONS) asks whether a page may send its next request; it has no key.
Response Exchange::answer_options(std::string allow) const {
  Response response(204);
  if (!request_.allowed_origin().empty() && request_.header("Access-Control-Request-Method")) {
    response.with("Access-Control-Allow-Methods", allow)
        .with("Access-Control-Allow-Headers", std::string(kAllowedFields))
        .with("Access-Control-Max-Age", "600");
  }
  return std::move(response.with("Allow", std::move(allow)));
}

std::optional<Refusal> Exchange::take_target() {
  std::string_view target = head_->target;
  if (!target.starts_with('/')) {  // absolute-form: its authority replaces the Host field
    const std::size_t scheme = target.find("://");
    if (scheme == std::string_view::npos || (!ascii_iequals(target.substr(0, scheme), "http") &&
                                             !ascii_iequals(target.substr(0, scheme), "https"))) {
      return Refusal{400, ErrorCode::RequestMalformed,
                     "request target must be a path that begins with / or a URI"};
    }
    target.remove_prefix(scheme + 3);
    const std::string_view authority = target.substr(0, target.find_first_of("/?"));
    if (!is_authority(authority))
      return Refusal{400, ErrorCode::RequestMalformed, "request target must name a host"};
    head_->host = authority;
    target.remove_prefix(authority.size());
  }
  if (target.find('#') != std::string_view::npos)
    return Refusal{400, ErrorCode::PathMalformed, "request target must not have a fragment (#)"};
  const std::size_t mark = target.find('?');
  request_.path_ = target.substr(0, mark);
  if (request_.path_.empty()) request_.path_ = "/";
  if (mark != std::string_view::npos) request_.query_ = target.substr(mark + 1);
  return std::nullopt;
}

std::optional<Response> Exchange::check_head() {
  if (const auto refusal = negotiate()) return error_response(*refusal);
  if (const auto refusal = check_body()) return error_response(*refusal);
  if (const auto refusal = check_expectation()) return error_response(*refusal);
  return std::nullopt;
}

std::optional<Error> Exchange::take_arguments(const PathSegments& path,
                                              const RouteTree::Plan& plan) {
  request_.arguments_.resize(request_.route_->parameters.size());
  for (const RouteTree::Plan::Capture& capture : plan.captures) {
    request_.arguments_[capture.parameter] = TRY(parse_argument(
        request_.route_->parameters[capture.parameter],
        capture.takes_rest ? path.rest(capture.segment) : path.segment(capture.segment)));
  }
  if (plan.has_query) {
    if (auto error = take_query()) return error;
  }
  if (plan.has_headers) return take_headers();
  return std::nullopt;
}

std::optional<Error> Exchange::take_query() {
  const std::vector<Parameter>& parameters = request_.route_->parameters;
  std::string_view rest = request_.query_;
  const auto decode = [&](std::string_view text) -> std::optional<std::string_view> {
    if (std::ranges::all_of(text, is_plain)) return text;
    const std::size_t start = decoded_.size();
    if (!append_percent_decoded(decoded_, text, true)) return std::nullopt;
    return std::string_view(decoded_).substr(start);
  };
  while (!rest.empty()) {
    const std::string_view pair = take_field(rest, '&');
    if (pair.empty()) continue;
    const std::size_t equals = std::min(pair.find('='), pair.size());
    const auto name = decode(pair.substr(0, equals));
    const auto value = decode(pair.substr(std::min(equals + 1, pair.size())));
    if (!name || !value) {
      return Error{
          ErrorCode::QueryMalformed,
          "query must be UTF-8 without NUL, and have % only before two hexadecimal digits"};
    }
    const auto found = std::ranges::find_if(parameters, [&](const Parameter& parameter) {
      return parameter.place == ParameterPlace::Query && parameter.name == *name;
    });
    if (found == parameters.end()) {
      return Error{ErrorCode::QueryUnknown, fmt::format("unknown parameter {}", *name),
                   std::string(*name)};
    }
    auto& slot = request_.arguments_[static_cast<std::size_t>(found - parameters.begin())];
    if (slot) {
      return Error{ErrorCode::QueryRepeated, fmt::format("parameter {} must be given once", *name),
                   std::string(*name)};
    }
    slot = TRY(parse_argument(*found, *value));
  }
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    if (parameters[i].place == ParameterPlace::Query && parameters[i].required &&
        !request_.arguments_[i]) {
      return Error{ErrorCode::QueryMissing,
                   fmt::format("parameter {} is required", parameters[i].name), parameters[i].name};
    }
  }
  return std::nullopt;
}

std::optional<Error> Exchange::take_headers() {
  const std::vector<Parameter>& parameters = request_.route_->parameters;
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    const Parameter& parameter = parameters[i];
    if (parameter.place != ParameterPlace::Header) continue;
    const auto value = head_->find(parameter.name);
    if (!value) {
      if (!parameter.required) continue;
      return Error{ErrorCode::RequestMalformed,
                   fmt::format("header field {} is required", parameter.name), parameter.name};
    }
    request_.arguments_[i] = TRY(parse_argument(parameter, *value));
  }
  return std::nullopt;
}

bool Exchange::names_form() const {
  const auto& parameters = request_.route_->parameters;
  for (std::size_t i = 0; i < parameters.size(); ++i)
    if (parameters[i].replaces_accept && request_.arguments_[i]) return true;
  return false;
}

std::optional<Refusal> Exchange::negotiate() {
  const std::vector<std::string>& types = request_.route_->response_types;
  if (codings_.gzip == 0 && codings_.identity == 0) {
    return Refusal{406, ErrorCode::NotAcceptable,
                   "Accept-Encoding must allow gzip or identity; got neither"};
  }
  if (types.empty()) return std::nullopt;
  request_.response_type_ = types.front();
  if (!head_->has_accept) return std::nullopt;
  const std::string accept = head_->find_list("Accept").value_or("");
  if (trim(accept).empty()) return std::nullopt;
  const std::string* const best = preferred_type(accept, types);
  if (best == nullptr && names_form()) return std::nullopt;
  if (best == nullptr) {
    return Refusal{406, ErrorCode::NotAcceptable,
                   fmt::format("Accept allows no type of this response: ask for one of: {}",
                               fmt::join(types, ", "))};
  }
  request_.response_type_ = *best;
  return std::nullopt;
}

std::optional<Refusal> Exchange::check_expectation() {
  if (!head_->has_expect || head_->http_1_0) return std::nullopt;
  const std::string expect = head_->find_list("Expect").value_or("");
  const auto expectations = list_items(expect);
  for (const std::string_view expectation : expectations) {
    if (!ascii_iequals(expectation, "100-continue"))
      return Refusal{417, ErrorCode::ExpectationFailed, "Expect must be 100-continue"};
  }
  wants_continue_ = !expectations.empty() && head_->has_body();
  return std::nullopt;
}

std::optional<Refusal> Exchange::check_body() {
  const BodyRules& rules = request_.route_->body;
  if (rules.use == BodyUse::None && !head_->has_body()) return std::nullopt;
  if (rules.use == BodyUse::Required && !head_->chunked && !head_->content_length) {
    return Refusal{411, ErrorCode::LengthRequired,
                   "a body is required: send Content-Length or Transfer-Encoding: chunked"};
  }
  const auto content_type = head_->find("Content-Type");
  const auto media = content_type ? parse_media_type(*content_type) : std::nullopt;
  if (media) request_.media_type_ = media->type;
  const bool is_expected =
      rules.use == BodyUse::Required || (rules.use == BodyUse::Optional && head_->has_body());
  if (is_expected && !rules.media_types.empty()) {
    const auto& types = rules.media_types;
    const bool is_known = media && std::ranges::find(types, media->type) != types.end();
    if (!is_known) {
      return Refusal{415, ErrorCode::MediaTypeUnsupported,
                     fmt::format("Content-Type must be {}{}", types.size() > 1 ? "one of: " : "",
                                 fmt::join(types, ", "))};
    }
    if (!media->charset.empty() && media->charset != "utf-8")
      return Refusal{415, ErrorCode::MediaTypeUnsupported, "charset of Content-Type must be UTF-8"};
  }
  if (!head_->has_body()) return std::nullopt;
  const std::string encoding = head_->find_list("Content-Encoding").value_or("");
  const auto codings = list_items(encoding);
  const std::string_view coding = codings.empty() ? "identity" : codings.front();
  gzip_ = ascii_iequals(coding, "gzip") || ascii_iequals(coding, "x-gzip");
  if (codings.size() > 1 || (!gzip_ && !ascii_iequals(coding, "identity")))
    return Refusal{415, ErrorCode::EncodingUnsupported, "Content-Encoding must be gzip"};
  if (head_->content_length.value_or(0) > rules.limit_of(request_.media_type_))
    return body_too_large();
  return std::nullopt;
}

Refusal Exchange::body_too_large() const {
  const BodyRules& rules = request_.route_->body;
  return {413, ErrorCode::BodyTooLarge,
          fmt::format("the body must have at most {} bytes{}{}{}",
                      rules.limit_of(request_.media_type_), gzip_ ? " after decompression" : "",
                      rules.when_too_large.empty() ? "" : ": ", rules.when_too_large)};
}

BodyReader::Plan Exchange::body_plan() const {
  const BodyRules& rules = request_.route_->body;
  return {.limit = rules.limit_of(request_.media_type_),
          .gzip = gzip_,
          .discard = rules.use == BodyUse::None,
          .spools = rules.spools};
}

AnswerForm Exchange::form(bool keep_alive) const {
  AnswerForm form{.head_only = request_.method_ == Method::Head,
                  .http_1_0 = head_ != nullptr && head_->http_1_0,
                  .keep_alive = keep_alive,
                  .codings = codings_,
                  .request_id = request_.id_text(),
                  .allowed_origin = request_.allowed_origin(),
                  .varies_by_origin = !allowed_origins_.empty()};
  if (head_ != nullptr && head_->has_if_none_match &&
      (request_.method_ == Method::Get || request_.method_ == Method::Head)) {
    form.conditional = true;
    form.if_none_match = head_->find_list("If-None-Match").value_or("");
  }
  return form;
}

bool Exchange::has_to_wait() const {
  const Handler& handler = request_.route_->handler;
  const auto* const either = std::get_if<EitherHandler>(&handler);
  return either == nullptr ? std::holds_alternative<AsyncHandler>(handler)
                           : either->has_to_wait(request_);
}

Result<Response> Exchange::run_now() {
  const Handler& handler = request_.route_->handler;
  const auto* const either = std::get_if<EitherHandler>(&handler);
  try {
    return (either == nullptr ? std::get<SyncHandler>(handler) : either->now)(request_);
  } catch (const std::exception& error) {
    return internal_error(error.what());
  }
}

void Exchange::run_later(Responder responder) {
  const Handler& handler = request_.route_->handler;
  const auto* const either = std::get_if<EitherHandler>(&handler);
  try {
    (either != nullptr ? either->later : std::get<AsyncHandler>(handler))(request_,
                                                                          std::move(responder));
  } catch (const std::exception& error) {  // its Responder, destroyed, has answered 500
    if (hooks_.handler_threw) hooks_.handler_threw(request_, error.what());
  }
}

Response Exchange::error_response(const Error& error, std::optional<int> status) const {
  if (hooks_.format_error) {
    try {
      return hooks_.format_error(error, status, request_);
    } catch (const std::exception& failure) {
      if (hooks_.handler_threw) hooks_.handler_threw(request_, failure.what());
    }
  }
  return {status.value_or(500), "text/plain; charset=utf-8",
          fmt::format("{}: {}\n", id(error.code), error.message)};
}

}  // namespace fitgauge::http
