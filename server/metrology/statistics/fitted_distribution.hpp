#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "metrology/statistics/decimals.hpp"
#include "metrology/statistics/summary.hpp"

namespace fitgauge::metrology {

/// The distributions that ISO 22514-2:2017 fits to a characteristic.
enum class ProcessDistribution : std::uint8_t {
  Normal,
  FoldedNormal,
  Rayleigh,
  Weibull,
  Lognormal,
  Mixture
};

/// `normal`, `folded_normal`, `rayleigh`, `weibull`, `lognormal`, `mixture`.
std::string_view word(ProcessDistribution name);

/// A distribution with the parameters that are most likely for the values.
struct FittedDistribution {
  ProcessDistribution name = ProcessDistribution::Normal;
  /// normal: mean, standard deviation; folded normal and Rayleigh: scale, from 0; Weibull: shape,
  /// scale, from 0; lognormal: mean and standard deviation of the logarithm, origin, and -1 if the
  /// long tail is the lower one; mixture of two normal ones: share, mean and standard deviation of
  /// the first, mean and standard deviation of the second.
  std::array<double, 5> parameters{};
  /// Pearson's test over classes of about equal probability; a parameter costs a degree of freedom.
  /// Not made of a normal distribution that Anderson and Darling's test lets stand.
  double chi_squared = kUndefined;
  double degrees_of_freedom = kUndefined;
  double p = kUndefined;

  /// The probability of a value up to x.
  double below(double x) const;
  /// The value with that probability below it, from 0 to 1 without its ends.
  double quantile(double probability) const;
  /// The parameters with their names.
  std::vector<std::pair<std::string_view, double>> named_parameters() const;
};

/// Fewer values do not tell one distribution from another.
inline constexpr std::size_t kFewestForFit = 25;

/// The distribution with the least information criterion (Akaike 1974) among those whose test has
/// p >= 0.01; none if all are refused. Values are compared by classes between neighbouring ones, so
/// that their resolution counts for none and against none.
/// @param ranking of kFewestForFit values or more, with spread, times a power of ten
std::optional<FittedDistribution> fit_distribution(const Ranking& ranking, int scale);

}  // namespace fitgauge::metrology
