#include "api/statistics/uncertainty_resource.hpp"

#include "api/resources.hpp"
#include "api/statistics/computation.hpp"
#include "api/wire/formulas.hpp"
#include "base/json/field_reader.hpp"
#include "base/json/json_writer.hpp"
#include "service/measurements/uncertainty_budget.hpp"

namespace fitgauge::api {

Result<std::string> compute_uncertainty(const JsonValue& body) {
  const auto read = read_uncertainty_budget(body);
  if (!read) return read.error();
  const auto& [budget, simulation, combined] = *read;
  std::string out;
  JsonWriter json(out);
  json.begin_object();
  write_formula(json, "uncertainty");
  json.member("combined_standard_uncertainty", combined.combined)
      .member("effective_degrees_of_freedom", combined.degrees_of_freedom)
      .member("welch_satterthwaite", combined.welch_satterthwaite)
      .member("probability", budget.probability)
      .member("coverage_factor", combined.coverage_factor)
      .member("expanded_uncertainty", combined.expanded);
  if (simulation) {
    const auto made = metrology::simulate(budget, simulation->trials, simulation->seed);
    if (!made) {
      FieldErrors errors;
      errors.add(made.error().code, "/correlations", made.error().message);
      return *errors.take();
    }
    json.key("monte_carlo")
        .begin_object()
        .member("trials", simulation->trials)
        .member("seed", simulation->seed)
        .member("mean", made->mean)
        .member("standard_deviation", made->standard_deviation)
        .key("interval")
        .begin_object()
        .member("lower", made->lower)
        .member("upper", made->upper)
        .end_object()
        .end_object();
  }
  json.end_object();
  return out;
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
