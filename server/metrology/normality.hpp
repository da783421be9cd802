#pragma once

#include <vector>

#include "metrology/decimals.hpp"
#include "metrology/summary.hpp"

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

/// @param sorted ascending, of kFewestForNormality or more
/// @pre standard_deviation > 0
NormalityTest test_normality(const std::vector<double>& sorted, double mean,
                             double standard_deviation);

}  // namespace fitgauge::metrology
