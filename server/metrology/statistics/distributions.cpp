#include "metrology/statistics/distributions.hpp"

#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/fisher_f.hpp>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>

#include <cmath>

namespace fitgauge::metrology {
namespace {

/// The logarithm of the probability below z. Far out, where erfc is 0, its asymptote.
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

}  // namespace

namespace bm = boost::math;

namespace {

/// From here on the series of Cornish and Fisher is as good as the incomplete gamma function, whose
/// own series Boost gives up beyond 1e10.
constexpr long double kManyDegreesOfFreedom = 1e7L;

/// Cornish and Fisher 1960: what is left out is below 1e-16 of the quantile.
long double chi_squared_series(long double z, long double n) {
  const long double z2 = z * z;
  const long double unit = std::sqrt(2 / n);
  return n * (1 + z * unit + 2 * (z2 - 1) / (3 * n) + z * (z2 - 7) * unit / (18 * n) -
              (2 * z2 * (3 * z2 + 7) - 32) / (405 * n * n));
}

}  // namespace

long double normal_below(long double z) { return std::erfc(-z / std::sqrt(2.0L)) / 2; }

long double normal_quantile(long double p) {
  return bm::quantile(bm::normal_distribution<long double>(), p);
}

long double f_above(long double f, long double between, long double within) {
  if (std::isinf(f)) return 0;
  return bm::cdf(bm::complement(bm::fisher_f_distribution<long double>(between, within), f));
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
    // From the least value, so that leading digits all share cost nothing.
    const double z =
        (static_cast<double>(ranking.values()[i] - ranking.front()) - mean) / standard_deviation;
    // ln F(x_i) has the weight 2i + 1, ln(1 - F(x_i)) that of its place from the other end: of
    // equal values, of which measured ones are full, these are differences of squares.
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
