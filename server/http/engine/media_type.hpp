#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace fitgauge::http {

/// A Content-Type value taken apart; both in lower case.
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
