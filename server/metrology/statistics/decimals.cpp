#include "metrology/statistics/summary.hpp"

namespace fitgauge::metrology {
namespace {

constexpr int kMostDigits = 30;
constexpr int kMostWideDigits = 36;

constexpr Wide wide_power_of_ten(int exponent) {
  Wide power = 1;
  for (int i = 0; i < exponent; ++i) power *= 10;
  return power;
}

constexpr Wide magnitude(Wide value) { return value < 0 ? -value : value; }

Error malformed(std::string_view text) {
  return {ErrorCode::NumberMalformed,
          fmt::format("'{}' is not a decimal number", text.substr(0, 40))};
}

Error out_of_range(std::string_view text) {
  return {ErrorCode::NumberOutOfRange,
          fmt::format("{} has more than {} digits before or after the point", text.substr(0, 40),
                      kMostDigits)};
}

/// Reads the digits at the front of `rest`.
std::string_view take_digits(std::string_view& rest) {
  const auto end = std::ranges::find_if(rest, [](char c) { return c < '0' || c > '9'; });
  const std::string_view digits = rest.substr(0, static_cast<std::size_t>(end - rest.begin()));
  rest.remove_prefix(digits.size());
  return digits;
}

/// Reads an exponent, if there is one; one beyond ±9999 counts as 9999. @returns false: malformed.
bool take_exponent(std::string_view& rest, int& exponent) {
  if (rest.empty() || (rest.front() != 'e' && rest.front() != 'E')) return true;
  rest.remove_prefix(1);
  const bool negative = rest.starts_with('-');
  if (negative || rest.starts_with('+')) rest.remove_prefix(1);
  const std::string_view digits = take_digits(rest);
  if (digits.empty()) return false;
  constexpr int kFar = 9999;
  if (std::from_chars(digits.data(), digits.data() + digits.size(), exponent).ec != std::errc() ||
      exponent > kFar) {
    exponent = kFar;
  }
  if (negative) exponent = -exponent;
  return true;
}

}  // namespace

Integer power_of_ten(int exponent) {
  return boost::multiprecision::pow(Integer(10), static_cast<unsigned>(exponent));
}

long double nearest(const Exact& value) { return value.convert_to<long double>(); }
double nearest_double(const Exact& value) { return value.convert_to<double>(); }

void ExactSum::carry(Wide value) {
  high_ += Integer(low_);
  low_ = value;
}

void ExactSum::add_long_product(Wide a, Wide b) { high_ += Integer(a) * Integer(b); }

Result<Decimal> parse_exact(std::string_view text) {
  std::string_view rest = text;
  const bool negative = rest.starts_with('-');
  if (negative) rest.remove_prefix(1);
  const std::string_view whole = take_digits(rest);
  std::string_view fraction;
  if (rest.starts_with('.')) {
    rest.remove_prefix(1);
    fraction = take_digits(rest);
    if (fraction.empty()) return malformed(text);
  }
  int exponent = 0;
  if (whole.empty() || !take_exponent(rest, exponent) || !rest.empty()) return malformed(text);

  std::string digits(whole);
  digits += fraction;
  const std::size_t last = digits.find_last_not_of('0');
  if (last == std::string::npos) return Decimal{};
  int scale = static_cast<int>(std::min<std::size_t>(fraction.size(), 1'000'000)) - exponent -
              static_cast<int>(std::min<std::size_t>(digits.size() - last - 1, 1'000'000));
  digits.erase(last + 1);
  digits.erase(0, digits.find_first_not_of('0'));
  const std::size_t zeros = scale < 0 ? static_cast<std::size_t>(-scale) : 0;
  if (digits.size() + zeros > kMostDigits || scale > kMostDigits) return out_of_range(text);
  digits.append(zeros, '0');
  scale = std::max(scale, 0);
  Wide count = 0;
  for (const char digit : digits) count = count * 10 + (digit - '0');
  return Decimal{.digits = negative ? -count : count, .scale = scale};
}

Result<void> Decimals::add(std::string_view text) {
  const auto parsed = TRY(parse_exact(text));
  const int finer = parsed.scale - scale_;
  const Wide own = magnitude(parsed.digits);
  const Wide widened = std::max(finer > 0 ? largest_ : own, Wide{1});
  if (const int by = std::abs(finer);
      widened > wide_power_of_ten(kMostWideDigits) / wide_power_of_ten(by)) {
    return Error{ErrorCode::NumberOutOfRange,
                 fmt::format("{}: the values must fit in {} digits, from the first digit of the "
                             "largest value to the last digit of the finest value",
                             text.substr(0, 40), kMostWideDigits)};
  }
  Wide count = parsed.digits;
  if (finer > 0) {
    const Wide factor = wide_power_of_ten(finer);
    for (Wide& other : counts_) other *= factor;
    largest_ *= factor;
    scale_ = parsed.scale;
  } else {
    count *= wide_power_of_ten(-finer);
  }
  counts_.push_back(count);
  largest_ = std::max(largest_, magnitude(count));
  return {};
}

}  // namespace fitgauge::metrology
