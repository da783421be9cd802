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

}  // namespace fitgauge::http
