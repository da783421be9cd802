#pragma once

#include "metrology/statistics/zone_rules.hpp"

namespace fitgauge::metrology {

// The mean number of points until a chart signals although nothing is wrong: with limits that are
// known, and normal, independent points.

/// Of a chart of Shewhart's with rules: the Markov chain of its histories, solved exactly
/// (Champ and Woodall 1987). @pre rules is not empty
double zone_rules_run_length(ZoneRules rules);

/// Of an EWMA chart with asymptotic limits of `width` standard deviations, from its integral
/// equation (Crowder 1987). @pre kLeastLambda <= lambda <= 1
inline constexpr double kLeastLambda = 0.001;
double ewma_run_length(double lambda, double width);

/// Of a two-sided tabular CUSUM chart, both in standard deviations: the integral equation of one
/// side (Page 1954), halved. Infinite where it is longer than kLongestRun: rounding hides it then.
inline constexpr double kLongestRun = 1e9;
double cusum_run_length(double reference_value, double decision_interval);

}  // namespace fitgauge::metrology
