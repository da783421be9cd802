#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "api/wire/json_writer.hpp"
#include "app/measurements/measurement.hpp"
#include "app/measurements/measurement_service.hpp"

namespace fitgauge::api {

class RecordText;

/// Appends the record of a measurement as JSON; fields that were not given are left out.
void append_measurement(std::string& out, const app::Measurement& measurement);

/// Appends records, one after the other. Those of a request mostly have the same times and limits:
/// these are copied from the record before. Each measurement stays where it is until the next is
/// written.
class MeasurementWriter {
 public:
  explicit MeasurementWriter(std::string& out) : out_(out) {}

  void append(const app::Measurement& measurement);

 private:
  /// Where a part of the record before stands.
  struct Part {
    std::size_t at = 0;
    std::size_t size = 0;
  };
  template <class Write>
  void write_or_copy(RecordText& text, Part& part, bool same, Write&& write);

  std::string& out_;
  const app::Measurement* before_ = nullptr;
  Part origin_;
  Part limits_;
};

/// The header line of the CSV form, and one line of it.
std::string measurement_csv_header();
void append_measurement_csv(std::string& out, const app::Measurement& measurement);

/// Appends records with a comma between two; none before the first.
void append_measurements(std::string& out, std::span<const app::Measurement> measurements);

/// Writes `"verdicts":{…}`.
void write_verdict_counts(JsonWriter& json, std::int64_t good, std::int64_t rework,
                          std::int64_t reject, std::int64_t indeterminate);

/// `{"groups":[…]}`, each named by the field it is grouped by.
std::string summary_json(std::string_view group_by, std::span<const app::MeasurementGroup> groups);

}  // namespace fitgauge::api
