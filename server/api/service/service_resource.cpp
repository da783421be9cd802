#include "api/resources.hpp"

#include "api/handlers.hpp"
#include "api/service/metrics.hpp"
#include "api/service/verdict_counts.hpp"
#include "api/service/version.hpp"
#include "base/digest.hpp"
#include "base/json/json_writer.hpp"
#include "service/log/log_service.hpp"
#include "service/state/readiness.hpp"
#include "service/tables/table_catalog.hpp"

namespace fitgauge::api {
namespace {

http::Response live() { return {200, "application/json", std::string(R"({"status":"live"})")}; }

Result<http::Response> ready(const Services& services) {
  app::Readiness readiness = services.readiness();
  if (!readiness.findings.empty()) {
    const Error& first = readiness.findings.front();
    return Error{first.code, first.message, first.where, std::move(readiness.findings)};
  }
  const auto tables = services.tables.state();
  const auto head = services.log.head();
  std::string body;
  JsonWriter json(body);
  json.begin_object()
      .member("status", "ready")
      .member("version", kVersion)
      .member("database", readiness.database)
      .member("table_revision", std::string_view(tables->tables->revision().id))
      .key("log")
      .begin_object()
      .member("name", head->checkpoint.origin)
      .member("size", head->checkpoint.size)
      .member("root", tlog::to_base64(head->checkpoint.root))
      .end_object()
      .end_object();
  return http::Response(200, "application/json", std::move(body)).with("Cache-Control", "no-store");
}

/// The verdicts are counted when somebody asks; where the storage cannot tell, the others are
/// shown.
void metrics(const Services& services, const http::Request&, http::Responder responder) {
  const SharedResponder shared = share(std::move(responder));
  services.verdicts->refresh([&services, shared] {
    shared->answer(
        http::Response(200, "text/plain; version=0.0.4; charset=utf-8", services.metrics.text()));
  });
}

}  // namespace

void add_service_routes(std::vector<http::Route>& routes, const Services& services) {
  routes.push_back({
      .pattern = "/livez",
      .handler = [](const http::Request&) -> Result<http::Response> { return live(); },
      .summary = "The process answers",
      .access = "public",
      .operation = "live",
      .tag = "service",
      .outcomes = {{.meaning = "It answers", .schema = "Live"}},
  });
  routes.push_back({
      .pattern = "/readyz",
      .handler = [&services](const http::Request&) { return ready(services); },
      .summary = "The service may be used: database, schema and tables are in order",
      .access = "public",
      .operation = "ready",
      .tag = "service",
      .outcomes = {{.meaning = "All is in order", .schema = "Ready"}},
  });
  routes.push_back({
      .pattern = "/metrics",
      .handler = with(services, metrics),
      .summary = "Counters for Prometheus",
      .response_types = {},
      .access = "open",
      .operation = "getMetrics",
      .tag = "service",
      .outcomes = {{.meaning = "Prometheus text", .media_types = {"text/plain"}}},
  });
}

}  // namespace fitgauge::api
