#include "metrology/gauging/conformance.hpp"

#include <algorithm>
#include <cmath>

#include "metrology/gauging/decimal_digits.hpp"
#include "metrology/statistics/distributions.hpp"

namespace fitgauge::gauging {
namespace {

double in_uncertainties(Length length, Length u) {
  return static_cast<double>(length.count()) / static_cast<double>(u.count());
}

/// The probability of a value above so many standard uncertainties.
double beyond(double distance, double degrees_of_freedom) {
  if (std::isinf(degrees_of_freedom)) return metrology::normal_below(-distance);
  const auto tails = static_cast<double>(metrology::t_beyond(distance, degrees_of_freedom));
  return distance < 0 ? 1 - tails / 2 : tails / 2;
}

/// @param above, below distances of the limits from a value inside, in standard uncertainties
double outside(double above, double below, double degrees_of_freedom) {
  return beyond(above, degrees_of_freedom) + beyond(below, degrees_of_freedom);
}

}  // namespace

std::int64_t coverage_millionths(double degrees_of_freedom) {
  constexpr long double kCoverage = 0.9545L;
  constexpr long double kLargest = 1e6L;
  const long double k = metrology::t_quantile((1 + kCoverage) / 2, degrees_of_freedom);
  return std::llround(std::min(k, kLargest) * 1e6L);
}

double nonconformance_probability(const ConformanceLimits& limits, Length measured,
                                  const KnownUncertainty& uncertainty) {
  return outside(in_uncertainties(limits.upper - measured, uncertainty.u),
                 in_uncertainties(measured - limits.lower, uncertainty.u),
                 uncertainty.degrees_of_freedom);
}

double conformance_probability(const ConformanceLimits& limits, Length measured,
                               const KnownUncertainty& uncertainty) {
  return 1 - nonconformance_probability(limits, measured, uncertainty);
}

std::optional<double> guard_band_factor(Length tolerance, const KnownUncertainty& uncertainty,
                                        double probability) {
  const double width = in_uncertainties(tolerance, uncertainty.u);
  const auto conforms = [&](double guard) {
    return 1 - outside(width - guard, guard, uncertainty.degrees_of_freedom) >= probability;
  };
  // Of both limits the nearer one counts for nearly all; the other adds less than as much again.
  // The tails of Student's t reach further.
  const double far = std::isinf(uncertainty.degrees_of_freedom) ? 40 : width;
  double enough = std::min(width / 2, far);
  if (!conforms(enough)) return std::nullopt;
  double too_little = 0;
  if (conforms(too_little)) return 0;
  for (double middle = enough / 2; too_little < middle && middle < enough;
       middle = (too_little + enough) / 2) {
    (conforms(middle) ? enough : too_little) = middle;
  }
  return enough;
}

std::optional<ConformanceFigures> conformance_figures(const ConformanceLimits& limits,
                                                      Length measured,
                                                      const KnownUncertainty& uncertainty,
                                                      double probability) {
  const auto factor = guard_band_factor(limits.upper - limits.lower, uncertainty, probability);
  if (!factor) return std::nullopt;
  constexpr double kBillion = 1e9;
  constexpr double kFemtometres = 1e6;  // of a nanometre
  return ConformanceFigures{
      .probability =
          std::llround(conformance_probability(limits, measured, uncertainty) * kBillion),
      .guard_band =
          to_15_digits(*factor * static_cast<double>(uncertainty.u.count()) * kFemtometres)};
}

}  // namespace fitgauge::gauging
