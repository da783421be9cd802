#pragma once

#include <optional>

#include "metrology/statistics/control_chart.hpp"
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

/// The percentile method of ISO 22514-2:2017: quantiles of the values themselves in place of
/// three standard deviations. Undefined below kFewestForPercentiles values.
struct PercentileCapability {
  long double x_0135 = kUndefined;
  long double x_50 = kUndefined;
  long double x_99865 = kUndefined;
  std::optional<long double> pp{};
  std::optional<long double> ppk{};
};
/// One value in 741 lies below the 0.135 % quantile.
inline constexpr std::size_t kFewestForPercentiles = 741;

/// Indices a missing limit leaves without meaning are none.
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
  std::optional<PercentileCapability> percentile{};
};

/// @param confidence of the intervals, 0 < confidence < 1
/// @errors LimitsInvalid: no limit, the lower not below the upper one, or (`where` is `target`) the
///   target beyond the one limit; StatisticsTooFew with
///   fewer than two points; StatisticsZeroSpread.
Result<Capability> assess_capability(const Subgroups& data, const SpecificationLimits& limits,
                                     long double confidence);

}  // namespace fitgauge::metrology
