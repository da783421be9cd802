#include "metrology/statistics/control_chart.hpp"

#include "metrology/statistics/summary.hpp"

namespace fitgauge::metrology {
namespace {

constexpr double kWidth = 3;  ///< of the limits, in standard deviations of a point

using Counts = std::span<const Wide>;
using Phase = ChartPlan::Phase;

Wide range_of(Counts group) {
  const auto [low, high] = std::ranges::minmax_element(group);
  return *high - *low;
}

Wide moving_range(Counts counts, std::size_t i) {
  return counts[i] > counts[i - 1] ? counts[i] - counts[i - 1] : counts[i - 1] - counts[i];
}

/// Values in subgroups, and the part of them the limits come from.
class Source {
 public:
  Source(const Subgroups& data, Phase phase)
      : data_(data), phase_(phase), unit_(power_of_ten(data.values.scale())) {
    const Wide most = kExactly / static_cast<Wide>(data.size);
    const bool is_small = std::ranges::all_of(
        counts(), [most](Wide count) { return -most <= count && count <= most; });
    if (is_small && unit_ * Integer(data.size) <= Integer(kExactly)) {
      unit_of_points_ = static_cast<double>(unit_);
    }
  }

  std::size_t size() const { return data_.size; }
  std::size_t count() const { return data_.count(); }
  Phase phase() const { return phase_; }
  Counts counts() const { return data_.values.counts(); }
  Counts group(std::size_t i) const { return counts().subspan(i * size(), size()); }
  long double in_units(const Integer& sum, std::size_t of) const {
    return nearest(Exact(sum, unit_ * Integer(of)));
  }
  /// sum / of, as a point: of at most a group's counts, or a difference of two.
  double point(Wide sum, std::size_t of) const {
    if (unit_of_points_ == 0) return nearest_double(Exact(Integer(sum), unit_ * Integer(of)));
    return static_cast<double>(static_cast<std::int64_t>(sum)) /
           (unit_of_points_ * static_cast<double>(of));
  }

  Exact mean() const {
    const Counts used = counts().subspan(phase_.from * size(), (phase_.to - phase_.from) * size());
    ExactSum sum;
    for (const Wide value : used) sum.add(value);
    return {sum.value(), unit_ * Integer(used.size())};
  }
  long double mean_range() const {
    ExactSum sum;
    for (std::size_t i = phase_.from; i < phase_.to; ++i) sum.add(range_of(group(i)));
    return in_units(sum.value(), phase_.to - phase_.from);
  }
  long double deviation(std::size_t i) const {
    return moments(group(i), data_.values.scale()).standard_deviation();
  }
  long double mean_deviation() const {
    long double sum = 0;
    for (std::size_t i = phase_.from; i < phase_.to; ++i) sum += deviation(i);
    return sum / static_cast<long double>(phase_.to - phase_.from);
  }

  /// A point for each group from `first` on.
  std::vector<double> points(std::size_t first, const auto& point) const {
    std::vector<double> made;
    made.reserve(count());
    for (std::size_t i = first; i < count(); ++i) made.push_back(point(i));
    return made;
  }
  std::vector<double> means() const {
    return points(0, [this](std::size_t i) {
      Wide sum = 0;
      for (const Wide value : group(i)) sum += value;
      return point(sum, size());
    });
  }

 private:
  const Subgroups& data_;
  Phase phase_;
  Integer unit_;
  /// A double of a whole number up to here is exact, and so a quotient of two is rounded once.
  static constexpr std::int64_t kExactly = std::int64_t{1} << 52;
  double unit_of_points_ = 0;  ///< the unit, where no point's sum or divisor is above kExactly
};

/// The spread chart of a location chart: its points, their mean in control and the resulting
/// standard deviation of single values.
struct Spread {
  std::string_view name;
  std::vector<double> points;
  long double mean = 0;
  double per_mean = 1;       ///< mean of the statistic for a standard deviation of 1
  double per_deviation = 1;  ///< standard deviation of the statistic for a standard deviation of 1
};

Spread spread_of(const Source& source, ChartKind kind) {
  if (source.size() == 1) {
    const Phase phase = source.phase();
    ExactSum in_phase;
    auto points = source.points(1, [&](std::size_t i) {
      const Wide range = moving_range(source.counts(), i);
      if (phase.from < i && i < phase.to) in_phase.add(range);
      return source.point(range, 1);
    });
    return {"mr", std::move(points), source.in_units(in_phase.value(), phase.to - phase.from - 1),
            kMovingRangeDivisor, range_constants(2).d3};
  }
  if (kind == ChartKind::XbarS) {
    const auto deviation = [&](std::size_t i) { return static_cast<double>(source.deviation(i)); };
    const double c = c4(source.size());
    return {"s", source.points(0, deviation), source.mean_deviation(), c, std::sqrt(1 - c * c)};
  }
  const auto range = [&](std::size_t i) { return source.point(range_of(source.group(i)), 1); };
  const RangeConstants constants = range_constants(source.size());
  return {"r", source.points(0, range), source.mean_range(), constants.d2, constants.d3};
}

Chart spread_chart(Spread spread, long double sigma) {
  Chart chart{.name = spread.name, .points = std::move(spread.points)};
  chart.centre = sigma * spread.per_mean;
  chart.upper_limit = chart.centre + kWidth * sigma * spread.per_deviation;
  chart.lower_limit = std::max(0.0L, chart.centre - kWidth * sigma * spread.per_deviation);
  return chart;
}

/// Centre of the points, exact and rounded like the points, so that values without spread stay on
/// it exactly.
struct Centre {
  explicit Centre(const Exact& value) : exactly(nearest(value)), as_point(nearest_double(value)) {}

  long double exactly;
  double as_point;
};

Chart ewma_chart(const std::vector<double>& points, const Centre& centre, long double point_sigma,
                 double lambda) {
  Chart chart{.name = "ewma", .centre = centre.exactly};
  const long double width = kWidth * point_sigma * std::sqrt(lambda / (2 - lambda));
  chart.lower_limit = centre.exactly - width;
  chart.upper_limit = centre.exactly + width;
  long double weighted = centre.as_point;
  chart.points.reserve(points.size());
  for (const double point : points) {
    weighted += lambda * (point - weighted);
    chart.points.push_back(static_cast<double>(weighted));
  }
  return chart;
}

Chart cusum_chart(const std::vector<double>& points, const Centre& centre, long double point_sigma,
                  const ChartPlan& plan) {
  Chart chart{.name = "cusum"};
  chart.upper_limit = plan.decision_interval * point_sigma;
  chart.lower_limit = -chart.upper_limit;
  const long double slack = plan.reference_value * point_sigma;
  const long double target = centre.as_point;
  long double up = 0;
  long double down = 0;
  for (const double point : points) {
    up = std::max(0.0L, up + point - target - slack);
    down = std::min(0.0L, down + point - target + slack);
    chart.points.push_back(static_cast<double>(up));
    chart.lower_points.push_back(static_cast<double>(down));
  }
  return chart;
}

/// The lines of a location chart. For single values with a known centre and a known standard
/// deviation they are exact decimals: a value on a line is not beyond it.
struct Location {
  ZoneLines zones;
  long double lower_limit = 0;
  long double upper_limit = 0;
};

Location location_of(const ChartPlan& plan, std::size_t group_size, const Centre& centre,
                     long double point_sigma) {
  Location made;
  const bool exact = plan.centre && plan.standard_deviation && group_size == 1;
  for (int i = -3; i <= 3; ++i) {
    double& zone = i == 0  ? made.zones.centre
                   : i > 0 ? made.zones.above.at(static_cast<std::size_t>(i - 1))
                           : made.zones.below.at(static_cast<std::size_t>(-i - 1));
    long double line = centre.exactly + i * point_sigma;
    zone = i == 0 || point_sigma == 0 ? centre.as_point : static_cast<double>(line);
    if (exact) {
      const Exact there = *plan.centre + Exact(i) * *plan.standard_deviation;
      line = nearest(there);
      zone = nearest_double(there);
    }
    (i == -3 ? made.lower_limit : made.upper_limit) = line;
  }
  return made;
}

/// Rule 1 of a chart that has no zones.
void find_beyond(const Chart& chart, std::vector<ChartViolation>& violations) {
  const auto upper = static_cast<double>(chart.upper_limit);
  const auto lower = static_cast<double>(chart.lower_limit);
  for (std::size_t i = 0; i < chart.points.size(); ++i) {
    const double low = chart.lower_points.empty() ? chart.points[i] : chart.lower_points[i];
    if (chart.points[i] > upper || low < lower) violations.push_back({chart.name, 1, i});
  }
}

Result<Phase> phase_of(const Subgroups& data, const ChartPlan& plan) {
  const Phase phase = plan.phase1.value_or(Phase{0, data.count()});
  if (phase.from > phase.to || phase.to > data.count()) {
    return Error{ErrorCode::FieldInvalid,
                 fmt::format("phase1 must have 0 <= from <= to <= {}", data.count()), "phase1"};
  }
  if (phase.to - phase.from < 2) {
    return Error{ErrorCode::StatisticsTooFew, "the limits of a chart need at least two points",
                 plan.phase1 ? "phase1" : ""};
  }
  return phase;
}

}  // namespace

Result<ControlCharts> make_charts(const Subgroups& data, const ChartPlan& plan) {
  const bool needs_groups = plan.kind == ChartKind::XbarR || plan.kind == ChartKind::XbarS;
  if (needs_groups && data.size < 2) {
    return Error{ErrorCode::StatisticsTooFew,
                 fmt::format("{} needs subgroups of at least two values", word(plan.kind))};
  }
  if (plan.kind == ChartKind::IMr && data.size > 1) {
    return Error{ErrorCode::FieldInvalid, "i_mr needs single values instead of subgroups"};
  }
  const auto phase = TRY(phase_of(data, plan));

  const Source source(data, phase);
  Spread spread = spread_of(source, plan.kind);
  const long double sigma =
      plan.standard_deviation ? nearest(*plan.standard_deviation) : spread.mean / spread.per_mean;
  const long double point_sigma = sigma / std::sqrt(static_cast<long double>(data.size));
  const Centre centre(plan.centre ? *plan.centre : source.mean());
  std::vector<double> points = source.means();

  ControlCharts made{.average_run_length = std::numeric_limits<double>::infinity(),
                     .standard_deviation = sigma};
  if (plan.kind == ChartKind::Ewma || plan.kind == ChartKind::Cusum) {
    const bool ewma = plan.kind == ChartKind::Ewma;
    made.charts.push_back(ewma ? ewma_chart(points, centre, point_sigma, plan.lambda)
                               : cusum_chart(points, centre, point_sigma, plan));
    if (plan.rules.has(1)) {
      find_beyond(made.charts.front(), made.violations);
      made.average_run_length =
          ewma ? ewma_run_length(plan.lambda, kWidth)
               : cusum_run_length(plan.reference_value, plan.decision_interval);
    }
    return made;
  }

  const Location location = location_of(plan, data.size, centre, point_sigma);
  const auto violations = find_violations(points, location.zones, plan.rules);
  made.violations.reserve(violations.size());
  for (const RuleViolation& found : violations) {
    made.violations.push_back({needs_groups ? "xbar" : "i", found.rule, found.index});
  }
  made.charts.push_back({.name = needs_groups ? "xbar" : "i",
                         .centre = centre.exactly,
                         .lower_limit = location.lower_limit,
                         .upper_limit = location.upper_limit,
                         .points = std::move(points)});
  made.charts.push_back(spread_chart(std::move(spread), sigma));
  if (plan.rules.has(1)) find_beyond(made.charts.back(), made.violations);
  if (!plan.rules.empty()) made.average_run_length = zone_rules_run_length(plan.rules);
  return made;
}

}  // namespace fitgauge::metrology
