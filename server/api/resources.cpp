#include "api/resources.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

namespace fitgauge::api {

http::RouteTable make_routes(const Services& services, std::vector<http::Route> of_plant,
                             const Schemas& schemas) {
  std::vector<http::Route> routes;
  // The routes added since the last call stand in a group of operations.
  const auto group = [&routes](std::string_view name) {
    for (http::Route& route : routes) {
      if (route.tag.empty()) route.tag = name;
    }
  };
  const auto cache = std::make_shared<ResponseCache>(services.tables);
  add_limits_routes(routes, cache);
  add_fits_routes(routes, services, cache);
  add_gauges_routes(routes, cache);
  add_standards_routes(routes, cache);
  add_press_fits_routes(routes, services);
  add_verdicts_routes(routes, services);
  group("limits");
  add_tables_routes(routes, services, cache);
  group("tables");
  add_measurements_routes(routes, services);
  add_notes_routes(routes, services);
  add_certificates_routes(routes, services);
  add_stored_statistics_routes(routes, services);
  add_compensation_routes(routes, services);
  add_parts_routes(routes, services);
  group("measurements");
  add_log_routes(routes, services);
  add_changes_routes(routes, services);
  add_intake_routes(routes, services);
  add_revisions_routes(routes, services);
  group("log");
  add_statistics_routes(routes, services);
  add_uncertainty_routes(routes, services);
  add_documents_routes(routes, services);
  group("statistics");
  add_plans_routes(routes, services);
  add_catalogues_routes(routes, services);
  group("plans");
  add_files_routes(routes, services);
  group("files");
  add_setups_routes(routes, services);
  group("setups");
  add_runs_routes(routes, services);
  group("runs");
  add_cycles_routes(routes);
  group("cycles");
  std::move(of_plant.begin(), of_plant.end(), std::back_inserter(routes));
  add_events_routes(routes, services);
  add_service_routes(routes, services);
  add_page_routes(routes);
  group("service");
  add_openapi_route(routes, schemas);
  return http::RouteTable(std::move(routes));
}

}  // namespace fitgauge::api
