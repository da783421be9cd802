#pragma once

#include "api/services.hpp"
#include "base/json/json_writer.hpp"
#include "service/measurements/measurement_service.hpp"

namespace fitgauge::api {

/// Parameters of a list and of a summary that select measurements.
/// @param prefix of their names, if a request has several selections: `hole_`
std::vector<Parameter> measurement_filter_parameters(std::string_view prefix = {});

/// Reads the query of a request to a route with these parameters.
/// @errors QueryInvalid; DesignationMalformed and other errors of designations.
Result<app::MeasurementQuery> measurement_query(const Services& services, const Request& request,
                                                std::string_view prefix = {});

/// GET /v1/measurements: a page with its cursor, or, as CSV or NDJSON without `limit`, all that
/// match as a stream in constant memory; DFQ and XLSX are files made whole.
void list_measurements(const Services& services, const Request& request, Responder responder);

inline constexpr std::string_view kDfqType = "application/octet-stream";
inline constexpr std::string_view kQifType = "application/xml";
inline constexpr std::string_view kXlsxType =
    "application/vnd.openxmlformats-officedocument.spreadsheetml.sheet";

/// Parameters of a file in addition to those of a list.
std::vector<Parameter> download_parameters();

/// Answers with a file of the measurements that match, whole or, with a `limit`, a page of them.
/// @param media_type kDfqType, kQifType or kXlsxType. @param after the cursor.
void send_file(const Services& services, const Request& request, Responder responder,
               std::string_view media_type, app::MeasurementQuery query, std::int64_t after,
               std::optional<std::int64_t> limit);

/// The header line of the CSV form, and one line of it.
std::string measurement_csv_header();
void append_measurement_csv(std::string& out, const app::Measurement& measurement);

/// Writes `"verdicts":{…}`, with `unjudged` if there are any.
void write_verdict_counts(JsonWriter& json, const app::VerdictTally& verdicts);

/// `{"groups":[…]}`, each named by the field it is grouped by.
std::string summary_json(std::string_view group_by, std::span<const app::MeasurementGroup> groups);

}  // namespace fitgauge::api
