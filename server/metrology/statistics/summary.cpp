#include "metrology/statistics/summary.hpp"

#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/fisher_f.hpp>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>

namespace fitgauge::metrology {
namespace {

constexpr int kHundredThousand = 100'000;
constexpr std::size_t kManyToSort = 4'096;
constexpr Wide kNarrow = Wide{1} << 20;  ///< up to this range, a table of counts is worth its 4 MiB

/// The logarithm of the probability below z. Its asymptote far out, if erfc is 0.
double log_below(double z) {
  constexpr double kFar = -37;
  if (z < kFar) return -z * z / 2 - std::log(-z) - std::log(2 * M_PI) / 2;
  return std::log(normal_below(z));
}

double p_of(double a) {
  if (a >= 13) return 0;
  if (a >= 0.6) return std::exp(1.2937 - 5.709 * a + 0.0186 * a * a);
  if (a >= 0.34) return std::exp(0.9177 - 4.279 * a - 1.38 * a * a);
  if (a >= 0.2) return 1 - std::exp(-8.318 + 42.796 * a - 59.938 * a * a);
  return 1 - std::exp(-13.436 + 101.14 * a - 223.73 * a * a);
}

/// Above this number the series of Cornish and Fisher is as good as the incomplete gamma function,
/// whose series in Boost fails beyond 1e10.
constexpr long double kManyDegreesOfFreedom = 1e7L;

/// Cornish and Fisher 1960: the omitted terms are below 1e-16 of the quantile.
long double chi_squared_series(long double z, long double n) {
  const long double z2 = z * z;
  const long double unit = std::sqrt(2 / n);
  return n * (1 + z * unit + 2 * (z2 - 1) / (3 * n) + z * (z2 - 7) * unit / (18 * n) -
              (2 * z2 * (3 * z2 + 7) - 32) / (405 * n * n));
}

}  // namespace

long double square_root(const Exact& value) {
  if (value == 0) return 0;
  // The root of top * bottom * 4^k, cut to a whole number of at least 130 bits, over bottom * 2^k:
  // a relative error below 2^-129 before the one rounding.
  const Integer& bottom = denominator(value);
  Integer product = numerator(value) * bottom;
  constexpr int kBits = 260;
  const int missing = std::max(0, kBits - static_cast<int>(msb(product)));
  const int k = (missing + 1) / 2;
  product <<= 2 * k;
  return nearest(Exact(sqrt(product), Integer(bottom << k)));
}

long double Moments::standard_deviation() const {
  return count < 2 ? kUndefined : square_root(squares / whole(count - 1));
}

Moments moments(std::span<const Wide> counts, int scale) {
  const Wide origin = counts.front();
  ExactSum sum;
  ExactSum squares;
  for (const Wide count : counts) {
    const Wide deviation = count - origin;
    sum.add(deviation);
    squares.add_product(deviation, deviation);
  }
  const Integer n(counts.size());
  const Integer total = sum.value();
  const Integer unit = power_of_ten(scale);
  return {.count = counts.size(),
          .mean = Exact(Integer(origin) * n + total, n * unit),
          .squares = Exact(n * squares.value() - total * total, n * unit * unit)};
}

long double autocorrelation_lag_1(const Decimals& values, const Moments& of) {
  if (of.squares == 0) return kUndefined;
  const auto counts = values.counts();
  const Wide origin = counts.front();
  ExactSum products;
  for (std::size_t i = 1; i < counts.size(); ++i) {
    products.add_product(counts[i] - origin, counts[i - 1] - origin);
  }
  // With deviations d from the first value and their mean m, the sum of (d - m)(d' - m) over the
  // n - 1 pairs of neighbours.
  const Exact unit(power_of_ten(values.scale()));
  const Exact m = (of.mean - values[0]) * unit;
  const Exact n = whole(of.count);
  const Exact last = Exact(Integer(counts.back() - origin));
  const Exact covered = 2 * n * m - last;  // the first value deviates by nothing
  const Exact sum = Exact(products.value()) - m * covered + (n - 1) * m * m;
  return nearest(sum / (of.squares * unit * unit));
}

Ranking::Ranking(std::span<const Wide> counts) {
  if (counts.empty()) return;
  const auto add = [this](Wide value, std::uint32_t times) {
    values_.push_back(value);
    ends_.push_back((ends_.empty() ? 0 : ends_.back()) + times);
  };
  const auto [least, most] = std::ranges::minmax_element(counts);
  const Wide first = *least;
  if (counts.size() < kManyToSort || *most - first >= kNarrow) {
    std::vector<Wide> rising(counts.begin(), counts.end());
    std::ranges::sort(rising);
    for (auto begin = rising.begin(), end = begin; begin != rising.end(); begin = end) {
      end = std::find_if(begin, rising.end(), [begin](Wide value) { return value != *begin; });
      add(*begin, static_cast<std::uint32_t>(end - begin));
    }
    return;
  }
  // Measured sizes are close together, so counting equal ones is fast.
  std::vector<std::uint32_t> times(static_cast<std::size_t>(*most - first) + 1);
  for (const Wide count : counts) ++times[static_cast<std::size_t>(count - first)];
  for (std::size_t i = 0; i < times.size(); ++i) {
    if (times[i] > 0) add(first + static_cast<Wide>(i), times[i]);
  }
}

Wide Ranking::operator[](std::size_t rank) const {
  const auto above = std::upper_bound(ends_.begin(), ends_.end(), rank);
  return values_[static_cast<std::size_t>(above - ends_.begin())];
}

Exact quantile(const Ranking& ranking, int scale, const Exact& p) {
  const Exact place = p * whole(ranking.size() - 1);
  const Integer below = numerator(place) / denominator(place);
  const auto index = static_cast<std::size_t>(below);
  const Exact share = place - Exact(below);
  const Wide low = ranking[index];
  const Wide high = ranking[std::min(index + 1, ranking.size() - 1)];
  return (Exact(Integer(low)) + share * Exact(Integer(high - low))) / Exact(power_of_ten(scale));
}

Summary summarise(const Decimals& values) {
  Summary summary;
  summary.moments = moments(values);
  summary.autocorrelation_lag_1 = autocorrelation_lag_1(values, summary.moments);
  const Ranking ranking(values.counts());
  summary.min = values.exact(Integer(ranking.front()));
  summary.max = values.exact(Integer(ranking.back()));
  for (std::size_t i = 0; i < kQuantiles.size(); ++i) {
    const Exact p{Integer(kQuantiles[i]), Integer(kHundredThousand)};
    summary.quantiles[i] = {.p = nearest(p),
                            .value = nearest(quantile(ranking, values.scale(), p))};
  }
  return summary;
}

namespace bm = boost::math;

long double normal_below(long double z) { return std::erfc(-z / std::sqrt(2.0L)) / 2; }

long double normal_quantile(long double p) {
  return bm::quantile(bm::normal_distribution<long double>(), p);
}

long double f_above(long double f, long double between, long double within) {
  if (std::isinf(f)) return 0;
  return bm::cdf(bm::complement(bm::fisher_f_distribution<long double>(between, within), f));
}

long double f_quantile(long double p, long double between, long double within) {
  return bm::quantile(bm::fisher_f_distribution<long double>(between, within), p);
}

long double t_beyond(long double t, long double degrees_of_freedom) {
  if (std::isinf(t)) return 0;
  const bm::students_t_distribution<long double> distribution(degrees_of_freedom);
  return 2 * bm::cdf(bm::complement(distribution, std::abs(t)));
}

long double t_quantile(long double p, long double degrees_of_freedom) {
  return bm::quantile(bm::students_t_distribution<long double>(degrees_of_freedom), p);
}

long double chi_squared_above(long double value, long double degrees_of_freedom) {
  const bm::chi_squared_distribution<long double> distribution(degrees_of_freedom);
  return bm::cdf(bm::complement(distribution, value));
}

long double chi_squared_quantile(long double p, long double degrees_of_freedom) {
  if (degrees_of_freedom > kManyDegreesOfFreedom) {
    return chi_squared_series(normal_quantile(p), degrees_of_freedom);
  }
  return bm::quantile(bm::chi_squared_distribution<long double>(degrees_of_freedom), p);
}

NormalityTest test_normality(const Ranking& ranking, double mean, double standard_deviation) {
  const std::size_t count = ranking.size();
  const auto n = static_cast<double>(count);
  const auto square = [](std::size_t value) {
    return static_cast<double>(value) * static_cast<double>(value);
  };
  double sum = 0;
  std::size_t begin = 0;
  for (std::size_t i = 0; i < ranking.values().size(); ++i) {
    const std::size_t end = ranking.ends()[i];
    // Computed from the least value, so that common leading digits cost no precision.
    const double z =
        (static_cast<double>(ranking.values()[i] - ranking.front()) - mean) / standard_deviation;
    // ln F(x_i) has the weight 2i + 1, ln(1 - F(x_i)) the weight of its place from the other end:
    // for equal values, which are frequent in measurements, these are differences of squares.
    sum += (square(end) - square(begin)) * log_below(z) +
           (square(count - begin) - square(count - end)) * log_below(-z);
    begin = end;
  }
  NormalityTest test;
  test.statistic = -n - sum / n;
  test.adjusted = test.statistic * (1 + 0.75 / n + 2.25 / (n * n));
  test.p = p_of(test.adjusted);
  return test;
}

}  // namespace fitgauge::metrology
