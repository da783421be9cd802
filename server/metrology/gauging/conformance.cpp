#include "metrology/gauging/conformance.hpp"

#include <algorithm>
#include <cmath>

#include "metrology/gauging/decimal_digits.hpp"

namespace fitgauge::gauging {
namespace {

double normal_below(double z) { return std::erfc(-z / std::sqrt(2.0)) / 2; }

double in_uncertainties(Length length, Length u) {
  return static_cast<double>(length.count()) / static_cast<double>(u.count());
}

/// @param above, below distances of the limits from a value inside, in standard uncertainties
double outside(double above, double below) { return normal_below(-above) + normal_below(-below); }

}  // namespace

double nonconformance_probability(const ConformanceLimits& limits, Length measured, Length u) {
  return outside(in_uncertainties(limits.upper - measured, u),
                 in_uncertainties(measured - limits.lower, u));
}

double conformance_probability(const ConformanceLimits& limits, Length measured, Length u) {
  return 1 - nonconformance_probability(limits, measured, u);
}

std::optional<double> guard_band_factor(Length tolerance, Length u, double probability) {
  const double width = in_uncertainties(tolerance, u);
  const auto conforms = [&](double guard) {
    return 1 - outside(width - guard, guard) >= probability;
  };
  // Of both limits the nearer one counts for nearly all; the other adds less than as much again.
  constexpr double kFar = 40;
  double enough = std::min(width / 2, kFar);
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
                                                      Length measured, Length u,
                                                      double probability) {
  const auto factor = guard_band_factor(limits.upper - limits.lower, u, probability);
  if (!factor) return std::nullopt;
  constexpr double kBillion = 1e9;
  constexpr double kFemtometres = 1e6;  // of a nanometre
  return ConformanceFigures{
      .probability = std::llround(conformance_probability(limits, measured, u) * kBillion),
      .guard_band = to_15_digits(*factor * static_cast<double>(u.count()) * kFemtometres)};
}

}  // namespace fitgauge::gauging
