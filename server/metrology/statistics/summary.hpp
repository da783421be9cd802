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

/// A figure that is not defined, such as the standard deviation of one value.
inline constexpr long double kUndefined = std::numeric_limits<long double>::quiet_NaN();

/// Mean and sum of squared deviations from it, exactly.
struct Moments {
  std::size_t count = 0;
  Exact mean;
  Exact squares;

  /// The square root of squares / (n - 1), rounded once; kUndefined for one value.
  long double standard_deviation() const;
};

/// @pre counts is not empty
Moments moments(std::span<const Wide> counts, int scale);
inline Moments moments(const Decimals& values) { return moments(values.counts(), values.scale()); }

/// The square root, rounded once. @pre value >= 0
long double square_root(const Exact& value);

/// r(1): the sum of products of neighbouring deviations over the sum of squared ones; kUndefined
/// without spread.
long double autocorrelation_lag_1(const Decimals& values, const Moments& of);

/// Values in ascending order, equal values together: a million measured sizes are a few thousand
/// values.
class Ranking {
 public:
  explicit Ranking(std::span<const Wide> counts);

  std::size_t size() const { return ends_.empty() ? 0 : ends_.back(); }
  /// The value with that many before it.
  Wide operator[](std::size_t rank) const;
  Wide front() const { return values_.front(); }
  Wide back() const { return values_.back(); }

  /// Distinct values, and for each the number of values up to it.
  std::span<const Wide> values() const { return values_; }
  std::span<const std::uint32_t> ends() const { return ends_; }

 private:
  std::vector<Wide> values_;
  std::vector<std::uint32_t> ends_;
};

struct Quantile {
  long double p = 0;
  long double value = 0;
};

/// Quantiles of type 7 (Hyndman and Fan 1996): linear between the values at (n - 1) p.
/// @pre ranking is not empty
Exact quantile(const Ranking& ranking, int scale, const Exact& p);

/// The probabilities of the quantiles of a summary, in hundred-thousandths: ±3 standard deviations
/// of a normal distribution are the first and the last.
inline constexpr std::array kQuantiles = {135,    1'000,  5'000,  25'000, 50'000,
                                          75'000, 95'000, 99'000, 99'865};

struct Summary {
  Moments moments;
  long double autocorrelation_lag_1 = kUndefined;
  Exact min;
  Exact max;
  std::array<Quantile, kQuantiles.size()> quantiles{};
};

/// @pre values is not empty
Summary summarise(const Decimals& values);

// Distributions of Boost.Math, in `long double`. Degrees of freedom may be infinite for t.

long double normal_below(long double z);
inline double normal_below(double z) { return std::erfc(-z / std::sqrt(2.0)) / 2; }
inline double normal_density(double z) { return std::exp(-z * z / 2) / std::sqrt(2 * M_PI); }
/// Returns the z that a normal value is below with probability `p`.
long double normal_quantile(long double p);

/// The probability of a value above f; 0 for an infinite f.
long double f_above(long double f, long double between, long double within);
/// The f with that probability below it.
long double f_quantile(long double p, long double between, long double within);
/// The probability of a value farther from 0 than t, on both sides.
long double t_beyond(long double t, long double degrees_of_freedom);
/// The t with that probability below it.
long double t_quantile(long double p, long double degrees_of_freedom);
/// The probability of a value above that.
long double chi_squared_above(long double value, long double degrees_of_freedom);
long double chi_squared_quantile(long double p, long double degrees_of_freedom);

/// The Anderson-Darling test of a normal distribution whose mean and standard deviation are
/// estimated: A², its form for small samples A² (1 + 0.75 / n + 2.25 / n²), and p (D'Agostino and
/// Stephens 1986, table 4.9).
struct NormalityTest {
  double statistic = 0;
  double adjusted = 0;
  double p = 0;
};

/// Minimum number of values.
inline constexpr std::size_t kFewestForNormality = 5;

/// @param ranking of kFewestForNormality values or more, in any unit
/// @param mean from the least value, and the standard deviation, both in that unit
/// @pre standard_deviation > 0
NormalityTest test_normality(const Ranking& ranking, double mean, double standard_deviation);

}  // namespace fitgauge::metrology
