#pragma once

#include <memory>
#include <vector>

#include "api/services.hpp"
#include "api/wire/response_cache.hpp"
#include "http/route.hpp"

// One function adds the routes of each resource. Services outlive the routes.

namespace fitgauge::api {

/// /v1/limits: the limits of size of one designation.
void add_limits_routes(std::vector<http::Route>& routes,
                       const std::shared_ptr<ResponseCache>& cache);
/// /v1/fits: a hole and a shaft of one nominal size, and the search for such.
void add_fits_routes(std::vector<http::Route>& routes, const Services& services,
                     const std::shared_ptr<ResponseCache>& cache);
/// /v1/gauges: sizes of GO and NO-GO gauges.
void add_gauges_routes(std::vector<http::Route>& routes,
                       const std::shared_ptr<ResponseCache>& cache);
/// /v1/press-fits: the pressure of an interference.
void add_press_fits_routes(std::vector<http::Route>& routes, const Services& services);
/// GET /v1/standards and /v1/standards/{name}: the numbers of the standards beside ISO 286.
void add_standards_routes(std::vector<http::Route>& routes,
                          const std::shared_ptr<ResponseCache>& cache);
/// /v1/tables: the tables by feature as JSON, CSV and in the control's form, and a shop's own
/// columns.
void add_tables_routes(std::vector<http::Route>& routes, const Services& services,
                       const std::shared_ptr<ResponseCache>& cache);
/// /v1/verdicts: judges a measured value and stores nothing.
void add_verdicts_routes(std::vector<http::Route>& routes, const Services& services);
/// /v1/measurements: judges and stores, reads one, lists, sums up.
void add_measurements_routes(std::vector<http::Route>& routes, const Services& services);
/// /v1/measurements/{id}/notes: what was found and done about a measurement, beside its record; and
/// /v1/catalogues: which causes and measures there are to choose from.
void add_notes_routes(std::vector<http::Route>& routes, const Services& services);
/// /v1/log and the proof of a measurement.
void add_log_routes(std::vector<http::Route>& routes, const Services& services);
/// /v1/changes: what was changed of all that decides.
void add_changes_routes(std::vector<http::Route>& routes, const Services& services);
/// /v1/log/{origin}/{from}: what stations forward.
void add_intake_routes(std::vector<http::Route>& routes, const Services& services);
/// What a centre hands on to its stations.
void add_revisions_routes(std::vector<http::Route>& routes, const Services& services);
/// GET /v1/certificates: what was measured at an order or a part, on paper or as JSON.
void add_certificates_routes(std::vector<http::Route>& routes, const Services& services);
/// /v1/statistics: figures of values that are sent; nothing is stored.
void add_statistics_routes(std::vector<http::Route>& routes, const Services& services);
/// GET /v1/measurements/{capability,chart}: figures of stored values.
void add_stored_statistics_routes(std::vector<http::Route>& routes, const Services& services);
/// GET /v1/measurements/compensation: the next offset of a machine.
void add_compensation_routes(std::vector<http::Route>& routes, const Services& services);
/// /v1/uncertainty: an uncertainty budget, computed and not stored.
void add_uncertainty_routes(std::vector<http::Route>& routes, const Services& services);
/// /v1/uncertainties and /v1/gauges-in-use: budgets and gauges that are kept under a name.
void add_documents_routes(std::vector<http::Route>& routes, const Services& services);
/// /v1/plans: inspection plans.
void add_plans_routes(std::vector<http::Route>& routes, const Services& services);
/// GET /v1/parts/{part}: the verdict of a part.
void add_parts_routes(std::vector<http::Route>& routes, const Services& services);
/// /v1/files: the control's disk.
void add_files_routes(std::vector<http::Route>& routes, const Services& services);
/// /v1/setups: machines and workpieces.
void add_setups_routes(std::vector<http::Route>& routes, const Services& services);
/// /v1/runs: programs that run on the simulated machine.
void add_runs_routes(std::vector<http::Route>& routes, const Services& services);
/// /v1/cycles: the cycles that programs may call.
void add_cycles_routes(std::vector<http::Route>& routes);
/// GET /v1/events: what happens, as Server-Sent Events.
void add_events_routes(std::vector<http::Route>& routes, const Services& services);
/// /livez, /readyz and /metrics.
void add_service_routes(std::vector<http::Route>& routes, const Services& services);
/// The web page at / and the files it is made of below /web/.
void add_page_routes(std::vector<http::Route>& routes);

}  // namespace fitgauge::api
