#include "metrology/statistics/distributions.hpp"

#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/fisher_f.hpp>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>

namespace fitgauge::metrology {

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

long double chi_squared_quantile(long double p, long double degrees_of_freedom) {
  if (degrees_of_freedom > kManyDegreesOfFreedom) {
    return chi_squared_series(normal_quantile(p), degrees_of_freedom);
  }
  return bm::quantile(bm::chi_squared_distribution<long double>(degrees_of_freedom), p);
}

}  // namespace fitgauge::metrology
