#pragma once

#include <cstddef>

namespace fitgauge::metrology {

// The constants of control charts for subgroups of n normal values, from their definitions
// (ISO 7870-2, annex): no table, so any n will do.

/// The mean and the standard deviation of the range of n standard normal values.
struct RangeConstants {
  double d2 = 0;
  double d3 = 0;
};
/// @pre n >= 2
RangeConstants range_constants(std::size_t n);

/// The mean of the standard deviation (of n - 1) of n standard normal values. @pre n >= 2
double c4(std::size_t n);

/// What a mean moving range of two is divided by: d2 of n = 2 as tables print it, and as every
/// published chart of individual values uses it. 2 / sqrt(pi) is 0.034 % more.
inline constexpr double kMovingRangeDivisor = 1.128;

}  // namespace fitgauge::metrology
