#pragma once

#include "metrology/statistics/summary.hpp"

namespace fitgauge::metrology {

// Constants of control charts for subgroups of n normal values, for any n: computed from their
// definitions (ISO 7870-2, annex), not read from a table.

/// Mean and standard deviation of the range of n standard normal values.
struct RangeConstants {
  double d2 = 0;
  double d3 = 0;
};
/// @pre n >= 2
RangeConstants range_constants(std::size_t n);

/// Returns the mean of the standard deviation (n - 1) of n standard normal values. @pre n >= 2
double c4(std::size_t n);

/// Divisor of a mean moving range of two: d2 of n = 2 as tables print it, which published charts of
/// individual values use. 2 / sqrt(pi) is 0.034 % more.
inline constexpr double kMovingRangeDivisor = 1.128;

/// Rules of the Western Electric handbook (1956) for a control chart:
/// 1: a point beyond 3 standard deviations
/// 2: two of three points beyond 2 on one side
/// 3: four of five points beyond 1 on one side
/// 4: eight points in a row on one side
/// A point on a line is not beyond it.
class ZoneRules {
 public:
  static constexpr int kCount = 4;

  constexpr ZoneRules() = default;
  static constexpr ZoneRules all() { return ZoneRules(0b1111); }
  static constexpr ZoneRules only_first() { return ZoneRules(1); }

  /// @pre 1 <= rule <= kCount, for add() and has()
  constexpr void add(int rule) { bits_ = static_cast<std::uint8_t>(bits_ | (1U << (rule - 1))); }
  constexpr bool has(int rule) const { return ((bits_ >> (rule - 1)) & 1U) != 0; }
  constexpr bool empty() const { return bits_ == 0; }

  friend constexpr ZoneRules operator&(ZoneRules a, ZoneRules b) {
    return ZoneRules(static_cast<std::uint8_t>(a.bits_ & b.bits_));
  }

 private:
  friend class ZoneHistory;
  explicit constexpr ZoneRules(std::uint8_t bits) : bits_(bits) {}

  std::uint8_t bits_ = 0;
};

/// Past points of a chart that decide about the next one; a signal does not clear them.
class ZoneHistory {
 public:
  /// Number of whole standard deviations from the centre, at most 3, with its sign; for 0, `side`
  /// is the side (-1, 0 on the centre line, 1).
  struct Point {
    int zone = 0;
    int side = 0;
  };

  /// Adds a point. @returns the rules whose pattern this point completes.
  ZoneRules add(Point point) {
    const unsigned now =
        past_ << 1U | on_side(point.zone, point.side) | on_side(-point.zone, -point.side) << kSide;
    past_ = now & kPast;
    const bool outside = point.zone >= 3 || point.zone <= -3;
    return ZoneRules(
        static_cast<std::uint8_t>(unsigned{outside} | completed(now) | completed(now >> kSide)));
  }

  /// Forgets the points that no later pattern of `rules` needs. Two histories that are equal after
  /// this call give the same signals.
  void reduce(ZoneRules rules);

  friend constexpr auto operator<=>(const ZoneHistory&, const ZoneHistory&) = default;

 private:
  // Points on one side of the centre, the newest point in the lowest bit of each part:
  static constexpr unsigned kBeyond1 = 0;  ///< the last five: beyond 1?
  static constexpr unsigned kBeyond2 = 5;  ///< the last three: beyond 2?
  static constexpr unsigned kRun = 8;      ///< the last eight: on this side?
  static constexpr unsigned kSide = 16;    ///< first bit of the side below
  /// All points of each part except the oldest: the state for the next point.
  static constexpr unsigned kPastOfSide = 0b1111U << kBeyond1 | 0b11U << kBeyond2 | 0x7FU << kRun;
  static constexpr unsigned kPast = kPastOfSide | kPastOfSide << kSide;

  static unsigned on_side(int zone, int side) {
    return unsigned{zone >= 1} << kBeyond1 | unsigned{zone >= 2} << kBeyond2 |
           unsigned{side == 1} << kRun;
  }

  /// Returns the rules 2 to 4, as bits of ZoneRules, that the newest point of a side completes.
  static unsigned completed(unsigned side) {
    return kPatterns[side & 0xFFU] | unsigned{(side >> kRun & 0xFFU) == 0xFFU} << 3U;
  }
  /// Rules 2 and 3 by the points beyond 1 and beyond 2.
  static constexpr std::array<std::uint8_t, 256> kPatterns = [] {
    std::array<std::uint8_t, 256> patterns{};
    for (unsigned seen = 0; seen < patterns.size(); ++seen) {
      const unsigned beyond_1 = seen & 0b11111U;
      const unsigned beyond_2 = seen >> kBeyond2;
      const bool second = (beyond_2 & 1U) != 0 && std::popcount(beyond_2) >= 2;
      const bool third = (beyond_1 & 1U) != 0 && std::popcount(beyond_1) >= 4;
      patterns[seen] = static_cast<std::uint8_t>(unsigned{second} << 1U | unsigned{third} << 2U);
    }
    return patterns;
  }();

  unsigned past_ = 0;
};

struct RuleViolation {
  int rule = 0;
  std::size_t index = 0;  ///< of the point that completes the pattern, from 0
};

/// Lines of a location chart, rounded like its points: a point on a line is not beyond it.
struct ZoneLines {
  double centre = 0;
  std::array<double, 3> above{};  ///< 1, 2 and 3 standard deviations of a point from the centre
  std::array<double, 3> below{};
};

/// Returns the violations of a whole chart, sorted by point, then by rule.
std::vector<RuleViolation> find_violations(std::span<const double> points, const ZoneLines& lines,
                                           ZoneRules rules);

// Run length: mean number of points until a chart signals although nothing is wrong. The limits are
// known, and the points normal and independent.

/// Returns the run length of a Shewhart chart with rules. The Markov chain of its histories is
/// solved exactly (Champ and Woodall 1987). @pre rules is not empty
double zone_rules_run_length(ZoneRules rules);

/// Returns the run length of an EWMA chart with asymptotic limits of `width` standard deviations,
/// from its integral equation (Crowder 1987). @pre kLeastLambda <= lambda <= 1
inline constexpr double kLeastLambda = 0.001;
double ewma_run_length(double lambda, double width);

/// Returns the run length of a two-sided tabular CUSUM chart, with both parameters in standard
/// deviations. It is half the solution of the integral equation of one side (Page 1954). Infinite
/// beyond kLongestRun, because rounding hides longer ones.
inline constexpr double kLongestRun = 1e9;
double cusum_run_length(double reference_value, double decision_interval);

enum class ChartKind : std::uint8_t { IMr, XbarR, XbarS, Ewma, Cusum };
inline constexpr std::string_view kChartWords[] = {"i_mr", "xbar_r", "xbar_s", "ewma", "cusum"};
constexpr std::string_view word(ChartKind kind) { return word_of(kind, kChartWords); }
constexpr std::optional<ChartKind> chart_kind_from_word(std::string_view text) {
  return enum_of<ChartKind>(text, kChartWords);
}

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
