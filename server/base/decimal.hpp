#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "base/result.hpp"

namespace fitgauge {

/// What a decimal text may look like and what becomes of digits finer than the scale.
struct DecimalSyntax {
  int scale = 6;               ///< digits after the point that are kept: value = integer / 10^scale
  bool decimal_comma = false;  ///< `25,5` is read as `25.5`
  bool exponent = false;       ///< `2.5e1` is read
  bool round_to_nearest =
      false;  ///< finer digits are rounded, half away from zero, instead of refused
};

/// Reads the whole of `text` as an exact decimal: [sign] digits [mark digits] [exponent].
/// @returns the value times 10^scale.
/// @errors NumberMalformed; NumberOutOfRange when it does not fit; LengthTooFine when a non-zero
///   digit lies beyond the scale and rounding is not asked for.
Result<std::int64_t> parse_decimal(std::string_view text, const DecimalSyntax& syntax);

/// Appends value / 10^scale as the shortest exact decimal: `25.021`, `25`, `-0.75`.
void append_decimal(std::string& out, std::int64_t value, int scale);

std::string format_decimal(std::int64_t value, int scale);

}  // namespace fitgauge
