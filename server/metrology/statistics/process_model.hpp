#pragma once

#include <cstdint>
#include <string_view>

#include "metrology/statistics/control_chart.hpp"

namespace fitgauge::metrology {

/// The time-dependent distribution models of ISO 22514-2:2017.
enum class ProcessModel : std::uint8_t { A1, A2, B, C1, C2, C3, C4, D };

/// `A1` … `D`.
std::string_view word(ProcessModel model);
/// What the model says, in one line.
std::string_view meaning(ProcessModel model);

/// What the model was chosen by; each a probability, compared with `significance`.
struct ModelTests {
  long double location = kUndefined;  ///< subgroup means are equal: analysis of variance
  /// Subgroup spreads are equal: Brown and Forsythe 1974, without structural zeros; undefined of
  /// subgroups of two.
  long double dispersion = kUndefined;
  long double trend = kUndefined;  ///< subgroup means have no slope: regression on their index
  std::size_t subgroup_size = 0;   ///< individual values are taken five by five
};
inline constexpr double kModelSignificance = 0.01;

struct ModelChoice {
  ProcessModel model = ProcessModel::A1;
  ModelTests tests;
};

/// None with fewer than five subgroups: the tests have no power.
/// @param normal whether all values together are
std::optional<ModelChoice> choose_model(const Subgroups& data, bool normal);

}  // namespace fitgauge::metrology
