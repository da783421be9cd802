#pragma once

#include "base/json/json_writer.hpp"
#include "service/measurements/measurement_service.hpp"

namespace fitgauge::api {

/// The header line of the CSV form, and one line of it.
std::string measurement_csv_header();
void append_measurement_csv(std::string& out, const app::Measurement& measurement);

/// Writes `"verdicts":{…}`, with `unjudged` if there are any.
void write_verdict_counts(JsonWriter& json, const app::VerdictTally& verdicts);

/// `{"groups":[…]}`, each named by the field it is grouped by.
std::string summary_json(std::string_view group_by, std::span<const app::MeasurementGroup> groups);

}  // namespace fitgauge::api
