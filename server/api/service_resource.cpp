#include "api/service_resource.hpp"

#include "api/json_writer.hpp"
#include "api/metrics.hpp"
#include "api/version.hpp"
#include "app/readiness.hpp"
#include "app/table_catalog.hpp"

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
  std::string body;
  JsonWriter json(body);
  json.begin_object()
      .member("status", "ready")
      .member("version", kVersion)
      .member("database", readiness.database)
      .member("table_revision", std::string_view(tables->tables->revision().id))
      .end_object();
  return http::Response(200, "application/json", std::move(body)).with("Cache-Control", "no-store");
}

constexpr std::string_view kPage = R"(<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>fitgauge</title>
</head>
<body>
<h1>fitgauge</h1>
<p>Limits and fits of ISO 286, verdicts on measured diameters, and probe programs on a simulated
machine, over HTTP.</p>
<ul>
<li><a href="/v1/limits/25H7">Limits of 25 H7</a></li>
<li><a href="/v1/fits/25H7/g6">Fit 25 H7/g6</a></li>
<li><a href="/v1/verdicts/25H7?measured_mm=25.013">Verdict on a bore of 25.013 mm</a></li>
<li><a href="/v1/tables">Tables</a> (<a href="/v1/tables/hole?format=csv">holes</a>,
<a href="/v1/tables/shaft?format=csv">shafts</a> as CSV)</li>
<li><a href="/v1/measurements">Measurements</a></li>
<li><a href="/openapi.json">API description</a></li>
<li><a href="/metrics">Metrics</a>, <a href="/readyz">readiness</a></li>
</ul>
</body>
</html>
)";

}  // namespace

void add_service_routes(std::vector<http::Route>& routes, const Services& services) {
  routes.push_back({
      .pattern = "/livez",
      .handler = [](const http::Request&) -> Result<http::Response> { return live(); },
      .summary = "The process answers",
      .access = "public",
  });
  routes.push_back({
      .pattern = "/readyz",
      .handler = [&services](const http::Request&) { return ready(services); },
      .summary = "The service may be used: database, schema and tables are in order",
      .access = "public",
  });
  routes.push_back({
      .pattern = "/metrics",
      .handler = [&services](const http::Request&) -> Result<http::Response> {
        return http::Response(200, "text/plain; version=0.0.4; charset=utf-8",
                              services.metrics.text());
      },
      .summary = "Counters for Prometheus",
      .response_types = {},
      .access = "open",
  });
  routes.push_back({
      .pattern = "/",
      .handler = [page = http::prepare({200, "text/html; charset=utf-8", std::string(kPage)})](
                     const http::Request&) -> Result<http::Response> {
        return http::Response(page);
      },
      .summary = "The page",
      .response_types = {"text/html"},
      .access = "open",
  });
}

}  // namespace fitgauge::api
