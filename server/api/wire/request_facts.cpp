#include "api/wire/request_facts.hpp"

#include "api/resources.hpp"
#include "http/field_list.hpp"

namespace fitgauge::api {
namespace {

using http::list_items;
using http::NameValue;
using http::split_parameter;
using http::take_part;

/// Calls `visit(NameValue)` for each preference, without its parameters (RFC 7240, 2).
template <class Visit>
void for_each_preference(const Request& request, const Visit& visit) {
  const auto header = request.header_list("Prefer");
  if (!header) return;
  for (std::string_view item : list_items(*header)) visit(split_parameter(take_part(item, ';')));
}

}  // namespace

Preference preference_of(const Request& request) {
  Preference found = Preference::None;
  for_each_preference(request, [&](const NameValue& preference) {
    // The first of several counts.
    if (found != Preference::None || !ascii_iequals(preference.name, "return")) return;
    if (preference.value == "minimal") found = Preference::Minimal;
    if (preference.value == "representation") found = Preference::Representation;
  });
  return found;
}

bool wants_csv(const Request& request) {
  if (const auto format = request.text("format")) return *format == "csv";
  return request.response_type() == "text/csv";
}

Parameter format_of(std::vector<std::string> forms) {
  auto format = query("format", http::Words{std::move(forms)}, "Format; replaces Accept");
  format.replaces_accept = true;
  return format;
}

Parameter csv_or_json() { return format_of({"json", "csv"}); }

bool prefers_async(const Request& request) {
  bool found = false;
  for_each_preference(request, [&](const NameValue& preference) {
    found |= ascii_iequals(preference.name, "respond-async");
  });
  return found;
}

Result<std::optional<std::string>> idempotency_key(const Request& request) {
  constexpr std::size_t kLongest = 255;
  const auto header = request.header("Idempotency-Key");
  if (!header) return std::optional<std::string>();
  if (request.header_list("Idempotency-Key") != *header)
    return Error{ErrorCode::IdempotencyKeyInvalid, "send one Idempotency-Key"};
  std::string_view key = trim(*header);
  if (key.size() >= 2 && key.front() == '"' && key.back() == '"')
    key = key.substr(1, key.size() - 2);
  const bool printable = std::ranges::all_of(key, [](char c) { return c >= ' ' && c <= '~'; });
  if (key.empty() || key.size() > kLongest || !printable) {
    return Error{ErrorCode::IdempotencyKeyInvalid,
                 "Idempotency-Key must have 1 to 255 printable ASCII characters"};
  }
  return std::optional(std::string(key));
}

Preconditions preconditions_of(const Request& request) {
  return {.if_match = request.header_list("If-Match"),
          .if_none_match = request.header_list("If-None-Match")};
}

bool Preconditions::hold(std::optional<std::string_view> etag) const {
  if (if_match && !(etag && http::names_etag_strongly(*if_match, *etag))) return false;
  return !(if_none_match && etag && http::names_etag_weakly(*if_none_match, *etag));
}

/// Bytes of a header section.
constexpr std::size_t kLongestTags = std::size_t{32} << 10;

std::string next_link(const Request& request, std::string_view cursor) {
  return fmt::format("<{}?{}after={}>; rel=\"next\"", request.path(),
                     request.query_without("after"), cursor);
}

std::vector<Parameter> with_preconditions(Parameter path) {
  return {std::move(path),
          {.name = "If-Match",
           .place = http::ParameterPlace::Header,
           .type = http::Text{.max_length = kLongestTags},
           .description = "Tags of which one must be the current one, or * for any"},
          {.name = "If-None-Match",
           .place = http::ParameterPlace::Header,
           .type = http::Text{.max_length = kLongestTags},
           .description = "Tags of which none may be the current one, or * for none at all"}};
}

std::optional<std::string_view> caller_name(const Request& request) {
  const auto* caller = request.caller<Caller>();
  if (caller == nullptr || caller->name.empty()) return std::nullopt;
  return std::string_view(caller->name);
}

std::optional<std::string> caller_text(const Request& request) {
  const auto name = caller_name(request);
  return name ? std::optional<std::string>(*name) : std::nullopt;
}

std::string etag_of_text(std::string_view text) {
  constexpr std::size_t kTagDigits = 32;
  return '"' + to_hex(sha256(text)).substr(0, kTagDigits) + '"';
}

Result<Response> with_tag(Response response, const std::optional<std::string>& if_match) {
  std::string tag = etag_of_text(std::get<std::string>(response.body));
  if (!Preconditions{.if_match = if_match}.hold(tag)) {
    return Error{ErrorCode::PreconditionFailed,
                 "the current state does not match If-Match: read it again without If-Match"};
  }
  response.etag = std::move(tag);
  return response;
}

TextPrecondition text_precondition_of(const Request& request) {
  Preconditions conditions = preconditions_of(request);
  if (!conditions.any()) return {};
  return [conditions = std::move(conditions)](std::optional<std::string_view> text) {
    return text ? conditions.hold(etag_of_text(*text)) : conditions.hold(std::nullopt);
  };
}

Parameter idempotency_parameter() {
  return {.name = "Idempotency-Key",
          .place = http::ParameterPlace::Header,
          .type = http::Text{.schema = R"({"type":"string","pattern":)"
                                       R"("^(\"[ -~]{1,255}\"|[!#-~][ -~]{0,254})$"})"},
          .description =
              "1 to 255 printable ASCII characters, quoted or bare: a repeated request "
              "returns the first response"};
}

SharedPosting begin_posting(const Services& services, const Request& request, Responder responder) {
  auto posting = std::make_shared<Posting>(Posting{services, request, std::move(responder)});
  auto key = idempotency_key(request);
  if (!key) {
    posting->responder.fail(key.error());
    return nullptr;
  }
  if (*key) {
    posting->scope = app::IdempotencyScope{.caller = std::string(caller_name(request).value_or("")),
                                           .method = "POST",
                                           .path = std::string(request.path()),
                                           .key = **std::move(key),
                                           .body = request.body()};
  }
  return posting;
}

Response response_of(app::Answer answer) {
  Response response(answer.status, std::move(answer.content_type), std::move(answer.body));
  if (!answer.location.empty()) response.with("Location", std::move(answer.location));
  return response;
}

Response replayed(app::Answer kept) {
  return response_of(std::move(kept)).with("Idempotency-Replayed", "true");
}

}  // namespace fitgauge::api
