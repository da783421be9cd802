#include "base/length.hpp"

namespace fitgauge {
namespace {

constexpr std::array<std::uint64_t, 19> kPowersOfTen = [] {
  std::array<std::uint64_t, 19> powers{1};
  for (std::size_t i = 1; i < powers.size(); ++i) powers[i] = powers[i - 1] * 10;
  return powers;
}();

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

/// Returns the exponent; one beyond every length is cut to a value with the same outcome.
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

/// Reads digits, or digits with a point and at most as many after it as the scale keeps, in one
/// pass: most texts are so. @returns false for other texts.
bool read_plain(std::string_view text, int scale, std::int64_t& value) {
  constexpr std::size_t kMostDigits = std::numeric_limits<std::int64_t>::digits10;
  const auto kept = static_cast<std::size_t>(scale);
  if (text.size() > kMostDigits + 1) return false;
  std::size_t point = text.size();
  std::uint64_t digits = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (is_digit(text[i])) {
      digits = digits * 10 + static_cast<std::uint64_t>(text[i] - '0');
    } else if (text[i] == '.' && point == text.size() && i + 1 < text.size()) {
      point = i;
    } else {
      return false;
    }
  }
  const std::size_t fraction = point == text.size() ? 0 : text.size() - point - 1;
  if (point == 0 || fraction > kept || point + kept > kMostDigits) return false;
  value = static_cast<std::int64_t>(digits * kPowersOfTen[kept - fraction]);
  return true;
}

Error error_of(ErrorCode code, std::string_view text, std::string_view what) {
  constexpr std::size_t kShown = 40;
  std::string shown(text.substr(0, kShown));
  if (text.size() > kShown) shown += "...";
  return {code, "'" + shown + "' " + std::string(what)};
}

constexpr int kMillimetreScale = 6;
constexpr int kMicrometreScale = 3;

Result<Length> parse_length(std::string_view text, int scale, DecimalSyntax syntax) {
  syntax.scale = scale;
  auto parsed = parse_decimal(text, syntax);
  if (!parsed) {
    Error error = std::move(parsed).error();
    if (error.code == ErrorCode::NumberMalformed) error.code = ErrorCode::LengthMalformed;
    if (error.code == ErrorCode::NumberOutOfRange) error.code = ErrorCode::LengthOutOfRange;
    return error;
  }
  const Length length = Length::nanometres(*parsed);
  if (length > kLongest || length < -kLongest) {
    return Error{ErrorCode::LengthOutOfRange,
                 "'" + std::string(text) + "' is longer than 1000000000 mm"};
  }
  return length;
}

}  // namespace

Result<std::int64_t> parse_decimal(std::string_view text, const DecimalSyntax& syntax) {
  if (std::int64_t plain = 0; read_plain(text, syntax.scale, plain)) return plain;
  DecimalText parts;
  if (!split(text, syntax, parts)) {
    return error_of(ErrorCode::NumberMalformed, text,
                    syntax.decimal_comma ? "is not a decimal number such as 25.013 or 25,013"
                                         : "is not a decimal number such as 25.013");
  }
  const auto out_of_range = [&] {
    return error_of(ErrorCode::NumberOutOfRange, text, "is too large");
  };

  // value * 10^scale = digits * 10^(shift - count of digits): `kept` digits remain.
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
  if (magnitude > static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max()))
    return out_of_range();
  const auto value = static_cast<std::int64_t>(magnitude);
  return parts.negative ? -value : value;
}

char* write_decimal(char* to, std::int64_t value, int scale) {
  constexpr int kMostDigits = 20;
  auto magnitude = static_cast<std::uint64_t>(value);
  if (value < 0) {
    *to++ = '-';
    magnitude = 0 - magnitude;
  }
  constexpr int kUsual = 6;  // nanometres in mm: divided by a constant, in a third of the time
  const std::uint64_t unit = kPowersOfTen[static_cast<std::size_t>(scale)];
  const std::uint64_t whole = scale == kUsual ? magnitude / kPowersOfTen[kUsual] : magnitude / unit;
  to = std::to_chars(to, to + kMostDigits, whole).ptr;
  std::uint64_t fraction = magnitude - whole * unit;
  if (fraction == 0) return to;
  *to++ = '.';
  char* end = to + scale;
  for (char* at = end; at != to; fraction /= 10) *--at = static_cast<char>('0' + fraction % 10);
  while (end[-1] == '0') --end;
  return end;
}

void append_decimal(std::string& out, std::int64_t value, int scale) {
  char text[kDecimalRoom];
  out.append(text, write_decimal(text, value, scale));
}

std::string format_decimal(std::int64_t value, int scale) {
  std::string out;
  append_decimal(out, value, scale);
  return out;
}

Result<Length> Length::nearest_mm(double millimetres) {
  constexpr double kLargest = 1e12;
  if (!std::isfinite(millimetres) || std::abs(millimetres) > kLargest)
    return Error{ErrorCode::LengthOutOfRange, "a computed length is not finite or beyond 1e12 mm"};
  return nanometres(std::llround(millimetres * 1e6));
}

Result<Length> parse_length_mm(std::string_view text, DecimalSyntax syntax) {
  return parse_length(text, kMillimetreScale, syntax);
}

Result<Length> parse_length_um(std::string_view text, DecimalSyntax syntax) {
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
