#include "base/decimal.hpp"

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <limits>

namespace fitgauge {
namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// The parts of a decimal text, before anything is computed.
struct DecimalText {
  bool negative = false;
  std::string_view integer;
  std::string_view fraction;
  std::int64_t exponent = 0;

  std::size_t digits() const { return integer.size() + fraction.size(); }
  int digit(std::size_t i) const {
    return (i < integer.size() ? integer[i] : fraction[i - integer.size()]) - '0';
  }
};

std::string_view take_digits(std::string_view& text) {
  const auto end = std::find_if_not(text.begin(), text.end(), is_digit);
  const auto count = static_cast<std::size_t>(end - text.begin());
  const std::string_view digits = text.substr(0, count);
  text.remove_prefix(count);
  return digits;
}

bool take_sign(std::string_view& text) {
  if (text.empty() || (text.front() != '-' && text.front() != '+')) return false;
  const bool negative = text.front() == '-';
  text.remove_prefix(1);
  return negative;
}

/// An exponent that no length survives is cut to a value with the same outcome.
std::int64_t exponent_value(std::string_view digits, bool negative) {
  constexpr std::int64_t kEnough = 1'000'000'000;
  std::int64_t value = 0;
  for (const char c : digits) value = std::min(kEnough, value * 10 + (c - '0'));
  return negative ? -value : value;
}

bool split(std::string_view text, const DecimalSyntax& syntax, DecimalText& parts) {
  parts.negative = take_sign(text);
  parts.integer = take_digits(text);
  if (parts.integer.empty()) return false;
  if (!text.empty() && (text.front() == '.' || (syntax.decimal_comma && text.front() == ','))) {
    text.remove_prefix(1);
    parts.fraction = take_digits(text);
    if (parts.fraction.empty()) return false;
  }
  if (syntax.exponent && !text.empty() && (text.front() == 'e' || text.front() == 'E')) {
    text.remove_prefix(1);
    const bool negative = take_sign(text);
    const std::string_view digits = take_digits(text);
    if (digits.empty()) return false;
    parts.exponent = exponent_value(digits, negative);
  }
  return text.empty();
}

Error error_of(ErrorCode code, std::string_view text, std::string_view what) {
  constexpr std::size_t kShown = 40;
  std::string shown(text.substr(0, kShown));
  if (text.size() > kShown) shown += "...";
  return {code, "'" + shown + "' " + std::string(what)};
}

}  // namespace

Result<std::int64_t> parse_decimal(std::string_view text, const DecimalSyntax& syntax) {
  DecimalText parts;
  if (!split(text, syntax, parts)) {
    return error_of(ErrorCode::NumberMalformed, text,
                    syntax.decimal_comma ? "is not a decimal number such as 25.013 or 25,013"
                                         : "is not a decimal number such as 25.013");
  }
  const auto out_of_range = [&] {
    return error_of(ErrorCode::NumberOutOfRange, text, "is too large");
  };

  // value * 10^scale = digits * 10^(shift - count of digits): `kept` digits stay, the rest is
  // finer.
  std::size_t first = 0;
  while (first < parts.digits() && parts.digit(first) == 0) ++first;
  if (first == parts.digits()) return std::int64_t{0};
  const std::int64_t kept = static_cast<std::int64_t>(parts.integer.size()) + parts.exponent +
                            syntax.scale - static_cast<std::int64_t>(first);
  if (kept > std::numeric_limits<std::int64_t>::digits10 + 1) return out_of_range();

  std::uint64_t magnitude = 0;
  const auto count = static_cast<std::int64_t>(parts.digits() - first);
  for (std::int64_t i = 0; i < kept; ++i) {
    const int digit = i < count ? parts.digit(first + static_cast<std::size_t>(i)) : 0;
    magnitude = magnitude * 10 + static_cast<std::uint64_t>(digit);
  }
  const auto at = [&](std::int64_t i) { return parts.digit(first + static_cast<std::size_t>(i)); };
  if (syntax.round_to_nearest) {
    if (kept >= 0 && kept < count && at(kept) >= 5) ++magnitude;
  } else {
    for (std::int64_t i = std::max<std::int64_t>(kept, 0); i < count; ++i) {
      if (at(i) != 0) {
        return error_of(ErrorCode::LengthTooFine, text,
                        "has more than " + std::to_string(syntax.scale) +
                            " digits after the point that are not zero");
      }
    }
  }
  if (magnitude > static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max())) {
    return out_of_range();
  }
  const auto value = static_cast<std::int64_t>(magnitude);
  return parts.negative ? -value : value;
}

void append_decimal(std::string& out, std::int64_t value, int scale) {
  // 20 digits of a 64-bit integer, its sign, the point and leading zeros up to the scale.
  char digits[24];
  const std::uint64_t magnitude =
      value < 0 ? 0 - static_cast<std::uint64_t>(value) : static_cast<std::uint64_t>(value);
  const auto count =
      std::to_chars(std::begin(digits), std::end(digits), magnitude).ptr - std::begin(digits);
  const std::string_view text(digits, static_cast<std::size_t>(count));
  const auto fraction_digits = static_cast<std::size_t>(scale);
  if (value < 0) out += '-';
  if (text.size() > fraction_digits) {
    out += text.substr(0, text.size() - fraction_digits);
  } else {
    out += '0';
  }
  std::string_view fraction =
      text.substr(text.size() > fraction_digits ? text.size() - fraction_digits : 0);
  const std::size_t leading_zeros = fraction_digits - fraction.size();
  fraction = fraction.substr(0, fraction.find_last_not_of('0') + 1);
  if (fraction.empty()) return;
  out += '.';
  out.append(leading_zeros, '0');
  out += fraction;
}

std::string format_decimal(std::int64_t value, int scale) {
  std::string out;
  append_decimal(out, value, scale);
  return out;
}

}  // namespace fitgauge
