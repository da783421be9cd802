#pragma once

#include <cmath>
#include <span>

#include "metrology/statistics/decimals.hpp"
#include "metrology/statistics/summary.hpp"

namespace fitgauge::metrology {

// Distributions of Boost.Math, in `long double`. Degrees of freedom may be infinite for t.

long double normal_below(long double z);
inline double normal_below(double z) { return std::erfc(-z / std::sqrt(2.0)) / 2; }
inline double normal_density(double z) { return std::exp(-z * z / 2) / std::sqrt(2 * M_PI); }
/// The z with that probability below it.
long double normal_quantile(long double p);

/// The probability of a value above f; 0 for an infinite f.
long double f_above(long double f, long double between, long double within);
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

/// Fewer values say nothing.
inline constexpr std::size_t kFewestForNormality = 5;

/// @param ranking of kFewestForNormality values or more, in any unit
/// @param mean from the least value, and the standard deviation, both in that unit
/// @pre standard_deviation > 0
NormalityTest test_normality(const Ranking& ranking, double mean, double standard_deviation);

}  // namespace fitgauge::metrology
