#pragma once

namespace fitgauge::http {

// Lists in header fields. Beast's token_list and ext_list accept only tokens, not a media range
// (`text/html`) or an entity tag (`"7"`).

/// Removes the part before the next `separator` from the front of `rest`, without surrounding
/// blanks; separators in a quoted string do not count.
std::string_view take_part(std::string_view& rest, char separator);

/// Returns the items between commas, without empty ones (RFC 9110 section 5.6.1).
std::vector<std::string_view> list_items(std::string_view value);

struct NameValue {
  std::string_view name;
  std::string_view value;  ///< without the quotes of a quoted string; empty when there is none
};
/// Splits `name=value`.
NameValue split_parameter(std::string_view part);

/// Returns the weight `q` in the parameters of an item, in thousandths: 1000 without one, 0 if it
/// is malformed (RFC 9110 section 12.4.2).
int quality(std::string_view parameters);

/// Returns the entity tag of the gzip form: `"abc-gzip"` for `"abc"`; empty for an empty tag.
std::string packed_etag(std::string_view etag);
/// End of a gzip form's tag, before its quote.
inline constexpr std::string_view kPackedEtagEnd = "-gzip";

/// Whether a list of entity tags, or `*`, names `etag` or its other form. If-None-Match compares
/// weakly, so that `W/` does not count; If-Match strongly, so that a weak tag names nothing (RFC
/// 9110 section 8.8.3.2).
bool names_etag_weakly(std::string_view tags, std::string_view etag);
bool names_etag_strongly(std::string_view tags, std::string_view etag);

/// Parts of a Content-Type, in lower case.
struct MediaType {
  std::string type;     ///< `application/json`
  std::string charset;  ///< empty when absent
};

/// Parses a Content-Type; empty if it is not `type/subtype *( ; name=value )`.
std::optional<MediaType> parse_media_type(std::string_view text);

/// Returns the type of `offered` that an Accept value prefers (RFC 9110 section 12.5.1), the first
/// of equals. Null if none is acceptable. Skips malformed parts of the value.
const std::string* preferred_type(std::string_view accept, const std::vector<std::string>& offered);

/// Weights, in thousandths, of the codings of this server in an Accept-Encoding value (RFC 9110
/// section 12.5.3); 0 refuses a coding.
struct Codings {
  int gzip = 0;
  int identity = 1;  ///< if not named: accepted, after all others

  bool prefers_gzip() const { return gzip > 0 && gzip >= identity; }
};
Codings accepted_codings(std::string_view accept_encoding);

/// Whether gzip shortens bodies of a Content-Type much: JSON, NDJSON, CSV, XML and files of pages.
bool is_packable(std::string_view content_type);

}  // namespace fitgauge::http
