#include "api/resources.hpp"

#include <sstream>

namespace fitgauge::api {

void Routes::operator()(std::string_view head, http::Handler handler, http::Route route) {
  std::istringstream words{std::string(head)};
  std::string method;
  words >> method >> route.pattern >> route.operation >> route.access;
  if (!words) throw std::logic_error("no head of a route: " + std::string(head));
  for (int refusal = 0; words >> refusal;) route.refusals.push_back(refusal);
  if (!words.eof()) throw std::logic_error("no head of a route: " + std::string(head));
  route.method = http::method_named(method);
  route.handler = std::move(handler);
  all.push_back(std::move(route));
}

void Routes::operator()(std::string_view head, Handler handler, http::Route route) {
  const auto with_services = [&of = services, handler](const Request& request,
                                                       Responder responder) {
    handler(of, request, std::move(responder));
  };
  (*this)(head, with_services, std::move(route));
}

void Routes::group(std::string_view name) {
  for (http::Route& route : all) {
    if (route.tag.empty()) route.tag = name;
  }
}

http::RouteTable make_routes(Routes add, const Schemas& schemas) {
  struct Group {
    std::string_view tag;
    std::vector<AddRoutes*> routes;
  };
  const Group groups[] = {
      {"limits",
       {add_limits_routes, add_fits_routes, add_gauges_routes, add_standards_routes,
        add_press_fits_routes, add_verdicts_routes}},
      {"tables", {add_tables_routes}},
      {"measurements",
       {add_measurements_routes, add_notes_routes, add_certificates_routes,
        add_stored_statistics_routes, add_compensation_routes, add_parts_routes}},
      {"log", {add_log_routes, add_changes_routes, add_intake_routes, add_revisions_routes}},
      {"statistics", {add_statistics_routes, add_uncertainty_routes, add_documents_routes}},
      {"plans", {add_plans_routes, add_catalogues_routes}},
      {"files", {add_files_routes}},
      {"setups", {add_setups_routes}},
      {"runs", {add_runs_routes}},
      {"cycles", {add_cycles_routes}},
      {"service", {add_events_routes, add_service_routes, add_page_routes}},
  };
  for (const Group& group : groups) {
    for (AddRoutes* const add_some : group.routes) add_some(add);
    add.group(group.tag);
  }
  add_openapi_route(add, schemas);
  return http::RouteTable(std::move(add.all));
}

}  // namespace fitgauge::api
