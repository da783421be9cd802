#pragma once

#include "api/wire/formulas.hpp"
#include "metrology/statistics/gauge_study.hpp"

namespace fitgauge::api {

// The capability of ISO 22514-7 as part of a study: of the measuring system by a study on a master,
// of the measuring process by one on parts.

/// Data of a study in addition to its readings, in their unit.
template <bool is_process>
struct MeasuringOrder {
  double resolution = 0;
  metrology::MeasuringProcess known{};
};
template <bool is_process>
void members(auto& v, MeasuringOrder<is_process>& order) {
  using metrology::Component;
  using metrology::ComponentOf;
  static constexpr Number kStandard{.least = 0,
                                    .must = "must be a standard uncertainty, 0 or more"};
  v.member("resolution", order.resolution, kPositive, "Step of the display");
  for (std::size_t i = 0; i < metrology::kComponents.size(); ++i) {
    const auto& [name, of, meaning] = metrology::kComponents.at(i);
    const auto component = static_cast<Component>(i);
    const bool is_found = of == (is_process ? ComponentOf::Parts : ComponentOf::Master);
    if (is_found || component == Component::Re || (!is_process && component > Component::MsRest))
      continue;
    const bool is_required = of == ComponentOf::Master || component == Component::Cal;
    std::optional<double>& u = order.known[component];
    is_required ? v.member(name, u, kStandard, meaning) : v.optional(name, u, kStandard, meaning);
  }
}

template <bool is_process>
struct MeasuringAnswer {
  /// @param tolerance not a number if it is unknown
  MeasuringAnswer(const MeasuringOrder<is_process>& order, double over)
      : found(order.known), resolution(order.resolution), tolerance(over) {
    found[metrology::Component::Re] = resolution / std::sqrt(12.0);
  }
  MeasuringAnswer() = default;

  metrology::MeasuringProcess found{};
  double resolution = 0;
  double tolerance = 0;
};
template <bool is_process>
void members(auto& v, const MeasuringAnswer<is_process>& answer) {
  using metrology::Component;
  formula_members(v, is_process ? "measuring_process" : "measuring_system");
  v.member("re_percent", 100 * answer.resolution / answer.tolerance,
           "%RE, resolution in the tolerance: 5 at most");
  const std::size_t end =
      is_process ? metrology::kComponents.size() : static_cast<std::size_t>(Component::Evo);
  for (std::size_t i = 0; i < end; ++i) {
    const auto& row = metrology::kComponents.at(i);
    v.optional(row.name, answer.found.components.at(i), row.meaning);
  }
  const auto capability = [&](const std::string& of, double u, bool whole, int most) {
    const metrology::MeasuringCapability c(u, answer.tolerance, whole);
    v.member("u_" + of, u, "Combined standard uncertainty");
    v.member("q_" + of + "_percent", c.percent, fmt::format("2 U/T, k = 2: {} at most", most));
    v.member("c_" + of, c.index, "1.33 at least");
    v.member("least_tolerance_" + of, c.least_tolerance, fmt::format("At {} %", most));
  };
  capability("ms", answer.found.system(), false, 15);
  if constexpr (is_process) capability("mp", answer.found.process(), true, 30);
}

}  // namespace fitgauge::api
