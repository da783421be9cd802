#include "api/routes.hpp"

#include "api/cycles_resource.hpp"
#include "api/events_resource.hpp"
#include "api/files_resource.hpp"
#include "api/limits_resource.hpp"
#include "api/measurements_resource.hpp"
#include "api/openapi.hpp"
#include "api/page_resource.hpp"
#include "api/runs_resource.hpp"
#include "api/service_resource.hpp"
#include "api/setups_resource.hpp"
#include "api/tables_resource.hpp"
#include "api/verdicts_resource.hpp"

namespace fitgauge::api {

http::RouteTable make_routes(const Services& services) {
  std::vector<http::Route> routes;
  const auto cache = std::make_shared<ResponseCache>(services.tables);
  add_limits_routes(routes, cache);
  add_fits_routes(routes, cache);
  add_tables_routes(routes, services, cache);
  add_verdicts_routes(routes, services);
  add_measurements_routes(routes, services);
  add_files_routes(routes, services);
  add_setups_routes(routes, services);
  add_runs_routes(routes, services);
  add_cycles_routes(routes);
  add_events_routes(routes, services);
  add_service_routes(routes, services);
  add_page_routes(routes);
  add_openapi_route(routes);
  return http::RouteTable(std::move(routes));
}

}  // namespace fitgauge::api
