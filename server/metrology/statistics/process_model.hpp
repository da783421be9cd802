#pragma once

#include "metrology/statistics/control_chart.hpp"
#include "metrology/statistics/decimals.hpp"
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

}  // namespace fitgauge::metrology
