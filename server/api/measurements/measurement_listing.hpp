#pragma once

#include <vector>

#include "api/services.hpp"
#include "http/route.hpp"
#include "service/measurements/measurement_service.hpp"

namespace fitgauge::api {

/// The parameters of a list and of a summary that choose measurements.
/// @param prefix of their names, where a request chooses more than once: `hole_`
std::vector<http::Parameter> measurement_filter_parameters(std::string_view prefix = {});

/// The query of a request to a route with these parameters.
/// @errors QueryInvalid; DesignationMalformed and what else a designation may be.
Result<app::MeasurementQuery> measurement_query(const Services& services,
                                                const http::Request& request,
                                                std::string_view prefix = {});

/// GET /v1/measurements: a page with its cursor, or, as CSV or NDJSON without `limit`, all that
/// match as a stream in constant memory; DFQ and XLSX are files made whole.
void list_measurements(const Services& services, const http::Request& request,
                       http::Responder responder);

}  // namespace fitgauge::api
