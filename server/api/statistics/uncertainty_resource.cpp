#include "api/statistics/uncertainty_resource.hpp"

#include "api/resources.hpp"
#include "api/statistics/computation.hpp"
#include "api/wire/formulas.hpp"
#include "service/measurements/uncertainty_budget.hpp"

namespace fitgauge::api {

struct SimulationAnswer {
  UncertaintySimulation order{};
  metrology::MonteCarloResult made{};
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
  v.member("trials", simulated.order.trials);
  v.member("seed", simulated.order.seed);
  v.member("mean", made.mean, "Of the deviation from the estimate");
  v.member("standard_deviation", made.standard_deviation);
  v.member("interval", SimulatedInterval{made.lower, made.upper}, "Equal probability outside");
}

struct UncertaintyAnswer {
  metrology::CombinedUncertainty combined{};
  double probability = 0;
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
  v.optional("monte_carlo", answer.simulated, "Where it was asked for");
}

Result<std::string> compute_uncertainty(const JsonValue& body) {
  const auto read = read_uncertainty_budget(body);
  if (!read) return read.error();
  UncertaintyAnswer answer{read->combined, read->budget.probability};
  if (const auto& simulation = read->simulation) {
    const auto made = metrology::simulate(read->budget, simulation->trials, simulation->seed);
    if (!made) return at_member("correlations", made.error());
    answer.simulated = SimulationAnswer{*simulation, *made};
  }
  return body_json(answer);
}

void add_uncertainty_schemas(Schemas& schemas) {
  schemas.push_back({"UncertaintyBudget", uncertainty_budget_schema()});
  schemas.push_back(answer_schema<UncertaintyAnswer>("Uncertainty"));
}

void add_uncertainty_routes(std::vector<http::Route>& routes, const Services& services) {
  routes.push_back(route_of(
      services, {.pattern = "/v1/uncertainty",
                 .compute = compute_uncertainty,
                 .summary = "Uncertainty budget: u_c, degrees of freedom, k, U",
                 .description = "By propagation, and by Monte Carlo where it is asked for.",
                 .operation = "combineUncertainties",
                 .reads = "UncertaintyBudget",
                 .answers = "Uncertainty"}));
}

}  // namespace fitgauge::api
