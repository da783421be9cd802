#pragma once

#include "metrology/statistics/control_chart.hpp"
#include "metrology/statistics/summary.hpp"

namespace fitgauge::metrology {

/// One line of a table of the analysis of variance.
struct Variation {
  std::size_t degrees_of_freedom = 0;
  Exact sum_of_squares;

  Exact mean_square() const { return sum_of_squares / whole(degrees_of_freedom); }
};

/// F and its probability. Without variation within groups F is undefined; its probability is then 0
/// if the groups differ.
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

/// The time-dependent distribution models of ISO 22514-2:2017.
enum class ProcessModel : std::uint8_t { A1, A2, B, C1, C2, C3, C4, D };

/// `A1` … `D`.
std::string_view word(ProcessModel model);
/// The model in one line.
std::string_view meaning(ProcessModel model);

/// The tests that chose the model; each a probability, compared with `significance`.
struct ModelTests {
  long double location = kUndefined;  ///< subgroup means are equal: analysis of variance
  /// Subgroup spreads are equal: Brown and Forsythe 1974, without structural zeros; undefined for
  /// subgroups of two.
  long double dispersion = kUndefined;
  long double trend = kUndefined;  ///< subgroup means have no slope: regression on their index
  std::size_t subgroup_size = 0;   ///< individual values are grouped by five
};
inline constexpr double kModelSignificance = 0.01;

struct ModelChoice {
  ProcessModel model = ProcessModel::A1;
  ModelTests tests;
};

/// Returns the model; none with fewer than five subgroups, because the tests have no power.
/// @param normal true if all values together are normal
std::optional<ModelChoice> choose_model(const Subgroups& data, bool normal);

/// The distributions that ISO 22514-2:2017 fits to a characteristic.
enum class ProcessDistribution : std::uint8_t {
  Normal,
  FoldedNormal,
  Rayleigh,
  Weibull,
  Lognormal,
  Mixture
};
constexpr std::string_view word(ProcessDistribution name) {
  return word_of(name, {"normal", "folded_normal", "rayleigh", "weibull", "lognormal", "mixture"});
}

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
