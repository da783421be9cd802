#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace fitgauge::http {

// Values of header fields that are lists. Beast's token_list and ext_list accept only tokens, not a
// media range (`text/html`) or an entity tag (`"7"`).

/// Removes the part before the next `separator` from the front of `rest`, without surrounding
/// blanks; separators in a quoted string do not count.
std::string_view take_part(std::string_view& rest, char separator);

/// The items between commas; empty ones count as none (RFC 9110 section 5.6.1).
std::vector<std::string_view> list_items(std::string_view value);

struct NameValue {
  std::string_view name;
  std::string_view value;  ///< without the quotes of a quoted string; empty when there is none
};
/// The parts of `name=value`.
NameValue split_parameter(std::string_view part);

/// Returns the weight `q` in the parameters of an item, in thousandths: 1000 without one, 0 if it
/// is malformed (RFC 9110 section 12.4.2).
int quality(std::string_view parameters);

/// The entity tag of the gzip form of an answer: `"abc-gzip"` of `"abc"`; empty of an empty one.
std::string packed_etag(std::string_view etag);
/// The end of such a tag, before its quote.
inline constexpr std::string_view kPackedEtagEnd = "-gzip";

/// Whether a list of entity tags, or `*`, names `etag` or its other form. If-None-Match compares
/// weakly, so that `W/` does not count; If-Match strongly, so that a weak tag names nothing (RFC
/// 9110 section 8.8.3.2).
bool names_etag_weakly(std::string_view tags, std::string_view etag);
bool names_etag_strongly(std::string_view tags, std::string_view etag);

/// The parts of a Content-Type; both in lower case.
struct MediaType {
  std::string type;     ///< `application/json`
  std::string charset;  ///< empty when absent
};

/// Empty for a value that is not `type/subtype *( ; name=value )`.
std::optional<MediaType> parse_media_type(std::string_view text);

/// The one of `offered` that an Accept value prefers (RFC 9110 section 12.5.1); among equals the
/// first. Null when none is acceptable. A malformed part of the value is skipped.
const std::string* preferred_type(std::string_view accept, const std::vector<std::string>& offered);

/// The weights, in thousandths, that an Accept-Encoding value gives to the codings of this server
/// (RFC 9110 section 12.5.3); 0 refuses a coding.
struct Codings {
  int gzip = 0;
  int identity = 1;  ///< of a value that does not name it: accepted, after every other

  bool prefers_gzip() const { return gzip > 0 && gzip >= identity; }
};
Codings accepted_codings(std::string_view accept_encoding);

/// Whether gzip shortens bodies of a Content-Type much: JSON, NDJSON, CSV, XML and files of pages.
bool is_packable(std::string_view content_type);

}  // namespace fitgauge::http
