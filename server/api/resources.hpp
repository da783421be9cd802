#pragma once

#include "api/services.hpp"
#include "api/wire/response_cache.hpp"
#include "base/json/schema.hpp"

namespace fitgauge::api {

/// The routes of all resources; one function adds those of each. The services outlive them.
class Routes {
 public:
  using Handler = void (*)(const Services&, const Request&, Responder);

  explicit Routes(const Services& of)
      : services(of), cache(std::make_shared<ResponseCache>(of.tables)) {}

  const Services& services;
  const std::shared_ptr<ResponseCache> cache;
  std::vector<http::Route> all{};

  /// @param head method, pattern, operation, access and refusals:
  /// "GET /v1/runs/{id} getRun viewer 404". @throws std::logic_error for other words
  void operator()(std::string_view head, http::Handler handler, http::Route route);
  void operator()(std::string_view head, Handler handler, http::Route route);
  /// Groups the operations that were added since the last call.
  void group(std::string_view name);
};

/// A text in the path.
inline Parameter path_parameter(std::string name, std::string description) {
  return {.name = std::move(name),
          .place = http::ParameterPlace::Path,
          .description = std::move(description)};
}

/// A parameter of the query that may be absent: a text, or of another type.
inline Parameter query(std::string name, std::string description) {
  return {.name = std::move(name), .description = std::move(description)};
}
inline Parameter query(std::string name, http::ParameterType type, std::string description) {
  return {.name = std::move(name), .type = std::move(type), .description = std::move(description)};
}

/// Two lists of parameters as one.
inline std::vector<Parameter> operator+(std::vector<Parameter> left,
                                        const std::vector<Parameter>& right) {
  left.insert(left.end(), right.begin(), right.end());
  return left;
}

/// A body that must be JSON. @param schema its name
inline http::BodyRules json_body(std::string schema) {
  return {.use = http::BodyUse::Required,
          .media_types = {"application/json"},
          .schema = std::move(schema)};
}

/// Adds the routes of a resource.
using AddRoutes = void(Routes& add);
/// /v1/limits, /v1/fits, /v1/gauges, /v1/standards, /v1/press-fits, /v1/verdicts: nothing stored.
AddRoutes add_limits_routes, add_fits_routes, add_gauges_routes, add_standards_routes,
    add_press_fits_routes, add_verdicts_routes;
/// /v1/tables as JSON, CSV and in the control's form, and a shop's own columns.
AddRoutes add_tables_routes;
/// /v1/measurements with notes, capability, chart and compensation, /v1/certificates, /v1/parts.
AddRoutes add_measurements_routes, add_notes_routes, add_certificates_routes,
    add_stored_statistics_routes, add_compensation_routes, add_parts_routes;
/// /v1/log and proofs, /v1/changes, what stations forward, and a centre's revisions for them.
AddRoutes add_log_routes, add_changes_routes, add_intake_routes, add_revisions_routes;
/// /v1/statistics and /v1/uncertainty, which store nothing; /v1/uncertainties, /v1/gauges-in-use
/// and /v1/studies: named documents.
AddRoutes add_statistics_routes, add_uncertainty_routes, add_documents_routes;
/// /v1/plans and /v1/catalogues; /v1/files; /v1/setups; /v1/runs; /v1/cycles.
AddRoutes add_plans_routes, add_catalogues_routes, add_files_routes, add_setups_routes,
    add_runs_routes, add_cycles_routes;
/// /v1/events, the health checks, /metrics and the web page.
AddRoutes add_events_routes, add_service_routes, add_page_routes;

/// The plan of a part, if one alone fits, and its characteristics without a value.
struct PlanOfPart {
  std::optional<std::string> plan{};
  std::vector<std::string> missing{};
};
/// Gives the plan of a part. @errors as the answer of the part has.
void find_plan_of(const Services& services, std::string_view part,
                  std::function<void(Result<PlanOfPart>)> done);

/// Every operation of the service, with /openapi.json, which describes all other operations.
/// @param of_plant, schemas the routes and the components of the rooms above
http::RouteTable make_routes(Routes of_plant, const Schemas& schemas);

// The components of /openapi.json: each room describes its bodies and answers.

using AddSchemas = void(Schemas& schemas);
AddSchemas add_limits_schemas, add_gauges_schemas, add_statistics_schemas, add_uncertainty_schemas,
    add_changes_schemas, add_documents_schemas, add_compensation_schemas, add_measurement_schemas,
    add_note_schemas, add_table_schemas, add_plan_schemas, add_parts_schemas, add_file_schemas,
    add_setup_schemas, add_run_schemas, add_diagnostic_schemas, add_cycle_schemas,
    add_service_schemas;

/// @param of_plant resources of the rooms above
Schemas make_schemas(const Schemas& of_plant = {});

// Texts that several rooms share.

/// The limits of a class; with explicit limits the fields of the tables are absent.
schema::Fields limits_fields();
/// The measured value and its verdict, to add to the limits.
schema::Fields verdict_fields();
schema::Fields warnings_field();
/// The values of a fit that filters select.
std::string stored_clearance_schema();

/// The formula of an answer.
schema::Fields formula_fields();

inline std::string verdict_words() {
  return schema::words({"good", "rework", "reject", "indeterminate"});
}
std::string quantity_words();
inline std::string feature_words() { return schema::words({"hole", "shaft"}); }
inline std::string rule_words() { return schema::words({"simple", "guard_band", "conformance"}); }
inline std::string source_words() { return schema::words({"gauge", "simulation"}); }

/// The content of examples.json.
extern const std::string_view kExamples;
/// Gives each schema its example: from examples.json, or from the examples of its members.
void add_examples(Schemas& schemas);

/// The OpenAPI 3.1 document of the routes. @param of_plant as make_schemas
std::string openapi_json(const std::vector<http::Route>& routes, const Schemas& of_plant);

/// Adds GET /openapi.json, which describes the routes before it and itself.
void add_openapi_route(Routes& add, const Schemas& of_plant);

}  // namespace fitgauge::api
