#pragma once

#include <optional>

#include "metrology/statistics/control_chart.hpp"
#include "metrology/statistics/distributions.hpp"
#include "metrology/statistics/fitted_distribution.hpp"
#include "metrology/statistics/process_model.hpp"

namespace fitgauge::metrology {

struct SpecificationLimits {
  std::optional<Exact> lower{};
  std::optional<Exact> upper{};
  /// None: the middle of both limits. With one limit it has to be given for a cpm, which is then
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
/// Indices that a missing limit leaves without meaning are none. Of values that are not normal,
/// `pp` and `ppk` are those of the percentile method, `cp`, `cpl`, `cpu` and `cpk` too if location
/// and dispersion are constant; none if no distribution fits.
struct Capability {
  std::size_t count = 0;
  long double mean = 0;
  long double within = 0;  ///< standard deviation: mean range over d2, mean moving range over 1.128
  long double overall = 0;  ///< standard deviation, n - 1
  std::optional<CapabilityIndex> cp{}, cpk{}, cpl{}, cpu{}, pp{}, ppk{}, cpm{}, cm{}, cmk{};
  bool stable = false;
  std::vector<ChartViolation> violations{};  ///< of rules 1 to 4: what `stable` answers
  std::optional<NormalityTest> normality{};
  std::optional<ModelChoice> model{};
  /// From kFewestForFit values; a normal one where the test of normality has nothing against it.
  std::optional<FittedDistribution> distribution{};
  std::optional<PercentileCapability> percentile{};

  /// Why indices are none though the limits would give them.
  std::optional<std::string_view> reason() const;
};

/// @param confidence of the intervals, 0 < confidence < 1
/// @errors LimitsInvalid: no limit, the lower not below the upper one, or (`where` is `target`) the
///   target beyond the one limit; StatisticsTooFew with
///   fewer than two points; StatisticsZeroSpread.
Result<Capability> assess_capability(const Subgroups& data, const SpecificationLimits& limits,
                                     long double confidence);

}  // namespace fitgauge::metrology
