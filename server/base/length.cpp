#include "base/length.hpp"

#include <cmath>

#include "base/decimal.hpp"

namespace fitgauge {
namespace {

constexpr int kMillimetreScale = 6;
constexpr int kMicrometreScale = 3;

Result<Length> parse_length(std::string_view text, int scale, LengthSyntax syntax) {
  const DecimalSyntax decimal{.scale = scale,
                              .decimal_comma = syntax.decimal_comma,
                              .exponent = syntax.exponent,
                              .round_to_nearest = syntax.round_to_nearest};
  auto parsed = parse_decimal(text, decimal);
  if (!parsed) {
    Error error = std::move(parsed).error();
    if (error.code == ErrorCode::NumberMalformed) error.code = ErrorCode::LengthMalformed;
    if (error.code == ErrorCode::NumberOutOfRange) error.code = ErrorCode::LengthOutOfRange;
    return error;
  }
  const Length length = Length::nanometres(*parsed);
  if (length > kLongest || length < -kLongest) {
    return Error{ErrorCode::LengthOutOfRange,
                 "'" + std::string(text) + "' is beyond the longest length, 1000000000 mm"};
  }
  return length;
}

}  // namespace

Result<Length> Length::nearest_mm(double millimetres) {
  constexpr double kLargest = 1e12;
  if (!std::isfinite(millimetres) || std::abs(millimetres) > kLargest) {
    return Error{ErrorCode::LengthOutOfRange, "a computed length is not finite or beyond 1e12 mm"};
  }
  return nanometres(std::llround(millimetres * 1e6));
}

Result<Length> parse_length_mm(std::string_view text, LengthSyntax syntax) {
  return parse_length(text, kMillimetreScale, syntax);
}

Result<Length> parse_length_um(std::string_view text, LengthSyntax syntax) {
  return parse_length(text, kMicrometreScale, syntax);
}

void append_mm(std::string& out, Length length) {
  append_decimal(out, length.count(), kMillimetreScale);
}

void append_um(std::string& out, Length length) {
  append_decimal(out, length.count(), kMicrometreScale);
}

std::string format_mm(Length length) { return format_decimal(length.count(), kMillimetreScale); }

std::string format_um(Length length) { return format_decimal(length.count(), kMicrometreScale); }

}  // namespace fitgauge
