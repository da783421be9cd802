#include "api/resources.hpp"

#include <sstream>

namespace fitgauge::api {

void Routes::operator()(std::string_view head, http::Handler handler, http::Route route) {
  std::istringstream words{std::string(head)};
  std::string method;
  words >> method >> route.pattern >> route.operation >> route.access;
  if (!words || !words.eof()) throw std::logic_error("no head of a route: " + std::string(head));
  route.method = http::method_named(method);
  route.handler = std::move(handler);
  all.push_back(std::move(route));
}

void Routes::operator()(std::string_view head, Handler handler, http::Route route) {
  const auto with_services = [&of = services, handler](const http::Request& request,
                                                       http::Responder responder) {
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
  add_limits_routes(add);
  add_fits_routes(add);
  add_gauges_routes(add);
  add_standards_routes(add);
  add_press_fits_routes(add);
  add_verdicts_routes(add);
  add.group("limits");
  add_tables_routes(add);
  add.group("tables");
  add_measurements_routes(add);
  add_notes_routes(add);
  add_certificates_routes(add);
  add_stored_statistics_routes(add);
  add_compensation_routes(add);
  add_parts_routes(add);
  add.group("measurements");
  add_log_routes(add);
  add_changes_routes(add);
  add_intake_routes(add);
  add_revisions_routes(add);
  add.group("log");
  add_statistics_routes(add);
  add_uncertainty_routes(add);
  add_documents_routes(add);
  add.group("statistics");
  add_plans_routes(add);
  add_catalogues_routes(add);
  add.group("plans");
  add_files_routes(add);
  add.group("files");
  add_setups_routes(add);
  add.group("setups");
  add_runs_routes(add);
  add.group("runs");
  add_cycles_routes(add);
  add.group("cycles");
  add_events_routes(add);
  add_service_routes(add);
  add_page_routes(add);
  add.group("service");
  add_openapi_route(add, schemas);
  return http::RouteTable(std::move(add.all));
}

}  // namespace fitgauge::api
