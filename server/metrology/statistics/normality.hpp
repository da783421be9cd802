#pragma once

#include <span>

#include "metrology/statistics/decimals.hpp"
#include "metrology/statistics/summary.hpp"

namespace fitgauge::metrology {

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
