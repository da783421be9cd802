#pragma once

#include "base/json/body_forms.hpp"
#include "metrology/statistics/uncertainty.hpp"

namespace fitgauge::api {

/// A Monte Carlo simulation that a budget asks for.
struct UncertaintySimulation : metrology::Simulation {
  std::int64_t most = metrology::kMostDraws / 5;  ///< trials, for this number of contributions
};

/// A budget with its combined uncertainty.
struct UncertaintyBudget {
  metrology::Budget budget{};
  std::vector<std::string> names{};  ///< of the contributions
  std::optional<double> value{};     ///< of the model at the estimates
  std::optional<UncertaintySimulation> simulation{};
  metrology::CombinedUncertainty combined{};
};

std::string uncertainty_budget_schema();

/// @errors RequestInvalid with every bad field.
Result<UncertaintyBudget> read_uncertainty_budget(const JsonValue& body);

/// The combined uncertainty of a budget, in its unit. @errors as above.
Result<metrology::CombinedUncertainty> combined_uncertainty(const JsonValue& body);

}  // namespace fitgauge::api
