#pragma once

#include "api/services.hpp"
#include "api/wire/response_cache.hpp"
#include "base/json/schema.hpp"
#include "http/route.hpp"

namespace fitgauge::api {

/// The routes of all resources; one function adds the routes of each. The services must outlive
/// them.
class Routes {
 public:
  using Handler = void (*)(const Services&, const http::Request&, http::Responder);

  explicit Routes(const Services& of)
      : services(of), cache(std::make_shared<ResponseCache>(of.tables)) {}

  const Services& services;
  const std::shared_ptr<ResponseCache> cache;
  std::vector<http::Route> all{};

  /// @param head method, pattern, operation and access: "GET /v1/runs/{id} getRun viewer"
  /// @throws std::logic_error for another number of words
  void operator()(std::string_view head, http::Handler handler, http::Route route);
  void operator()(std::string_view head, Handler handler, http::Route route);
  /// Groups the operations that were added since the last call.
  void group(std::string_view name);
};

/// A text in the path.
inline http::Parameter path_parameter(std::string name, std::string description) {
  return {.name = std::move(name),
          .place = http::ParameterPlace::Path,
          .description = std::move(description)};
}

/// A body that must be JSON. @param schema its name
inline http::BodyRules json_body(std::string schema) {
  return {.use = http::BodyUse::Required,
          .media_types = {"application/json"},
          .schema = std::move(schema)};
}

/// /v1/limits: the limits of size of one designation.
void add_limits_routes(Routes& add);
/// /v1/fits: a hole and a shaft of one nominal size, and the search for fits.
void add_fits_routes(Routes& add);
/// /v1/gauges: sizes of GO and NO-GO gauges.
void add_gauges_routes(Routes& add);
/// /v1/press-fits: the pressure of an interference.
void add_press_fits_routes(Routes& add);
/// GET /v1/standards and /v1/standards/{name}: tables of other standards than ISO 286.
void add_standards_routes(Routes& add);
/// /v1/tables: the tables by feature as JSON, CSV and in the control's form, and a shop's own
/// columns.
void add_tables_routes(Routes& add);
/// /v1/verdicts: judges a measured value and stores nothing.
void add_verdicts_routes(Routes& add);
/// /v1/measurements: judges and stores, reads one, lists, sums up.
void add_measurements_routes(Routes& add);
/// /v1/measurements/{id}/notes: causes and actions of a measurement.
void add_notes_routes(Routes& add);
/// /v1/catalogues: lists of causes and actions to choose from.
void add_catalogues_routes(Routes& add);
/// /v1/log and the proof of a measurement.
void add_log_routes(Routes& add);
/// /v1/changes: changes of tables, documents and keys.
void add_changes_routes(Routes& add);
/// /v1/log/{origin}/{from}: what stations forward.
void add_intake_routes(Routes& add);
/// Revisions of a centre for its stations.
void add_revisions_routes(Routes& add);
/// GET /v1/certificates: the measurements of an order or a part, on paper or as JSON.
void add_certificates_routes(Routes& add);
/// /v1/statistics: figures of values that are sent; nothing is stored.
void add_statistics_routes(Routes& add);
/// GET /v1/measurements/{capability,chart}: figures of stored values.
void add_stored_statistics_routes(Routes& add);
/// GET /v1/measurements/compensation: the next offset of a machine.
void add_compensation_routes(Routes& add);
/// /v1/uncertainty: an uncertainty budget, computed and not stored.
void add_uncertainty_routes(Routes& add);
/// /v1/uncertainties, /v1/gauges-in-use and /v1/studies: named documents.
void add_documents_routes(Routes& add);
/// /v1/plans: inspection plans.
void add_plans_routes(Routes& add);
/// GET /v1/parts/{part}: the verdict of a part.
void add_parts_routes(Routes& add);
/// The plan that a part is checked against, if one alone fits, and its characteristics without a
/// value.
struct PlanOfPart {
  std::optional<std::string> plan{};
  std::vector<std::string> missing{};
};
/// Gives the plan of a part. @errors as the answer of the part has.
void find_plan_of(const Services& services, std::string_view part,
                  std::function<void(Result<PlanOfPart>)> done);
/// /v1/files: the control's disk.
void add_files_routes(Routes& add);
/// /v1/setups: machines and workpieces.
void add_setups_routes(Routes& add);
/// /v1/runs: programs that run on the simulated machine.
void add_runs_routes(Routes& add);
/// /v1/cycles: the cycles that programs may call.
void add_cycles_routes(Routes& add);
/// GET /v1/events: what happens, as Server-Sent Events.
void add_events_routes(Routes& add);
/// /livez, /readyz and /metrics.
void add_service_routes(Routes& add);
/// The web page at / and the files it is made of below /web/.
void add_page_routes(Routes& add);

/// Every operation of the service, with /openapi.json, which describes all other operations.
/// @param of_plant, schemas the routes and the components of the rooms above
http::RouteTable make_routes(Routes of_plant, const Schemas& schemas);

// The components of /openapi.json: each room describes the bodies it reads and the answers it
// gives. Setups describe themselves (runs/setup_codec.hpp).

void add_limits_schemas(Schemas& schemas);
void add_gauges_schemas(Schemas& schemas);
void add_statistics_schemas(Schemas& schemas);
void add_uncertainty_schemas(Schemas& schemas);
void add_changes_schemas(Schemas& schemas);
void add_documents_schemas(Schemas& schemas);
void add_compensation_schemas(Schemas& schemas);
void add_measurement_schemas(Schemas& schemas);
void add_note_schemas(Schemas& schemas);
void add_table_schemas(Schemas& schemas);
void add_plan_schemas(Schemas& schemas);
void add_parts_schemas(Schemas& schemas);
void add_file_schemas(Schemas& schemas);
void add_run_schemas(Schemas& schemas);
void add_diagnostic_schemas(Schemas& schemas);
void add_cycle_schemas(Schemas& schemas);
void add_service_schemas(Schemas& schemas);

/// @param of_plant resources of the rooms above
Schemas make_schemas(const Schemas& of_plant = {});

// Texts that several rooms share.

/// The limits of a class; with explicit limits the fields of the tables are absent.
schema::Fields limits_fields();
/// The measured value and its verdict, to add to the limits.
schema::Fields verdict_fields();
schema::Fields warnings_field();

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
/// Gives each schema its example: from examples.json, or from its members and the examples of their
/// schemas.
void add_examples(Schemas& schemas);

/// The OpenAPI 3.1 document of the routes. @param of_plant as make_schemas
std::string openapi_json(const std::vector<http::Route>& routes, const Schemas& of_plant);

/// Adds GET /openapi.json, which describes the routes before it and itself.
void add_openapi_route(Routes& add, const Schemas& of_plant);

}  // namespace fitgauge::api
