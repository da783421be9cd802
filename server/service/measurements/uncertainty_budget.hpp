#pragma once

#include <cstdint>
#include <optional>

#include "base/json/json_value.hpp"
#include "base/result.hpp"
#include "metrology/statistics/uncertainty.hpp"

namespace fitgauge::api {

/// A Monte Carlo simulation that a budget asks for.
struct UncertaintySimulation {
  std::uint64_t trials = 0;
  std::uint64_t seed = 0;
};

/// A budget with its combined uncertainty.
struct UncertaintyBudget {
  metrology::Budget budget{};
  std::optional<UncertaintySimulation> simulation{};
  metrology::CombinedUncertainty combined{};
};

/// @errors RequestInvalid with every bad field.
Result<UncertaintyBudget> read_uncertainty_budget(const JsonValue& body);

/// u_c of a budget, in its unit. @errors as above.
Result<double> combined_standard_uncertainty(const JsonValue& body);

}  // namespace fitgauge::api
