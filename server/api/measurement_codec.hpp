#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "api/json_writer.hpp"
#include "app/measurement.hpp"
#include "app/measurement_service.hpp"

namespace fitgauge::api {

/// Appends the record of a measurement as JSON; fields that were not given are left out.
void append_measurement(std::string& out, const app::Measurement& measurement);

/// Appends records, one after the other. Those of a request mostly have the same limits: these are
/// copied from the record before. Each measurement stays where it is until the next is written.
class MeasurementWriter {
 public:
  explicit MeasurementWriter(std::string& out) : out_(out) {}

  void append(const app::Measurement& measurement);

 private:
  std::string& out_;
  const app::Measurement* before_ = nullptr;
  std::size_t limits_at_ = 0;  ///< where those of the record before stand
  std::size_t limits_size_ = 0;
};

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
