#include "api/resources.hpp"
#include "api/service/metrics.hpp"
#include "base/json/json_writer.hpp"
#include "service/log/log_service.hpp"

namespace fitgauge::api {
namespace {

Response live() { return {200, "application/json", std::string(R"({"status":"live"})")}; }

Result<Response> ready(const Services& services) {
  app::Readiness readiness = services.readiness();
  if (!readiness.findings.empty()) {
    const Error& first = readiness.findings.front();
    return Error{first.code, first.message, first.where, std::move(readiness.findings)};
  }
  const auto tables = services.tables.state();
  const auto head = services.log.head();
  std::string body = json_object([&](JsonWriter& json) {
    json.member("status", "ready").member("version", kVersion);
    json.member("database", readiness.database);
    json.member("table_revision", tables->tables->revision().id);
    json.key("log").begin_object().member("name", head->checkpoint.origin);
    json.member("size", head->checkpoint.size);
    json.member("root", tlog::to_base64(head->checkpoint.root)).end_object();
  });
  return Response(200, "application/json", std::move(body)).with("Cache-Control", "no-store");
}

/// Verdicts are counted at each request; if the storage fails, the other metrics are returned.
void metrics(const Services& services, const Request&, Responder responder) {
  const SharedResponder shared = share(std::move(responder));
  services.verdicts->refresh([&services, shared] {
    shared->answer(
        Response(200, "text/plain; version=0.0.4; charset=utf-8", services.metrics.text()));
  });
}

}  // namespace

void add_service_schemas(Schemas& schemas) {
  schemas.push_back({"Resync", schema::object({{"detail", schema::text(),
                                                "Events were lost: read the lists again"}})});
  schemas.push_back(
      {"TableChanged",
       schema::object({{"feature", feature_words(), "Table: hole or shaft"},
                       {"tolerance_class", schema::text(), "The tolerance class that changed"},
                       {"table_revision", schema::text(), "Revision in force from now on"}})});
  // A measurement has the members of a changed table too.
  std::string table_changed = schema::event("table.changed", "TableChanged");
  table_changed.insert(1, R"("properties":{"measured_mm":false},)");
  schemas.push_back({"Event", schema::one_of({schema::event("measurement.recorded, verdict.reject",
                                                            "Measurement"),
                                              schema::event("run.finished", "RunFinished"),
                                              schema::event("note.added", "Note"), table_changed,
                                              schema::event("resync", "Resync")})});
  schemas.push_back({"Live", schema::object({{"status", schema::words({"live"}), ""}})});
  schemas.push_back(
      {"Ready", schema::object({
                    {"status", schema::words({"ready"}), ""},
                    {"version", schema::text(), ""},
                    {"database", schema::text(), ""},
                    {"table_revision", schema::text(), ""},
                    {"log",
                     schema::object({{"name", schema::text(), "Name of its checkpoints"},
                                     {"size", schema::count(), "Measurements in it"},
                                     {"root", schema::text(), "Root of its tree"}}),
                     "The newest signed head"},
                })});
  const std::string entry = schema::object({
      {"pointer", schema::text(), "The place in the body (RFC 6901); rows count from 0"},
      {"line", schema::count(), "Line of CSV and NDJSON, from 1", false},
      {"code", schema::text(), "Stable code"},
      {"detail", schema::text(), "The fault and its remedy"},
  });
  schemas.push_back(
      {"Problem",
       schema::object({
           {"type", schema::text(), "urn:fitgauge:problem: and the code"},
           {"title", schema::text(), "Meaning of the code; does not depend on the request"},
           {"status", schema::integer(400, 599), "HTTP status code"},
           {"detail", schema::text(), "The fault and its remedy"},
           {"instance", schema::text(), "Id of this request in the log"},
           {"code", schema::text(), "Stable; reference/errors.md lists all"},
           {"where", schema::text(), "The parameter or the place, if there is one", false},
           {"errors", schema::array(entry), "Every field that cannot be accepted", false},
           {"diagnostics", schema::array(schema::ref("Diagnostic")),
            "Every finding, for program.invalid", false},
           {"head", schema::ref("LogHead"), "Head of the log here, for log.position and log.forked",
            false},
       })});
  const std::string any = R"({"type":"object"})";
  schemas.push_back(
      {"Description", schema::object({{"openapi", schema::text(), "The version of OpenAPI"},
                                      {"info", any, ""},
                                      {"servers", schema::array(any), ""},
                                      {"tags", schema::array(any), "Groups of operations"},
                                      {"paths", any, "The operations"},
                                      {"components", any, "Schemas, responses, security"}})});
}

void add_service_routes(Routes& add) {
  add("GET /livez live public", [](const Request&) -> Result<Response> { return live(); },
      {.summary = "The process responds",
       .outcomes = {{.meaning = "The process responds", .schema = "Live"}}});
  add("GET /readyz ready public",
      [&services = add.services](const Request&) { return ready(services); },
      {.summary = "The service may be used: database, schema and tables are in order",
       .outcomes = {{.meaning = "No problem found", .schema = "Ready"}},
       .refusals = {503}});
  add("GET /metrics getMetrics open", metrics,
      {.summary = "Counters for Prometheus",
       .response_types = {},
       .outcomes = {{.meaning = "Prometheus text", .media_types = {"text/plain"}}}});
}

}  // namespace fitgauge::api
