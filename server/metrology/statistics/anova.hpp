#pragma once

#include "metrology/statistics/decimals.hpp"
#include "metrology/statistics/summary.hpp"

namespace fitgauge::metrology {

/// One line of a table of the analysis of variance.
struct Variation {
  std::size_t degrees_of_freedom = 0;
  Exact sum_of_squares;

  Exact mean_square() const { return sum_of_squares / whole(degrees_of_freedom); }
};

/// F and its probability. Where nothing varies within, F is undefined, and its probability 0 where
/// something varies between.
struct FTest {
  long double f = kUndefined;
  long double p = kUndefined;
};
FTest f_test(const Variation& effect, const Variation& error);

struct Anova {
  Variation between;
  Variation within;
  FTest test;
  long double r_squared = kUndefined;
  long double residual_standard_deviation = kUndefined;
};

/// One-way analysis of variance; groups may differ in size.
/// @errors StatisticsTooFew with fewer than two groups, an empty group, or one value in each.
Result<Anova> analyse_variance(const GroupedCounts& groups);

}  // namespace fitgauge::metrology
