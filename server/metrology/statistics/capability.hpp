#pragma once

#include "metrology/statistics/control_chart.hpp"
#include "metrology/statistics/decimals.hpp"
#include "metrology/statistics/process_model.hpp"
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
  /// Pearson's test over classes of about equal probability; each parameter costs a degree of
  /// freedom. Omitted for a normal distribution that the test of Anderson and Darling accepts.
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

/// Fewer values cannot distinguish distributions.
inline constexpr std::size_t kFewestForFit = 25;

/// The distribution with the least information criterion (Akaike 1974) among those whose test has
/// p >= 0.01; none if all are refused. The tests compare classes between neighbouring
/// values, so that the resolution of the values favours no distribution.
/// @param ranking of kFewestForFit values or more, with spread, times a power of ten
std::optional<FittedDistribution> fit_distribution(const Ranking& ranking, int scale);

struct SpecificationLimits {
  std::optional<Exact> lower{};
  std::optional<Exact> upper{};
  /// Target size; if absent, the middle of both limits. With one limit, a cpm needs it and is
  /// |limit - target| / 3 tau (Chan, Cheng and Spiring 1988).
  std::optional<Exact> target{};
};

/// An index with its confidence interval; the ends are undefined for a single value.
struct CapabilityIndex {
  long double value = kUndefined;
  long double lower = kUndefined;
  long double upper = kUndefined;
};

/// The percentile method of ISO 22514-2:2017: quantiles of the fitted distribution in place of
/// three standard deviations.
struct PercentileCapability {
  long double x_0135 = kUndefined;
  long double x_50 = kUndefined;
  long double x_99865 = kUndefined;
  std::optional<long double> below{};  ///< (x_50 - lower) / (x_50 - x_0135)
  std::optional<long double> above{};  ///< (upper - x_50) / (x_99865 - x_50)
  std::optional<long double> pp{};
  std::optional<long double> ppk{};
};
/// Indices that need a missing limit are absent. For values that are not normal, `pp` and `ppk` use
/// the percentile method. So do `cp`, `cpl`, `cpu` and `cpk` if location and dispersion are
/// constant; otherwise they are absent. There is no `cpm` if no distribution fits.
struct Capability {
  std::size_t count = 0;
  long double mean = 0;
  long double within = 0;  ///< standard deviation: mean range over d2, mean moving range over 1.128
  long double overall = 0;  ///< standard deviation, n - 1
  std::optional<CapabilityIndex> cp{}, cpk{}, cpl{}, cpu{}, pp{}, ppk{}, cpm{}, cm{}, cmk{};
  bool stable = false;
  std::vector<ChartViolation> violations{};  ///< of rules 1 to 4: the reasons for `stable`
  std::optional<NormalityTest> normality{};
  std::optional<ModelChoice> model{};
  /// From kFewestForFit values on; normal if the test of normality accepts it.
  std::optional<FittedDistribution> distribution{};
  std::optional<PercentileCapability> percentile{};

  /// Returns the reason why there are no indices although there are limits.
  std::optional<std::string_view> reason() const;
};

/// @param confidence of the intervals, 0 < confidence < 1
/// @errors LimitsInvalid: no limit, the lower not below the upper one, or (`where` is `target`) the
///   target beyond the one limit; StatisticsTooFew with
///   fewer than two points; StatisticsZeroSpread.
Result<Capability> assess_capability(const Subgroups& data, const SpecificationLimits& limits,
                                     long double confidence);

}  // namespace fitgauge::metrology
