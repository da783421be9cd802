#include "metrology/statistics/capability.hpp"

namespace fitgauge::metrology {
namespace {

/// The intervals of n values.
class Intervals {
 public:
  Intervals(std::size_t n, long double confidence)
      : n_(static_cast<long double>(n)), tail_((1 - confidence) / 2) {}

  /// A ratio of widths: chi-square with n - 1 (Kotz and Lovelace 1998, 2.4).
  CapabilityIndex of_width(long double value) const { return by_chi_square(value, n_ - 1); }

  /// A distance over a width: normal (Bissell 1990).
  CapabilityIndex of_distance(long double value) const {
    const long double error = std::sqrt(1 / (9 * n_) + value * value / (2 * (n_ - 1)));
    const long double reach = -normal_quantile(tail_) * error;
    return {value, value - reach, value + reach};
  }

  /// A width over the root of the mean square from the target (Boyles 1991).
  /// @param xi distance of the mean from the target in standard deviations
  CapabilityIndex about_target(long double value, long double xi) const {
    const long double square = xi * xi;
    return by_chi_square(value, n_ * (1 + square) * (1 + square) / (1 + 2 * square));
  }

 private:
  CapabilityIndex by_chi_square(long double value, long double freedom) const {
    return {value, value * std::sqrt(chi_squared_quantile(tail_, freedom) / freedom),
            value * std::sqrt(chi_squared_quantile(1 - tail_, freedom) / freedom)};
  }

  long double n_;
  long double tail_;
};

std::optional<long double> smaller(const std::optional<long double>& a,
                                   const std::optional<long double>& b) {
  if (!a) return b;
  return b ? std::min(*a, *b) : a;
}

/// The distances of the mean from the limits, exact before they are rounded.
struct Distances {
  std::optional<long double> width{};
  std::optional<long double> below{};  ///< mean - lower
  std::optional<long double> above{};  ///< upper - mean
};

Distances distances_of(const SpecificationLimits& limits, const Exact& mean) {
  Distances distances;
  if (limits.lower) distances.below = nearest(mean - *limits.lower);
  if (limits.upper) distances.above = nearest(*limits.upper - mean);
  if (limits.lower && limits.upper) distances.width = nearest(*limits.upper - *limits.lower);
  return distances;
}

void set_indices(Capability& capability, const Distances& distances, const Intervals& intervals) {
  const auto width = [&](long double sigma) -> std::optional<CapabilityIndex> {
    if (!distances.width) return std::nullopt;
    return intervals.of_width(*distances.width / (6 * sigma));
  };
  const auto distance = [&](const std::optional<long double>& of,
                            long double sigma) -> std::optional<CapabilityIndex> {
    if (!of) return std::nullopt;
    return intervals.of_distance(*of / (3 * sigma));
  };
  const auto nearer = smaller(distances.below, distances.above);
  if (capability.within > 0) {
    capability.cp = width(capability.within);
    capability.cpl = distance(distances.below, capability.within);
    capability.cpu = distance(distances.above, capability.within);
    capability.cpk = distance(nearer, capability.within);
  }
  capability.pp = width(capability.overall);
  capability.ppk = distance(nearer, capability.overall);
  capability.cm = capability.pp;
  capability.cmk = capability.ppk;
}

void set_cpm(Capability& capability, const SpecificationLimits& limits, const Exact& mean,
             const Intervals& intervals) {
  const bool both = limits.lower && limits.upper;
  if (!both && !limits.target) return;
  const Exact target = limits.target ? *limits.target : (*limits.lower + *limits.upper) / 2;
  const long double off = nearest(mean - target);
  const long double root = std::hypot(capability.overall, off);
  // With one limit the part between it and the target counts twice.
  const Exact width = both           ? *limits.upper - *limits.lower
                      : limits.upper ? 2 * (*limits.upper - target)
                                     : 2 * (target - *limits.lower);
  capability.cpm = intervals.about_target(nearest(width) / (6 * root), off / capability.overall);
}

PercentileCapability by_percentiles(const FittedDistribution& fit,
                                    const SpecificationLimits& limits) {
  const long double low = fit.quantile(0.00135);
  const long double middle = fit.quantile(0.5);
  const long double high = fit.quantile(0.99865);
  PercentileCapability result{.x_0135 = low, .x_50 = middle, .x_99865 = high};
  if (limits.upper) result.above = (nearest(*limits.upper) - middle) / (high - middle);
  if (limits.lower) result.below = (middle - nearest(*limits.lower)) / (middle - low);
  if (limits.lower && limits.upper) {
    result.pp = nearest(*limits.upper - *limits.lower) / (high - low);
  }
  result.ppk = smaller(result.above, result.below);
  return result;
}

/// In place of the indices of a normal distribution. Their intervals are not known.
void take_percentiles(Capability& capability) {
  const PercentileCapability none;
  const PercentileCapability& from = capability.percentile ? *capability.percentile : none;
  const auto index = [](const std::optional<long double>& value) {
    return value ? std::optional(CapabilityIndex{.value = *value}) : std::nullopt;
  };
  capability.pp = capability.cm = index(from.pp);
  capability.ppk = capability.cmk = index(from.ppk);
  if (!capability.percentile) capability.cpm.reset();
  if (!capability.model || capability.model->model != ProcessModel::A2) return;
  capability.cp = capability.pp;
  capability.cpk = capability.ppk;
  capability.cpl = index(from.below);
  capability.cpu = index(from.above);
}

NormalityTest normality_of(const Ranking& ranking, int scale, const Exact& mean,
                           long double standard_deviation) {
  const Exact unit(power_of_ten(scale));
  const Exact from_least = mean * unit - Exact(Integer(ranking.front()));
  return test_normality(ranking, static_cast<double>(nearest(from_least)),
                        static_cast<double>(standard_deviation * nearest(unit)));
}

void describe_distribution(Capability& capability, const Subgroups& data, const Exact& mean,
                           const SpecificationLimits& limits) {
  const Ranking ranking(data.values.counts());
  const int scale = data.values.scale();
  if (ranking.size() < kFewestForNormality) return;
  capability.normality = normality_of(ranking, scale, mean, capability.overall);
  bool is_normal = capability.normality->p >= kModelSignificance;
  if (ranking.size() < kFewestForFit) {
    capability.model = choose_model(data, is_normal);
    return;
  }
  const FittedDistribution normal{.parameters = {static_cast<double>(capability.mean),
                                                 static_cast<double>(capability.overall)}};
  capability.distribution = is_normal ? normal : fit_distribution(ranking, scale);
  is_normal =
      capability.distribution && capability.distribution->name == ProcessDistribution::Normal;
  capability.model = choose_model(data, is_normal);
  if (capability.distribution) {
    capability.percentile = by_percentiles(*capability.distribution, limits);
  }
  if (!is_normal) take_percentiles(capability);
}

Result<void> check(const SpecificationLimits& limits) {
  if (!limits.lower && !limits.upper) {
    return Error{ErrorCode::LimitsInvalid, "give lower, upper or both"};
  }
  if (limits.lower && limits.upper && *limits.lower >= *limits.upper) {
    return Error{ErrorCode::LimitsInvalid, "lower must be below upper"};
  }
  if (!limits.target) return {};
  // A limit of nature may be the target, but not the only limit.
  const bool both = limits.lower && limits.upper;
  const auto is_beyond = [both](const Exact& target, const Exact& limit) {
    return target > limit || (!both && target == limit);
  };
  if ((limits.upper && is_beyond(*limits.target, *limits.upper)) ||
      (limits.lower && is_beyond(*limits.lower, *limits.target))) {
    return Error{ErrorCode::LimitsInvalid, "the target must not be beyond a limit", "target"};
  }
  return {};
}

}  // namespace

std::optional<std::string_view> Capability::reason() const {
  if (count < kFewestForFit || distribution) return std::nullopt;
  return "the values are not normal, and no distribution of ISO 22514-2 fits them";
}

Result<Capability> assess_capability(const Subgroups& data, const SpecificationLimits& limits,
                                     long double confidence) {
  TRY(check(limits));
  auto charts = TRY(make_charts(data, {.kind = data.size > 1 ? ChartKind::XbarR : ChartKind::IMr,
                                       .rules = ZoneRules::all()}));
  charts.charts = {};  // their points are not wanted
  const Moments all = moments(data.values);
  if (all.squares == 0) {
    return Error{ErrorCode::StatisticsZeroSpread,
                 "all values are equal: a process without spread has no capability"};
  }
  Capability capability;
  capability.count = all.count;
  capability.mean = nearest(all.mean);
  capability.within = charts.standard_deviation;
  capability.overall = all.standard_deviation();
  capability.violations = std::move(charts.violations);
  capability.stable = capability.violations.empty();
  const Intervals intervals(all.count, confidence);
  set_indices(capability, distances_of(limits, all.mean), intervals);
  set_cpm(capability, limits, all.mean, intervals);
  describe_distribution(capability, data, all.mean, limits);
  return capability;
}

}  // namespace fitgauge::metrology
