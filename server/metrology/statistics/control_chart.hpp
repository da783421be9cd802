#pragma once

#include "metrology/statistics/decimals.hpp"
#include "metrology/statistics/zone_rules.hpp"

namespace fitgauge::metrology {

enum class ChartKind : std::uint8_t { IMr, XbarR, XbarS, Ewma, Cusum };

/// `i_mr`, `xbar_r`, `xbar_s`, `ewma`, `cusum`.
std::string_view word(ChartKind kind);
std::optional<ChartKind> chart_kind_from_word(std::string_view text);

/// Values in consecutive subgroups of one size; size 1: individual values.
struct Subgroups {
  Decimals values;
  std::size_t size = 1;

  std::size_t count() const { return values.size() / size; }
};

struct ChartPlan {
  ChartKind kind = ChartKind::IMr;
  ZoneRules rules{};
  /// The points the limits are computed from: from <= index < to.
  struct Phase {
    std::size_t from = 0;
    std::size_t to = 0;
  };
  std::optional<Phase> phase1{};  ///< none: all
  /// Known values in place of estimates: the mean, and the standard deviation of single values.
  std::optional<Exact> centre{};
  std::optional<Exact> standard_deviation{};
  double lambda = 0.2;           ///< weight of the newest point, EWMA
  double reference_value = 0.5;  ///< k, CUSUM, in standard deviations of a point
  double decision_interval = 5;  ///< h, in standard deviations
};

struct Chart {
  std::string_view name;
  long double centre = 0;
  long double lower_limit = 0;
  long double upper_limit = 0;
  std::vector<double> points{};
  /// Downward sums of a CUSUM chart, negative; empty for other charts.
  std::vector<double> lower_points{};
};

struct ChartViolation {
  std::string_view chart;
  int rule = 0;
  std::size_t index = 0;
};

struct ControlCharts {
  std::vector<Chart> charts{};  ///< location, then spread
  std::vector<ChartViolation> violations{};
  double average_run_length = 0;       ///< of the location chart in control; infinite without rules
  long double standard_deviation = 0;  ///< of single values: from within, or the known one
};

/// Limits are three standard deviations from the centre; a spread chart's lower one at least 0. All
/// rules watch the location chart, the first one alone a spread chart, EWMA and CUSUM.
/// @errors StatisticsTooFew: values for xbar_r and xbar_s, fewer than two points to take the limits
///   from; FieldInvalid: subgroups for i_mr, a phase outside the points. Of a phase, `where` says
///   `phase1`.
Result<ControlCharts> make_charts(const Subgroups& data, const ChartPlan& plan);

}  // namespace fitgauge::metrology
