#pragma once

#include <boost/multiprecision/cpp_int.hpp>

namespace fitgauge::metrology {

/// Whole numbers of any size and their fractions, without expression templates. Sums, differences
/// and quotients of decimals are exact; irrational results are rounded once, to `long double`.
using Integer = boost::multiprecision::number<boost::multiprecision::cpp_int_backend<>,
                                              boost::multiprecision::et_off>;
using Exact = boost::multiprecision::number<
    boost::multiprecision::rational_adaptor<boost::multiprecision::cpp_int_backend<>>,
    boost::multiprecision::et_off>;

/// A decimal value times a power of ten.
__extension__ using Wide = __int128;

Integer power_of_ten(int exponent);
inline Exact whole(std::size_t count) { return {Integer(count)}; }

/// The nearest `long double`, which holds 19 digits; ties to even.
long double nearest(const Exact& value);
/// Returns the nearest `double`, rounded once and not through `long double`.
double nearest_double(const Exact& value);
/// Whether products of two such numbers fit in 128 bits.
constexpr bool is_short(Wide value) {
  constexpr Wide kShort = Wide{1} << 62;
  return -kShort < value && value < kShort;
}

/// A sum that never overflows: 128 bits, and any number of digits when these are too few.
class ExactSum {
 public:
  void add(Wide value) {
    Wide sum = 0;
    if (__builtin_add_overflow(low_, value, &sum)) return carry(value);
    low_ = sum;
  }
  void add_product(Wide a, Wide b) {
    if (is_short(a) && is_short(b)) return add(a * b);
    add_long_product(a, b);
  }
  Integer value() const { return high_ + Integer(low_); }

 private:
  void carry(Wide value);
  void add_long_product(Wide a, Wide b);

  Wide low_ = 0;
  Integer high_ = 0;
};

/// One decimal, exactly: digits / 10^scale.
struct Decimal {
  Wide digits = 0;
  int scale = 0;  ///< 0 to 30

  Exact exact() const { return {Integer(digits), power_of_ten(scale)}; }
};

/// Reads `[-]digits[.digits][e[±]digits]` as a whole.
/// @errors NumberMalformed; NumberOutOfRange with more than 30 digits, before the point or after
/// it.
Result<Decimal> parse_exact(std::string_view text);

/// Decimals with one scale: what every figure is computed from. Grows only.
class Decimals {
 public:
  Decimals() = default;
  /// counts / 10^scale, each within ±10^36.
  Decimals(std::vector<Wide> counts, int scale) : counts_(std::move(counts)), scale_(scale) {}

  /// Adds a value. If it has more decimals than the others, rescales all of them.
  /// @errors those of parse_exact; NumberOutOfRange if the values have more than 36 digits between
  ///   the first digit of the largest and the last digit of the finest. Then nothing is added.
  Result<void> add(std::string_view text);

  std::size_t size() const { return counts_.size(); }
  int scale() const { return scale_; }
  std::span<const Wide> counts() const { return counts_; }
  /// sum / 10^scale: of a count, and of a sum of counts.
  Exact exact(const Integer& sum) const { return {sum, power_of_ten(scale_)}; }
  Exact operator[](std::size_t i) const { return exact(Integer(counts_[i])); }

 private:
  std::vector<Wide> counts_;
  int scale_ = 0;
  Wide largest_ = 0;  // magnitude
};

/// Values in consecutive groups: counts / 10^scale.
struct GroupedCounts {
  std::span<const Wide> counts;
  int scale = 0;
  std::span<const std::size_t> ends;  ///< of each group; ascending, the last is counts.size()

  std::size_t size() const { return ends.size(); }
  std::span<const Wide> operator[](std::size_t group) const {
    const std::size_t begin = group == 0 ? 0 : ends[group - 1];
    return counts.subspan(begin, ends[group] - begin);
  }
};

/// Values in consecutive groups, which it owns.
struct Groups {
  Decimals values;
  std::vector<std::size_t> ends;

  GroupedCounts counts() const { return {values.counts(), values.scale(), ends}; }
};

}  // namespace fitgauge::metrology
