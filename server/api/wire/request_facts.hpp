#pragma once

#include "api/services.hpp"
#include "service/measurements/measurement_service.hpp"

namespace fitgauge::api {

/// The sender of a request, from the guard: the name of an API key, or empty.
struct Caller {
  std::string name;
  std::int64_t key = 0;  ///< of app::KeyService
};

/// The value of `Prefer: return=` (RFC 7240).
enum class Preference { None, Minimal, Representation };
Preference preference_of(const Request& request);
/// Whether `Prefer: respond-async` asks for an answer before the work is done.
bool prefers_async(const Request& request);

/// Returns whether CSV is requested instead of JSON, by `format` or, without it, by Accept.
bool wants_csv(const Request& request);
/// The query parameter `format` of a route, which replaces Accept.
Parameter format_of(std::vector<std::string> forms);
Parameter csv_or_json();

/// The Idempotency-Key without its quotes: quoted and bare are one key.
/// @errors IdempotencyKeyInvalid unless it has 1 to 255 printable ASCII characters.
Result<std::optional<std::string>> idempotency_key(const Request& request);

/// Preconditions of a request on the current representation (RFC 9110,
/// section 13): evaluated in the transaction that does it.
struct Preconditions {
  std::optional<std::string> if_match{};
  std::optional<std::string> if_none_match{};

  bool any() const { return if_match || if_none_match; }
  /// @param etag of the current representation; none if there is none.
  bool hold(std::optional<std::string_view> etag) const;
};
Preconditions preconditions_of(const Request& request);

/// Strong: texts that differ in a byte have different tags.
std::string etag_of_text(std::string_view text);
/// A response with the tag of its text. @errors PreconditionFailed: If-Match names another state.
Result<Response> with_tag(Response response, const std::optional<std::string>& if_match);
/// Decides from the current text, if there is one; empty if the request has no condition.
using TextPrecondition = std::function<bool(std::optional<std::string_view> text)>;
TextPrecondition text_precondition_of(const Request& request);

/// Returns the Link of a page that is not the last (RFC 8288): the same filters with this cursor.
std::string next_link(const Request& request, std::string_view cursor);

/// Parameter of a path, and the preconditions that its route supports.
std::vector<Parameter> with_preconditions(Parameter path);

/// The name of the key that sent the request, if one did.
std::optional<std::string_view> caller_name(const Request& request);
/// Returns the name of the key as an owned text.
std::optional<std::string> caller_text(const Request& request);

/// Everything one POST needs until it is answered. The request lives as long as its responder.
struct Posting {
  const Services& services;
  const Request& request;
  Responder responder;
  std::optional<app::IdempotencyScope> scope{};  ///< of its Idempotency-Key
};
using SharedPosting = std::shared_ptr<Posting>;

/// Header of a route that answers a repeated request like the first one.
Parameter idempotency_parameter();

/// @returns null when the Idempotency-Key is no key: that has been answered.
SharedPosting begin_posting(const Services& services, const Request& request, Responder responder);

Response response_of(app::Answer answer);
/// Responds to a repeat with the stored response.
Response replayed(app::Answer kept);

}  // namespace fitgauge::api
