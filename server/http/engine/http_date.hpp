#pragma once

#include <array>
#include <cstddef>
#include <string_view>

#include "base/clock.hpp"

namespace fitgauge::http {

/// `Sun, 06 Nov 1994 08:49:37 GMT` (RFC 9110 section 5.6.7).
using HttpDate = std::array<char, 29>;

HttpDate format_http_date(Timestamp time);

inline std::string_view text(const HttpDate& date) { return {date.data(), date.size()}; }

}  // namespace fitgauge::http
