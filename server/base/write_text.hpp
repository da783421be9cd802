#pragma once

#include <cstddef>
#include <cstdint>

#include "base/clock.hpp"

namespace fitgauge {

// Numbers and times as append_decimal and format_rfc3339 give them, written in place: to where
// there is room. Each gives the end of its text.

/// Room for any decimal: its sign, 19 digits, a zero before the point, the point.
inline constexpr std::size_t kDecimalRoom = 24;
/// @param scale from 0 to 18.
char* write_decimal(char* to, std::int64_t value, int scale);

inline constexpr std::size_t kRfc3339Room = 32;
char* write_rfc3339(char* to, Timestamp time);

}  // namespace fitgauge
