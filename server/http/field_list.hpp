#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace fitgauge::http {

// Values of header fields that are lists. Beast's token_list and ext_list know tokens alone, and
// neither a media range (`text/html`) nor an entity tag (`"7"`) is one.

/// Takes the part before the next `separator` off the front of `rest`, without blanks around it; a
/// separator within a quoted string is none.
std::string_view take_part(std::string_view& rest, char separator);

/// The items between commas; empty ones count as none (RFC 9110 section 5.6.1).
std::vector<std::string_view> list_items(std::string_view value);

struct NameValue {
  std::string_view name;
  std::string_view value;  ///< without the quotes of a quoted string; empty when there is none
};
/// `name=value` taken apart.
NameValue split_parameter(std::string_view part);

/// The weight `q` among the parameters behind an item, in thousandths: 1000 without one, 0 when it
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

}  // namespace fitgauge::http
