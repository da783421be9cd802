#pragma once

#include <span>
#include <string>

#include "api/json_writer.hpp"
#include "app/measurement.hpp"
#include "app/measurement_service.hpp"

namespace fitgauge::api {

/// The record of a measurement; fields that were not given are left out.
void write_measurement(JsonWriter& json, const app::Measurement& measurement);

/// The header line of the CSV form, and one line of it.
std::string measurement_csv_header();
void append_measurement_csv(std::string& out, const app::Measurement& measurement);

/// `{"accepted":n,"first_id":…,"last_id":…,"verdicts":{…}}`
std::string accepted_json(std::span<const app::Measurement> measurements);

/// `{"measurements":[…]}`
std::string representation_json(std::span<const app::Measurement> measurements);

/// `{"groups":[…]}`, each named by the field it is grouped by.
std::string summary_json(std::string_view group_by, std::span<const app::MeasurementGroup> groups);

}  // namespace fitgauge::api
