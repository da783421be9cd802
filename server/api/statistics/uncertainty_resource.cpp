#include "api/statistics/statistics_answers.hpp"

#include "metrology/statistics/uncertainty.hpp"
#include "service/measurements/uncertainty_budget.hpp"

namespace fitgauge::api {

/// Whether the interval of the law of propagation matches the simulation (JCGM 101, 8).
struct ValidationAnswer {
  int digits = 0;
  double tolerance = 0;
  double lower = 0;
  double upper = 0;
};
void members(auto& v, const ValidationAnswer& of) {
  v.member("digits", of.digits, "Significant ones of the standard uncertainty");
  v.member("tolerance", of.tolerance, "Half a unit of the last digit");
  v.member("lower_difference", of.lower, "Difference between the lower ends of both intervals");
  v.member("upper_difference", of.upper);
  v.member("validated", std::max(of.lower, of.upper) <= of.tolerance);
}

struct SimulationAnswer {
  std::uint64_t seed = 0;
  metrology::MonteCarloResult made{};
  std::vector<ValidationAnswer> validation{};
};
struct SimulatedInterval {
  double lower = 0;
  double upper = 0;
};
void members(auto& v, const SimulatedInterval& interval) {
  v.member("lower", interval.lower);
  v.member("upper", interval.upper);
}
void members(auto& v, const SimulationAnswer& simulated) {
  const metrology::MonteCarloResult& made = simulated.made;
  v.member("trials", made.trials);
  v.member("seed", simulated.seed);
  v.member("mean", made.mean,
           "Mean of the model; without a model, mean of the deviation from the estimate");
  v.member("standard_deviation", made.standard_deviation);
  v.member("interval", SimulatedInterval{made.lower, made.upper}, "Equal probability outside");
  v.member("validation", simulated.validation,
           "Validation of expanded_uncertainty, to 1 and to 2 digits");
}

struct SensitivityAnswer {
  std::string name{};
  double sensitivity = 0;
  double contribution = 0;
};
void members(auto& v, const SensitivityAnswer& answer) {
  v.member("name", answer.name);
  v.member("sensitivity", answer.sensitivity, "Derivative of the model at the values");
  v.member("contribution", answer.contribution, "Sensitivity times standard uncertainty");
}

struct UncertaintyAnswer {
  metrology::CombinedUncertainty combined{};
  double probability = 0;
  std::optional<double> value{};
  std::optional<std::vector<SensitivityAnswer>> sensitivities{};
  std::optional<double> second_order{};
  std::optional<SimulationAnswer> simulated{};
};
void members(auto& v, const UncertaintyAnswer& answer) {
  formula_members(v, "uncertainty");
  v.member("combined_standard_uncertainty", answer.combined.combined);
  v.member("effective_degrees_of_freedom", answer.combined.degrees_of_freedom);
  v.member("welch_satterthwaite", answer.combined.welch_satterthwaite);
  v.member("probability", answer.probability);
  v.member("coverage_factor", answer.combined.coverage_factor);
  v.member("expanded_uncertainty", answer.combined.expanded);
  v.optional("value", answer.value, "Value of the model");
  v.optional("sensitivities", answer.sensitivities, "Sensitivities of the model");
  v.optional("second_order_standard_uncertainty", answer.second_order,
             "With the terms of JCGM 100, note to 5.1.2, of a model without correlations");
  v.optional("monte_carlo", answer.simulated, "Present if requested");
}

Result<std::string> compute_uncertainty(const JsonValue& body) {
  const auto read = TRY(read_uncertainty_budget(body));
  const metrology::Budget& budget = read.budget;
  UncertaintyAnswer answer{read.combined, budget.probability, read.value};
  if (budget.model) {
    std::vector<SensitivityAnswer>& to = answer.sensitivities.emplace();
    for (std::size_t i = 0; i < read.names.size(); ++i) {
      const metrology::Contribution& c = budget.contributions[i];
      to.push_back({read.names[i], c.sensitivity, c.sensitivity * c.standard_uncertainty});
    }
    answer.second_order = TRY(metrology::second_order_uncertainty(budget));
  }
  if (const auto& simulation = read.simulation) {
    const auto made = metrology::simulate(budget, *simulation);
    if (!made && made.error().code == ErrorCode::FiguresLimit) return made.error();
    if (!made) {
      const bool is_of_matrix = made.error().code == ErrorCode::FieldInvalid;
      return at_member(is_of_matrix ? "correlations" : "model", made.error());
    }
    auto& simulated = answer.simulated.emplace(SimulationAnswer{simulation->seed, *made});
    const double value = answer.value.value_or(0);
    const double expanded = answer.combined.expanded;
    for (const int digits : {1, 2}) {
      simulated.validation.push_back(
          {digits, metrology::numerical_tolerance(answer.combined.combined, digits),
           std::abs(value - expanded - made->lower), std::abs(value + expanded - made->upper)});
    }
  }
  return body_json(answer);
}

void add_uncertainty_schemas(Schemas& schemas) {
  schemas.push_back({"UncertaintyBudget", uncertainty_budget_schema()});
  schemas.push_back(answer_schema<UncertaintyAnswer>("Uncertainty"));
}

void add_uncertainty_routes(Routes& add) {
  add_computation(
      add, {"/v1/uncertainty combineUncertainties", compute_uncertainty, "UncertaintyBudget",
            "Uncertainty", "Uncertainty budget: u_c, degrees of freedom, k, U",
            "By propagation, with the derivatives of a `model`, and on request by Monte Carlo."});
}

}  // namespace fitgauge::api
