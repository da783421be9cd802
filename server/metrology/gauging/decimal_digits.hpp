#pragma once

#include <cmath>
#include <cstdint>

namespace fitgauge::gauging {

/// The nearest whole number that a double keeps in its decimal digits: a record spells it as
/// RFC 8785 does. @pre |value| < 9e18
inline std::int64_t to_15_digits(double value) {
  constexpr std::int64_t kLimit = 1'000'000'000'000'000;
  const std::int64_t whole = std::llround(value);
  std::int64_t step = 1;
  while (whole / step >= kLimit) step *= 10;
  return (whole + step / 2) / step * step;
}

}  // namespace fitgauge::gauging
