#include "api/measurements/measurement_codec.hpp"

#include "api/measurements/measurement_columns.hpp"
#include "api/wire/formulas.hpp"
#include "base/csv_cell.hpp"
#include "base/decimal.hpp"

namespace fitgauge::api {
namespace {

/// Cells of one line of CSV.
class CsvLine {
 public:
  explicit CsvLine(std::string& out) : out_(out) {}

  void word(std::string_view text) { sheet::append_csv_cell(next(), text); }
  void chosen(std::string_view text) { sheet::append_csv_text(next(), text); }
  void time(Timestamp time) { next() += format_rfc3339(time); }
  void mm(Length length) { append_mm(next(), length); }
  void um(Length length) { append_um(next(), length); }
  void decimal(std::int64_t value, int scale) { append_decimal(next(), value, scale); }
  void none() { next(); }

 private:
  std::string& next() {
    if (!is_first_) out_ += ',';
    is_first_ = false;
    return out_;
  }

  std::string& out_;
  bool is_first_ = true;
};

}  // namespace

std::vector<std::string> measurement_columns() {
  std::vector<std::string> names = {"id",
                                    "source",
                                    "measured_at",
                                    "received_at",
                                    "nominal_mm",
                                    "tolerance_class",
                                    "feature",
                                    "upper_deviation_um",
                                    "lower_deviation_um",
                                    "upper_limit_mm",
                                    "lower_limit_mm",
                                    "basis",
                                    "table_revision",
                                    "measured_mm",
                                    "deviation_um",
                                    "verdict",
                                    "excess_um",
                                    "rule",
                                    "uncertainty_um",
                                    "coverage_factor",
                                    "temperature_c"};
  for (const auto& [name, field] : app::kMeasurementTexts) names.emplace_back(name);
  for (const std::string_view name : {"caller",
                                      "run_id",
                                      "cycle",
                                      "correction_of",
                                      "reason",
                                      "probability",
                                      "conformance_probability",
                                      "guard_band_um",
                                      "corrected_mm",
                                      "scale_temperature_c",
                                      "part_expansion_um_per_m_k",
                                      "scale_expansion_um_per_m_k",
                                      "part_material",
                                      "scale_material",
                                      "uncertainty",
                                      "calibration_due",
                                      "calibration_overdue",
                                      "temperature_uncertainty_c",
                                      "scale_temperature_uncertainty_c",
                                      "part_expansion_uncertainty_um_per_m_k",
                                      "scale_expansion_uncertainty_um_per_m_k",
                                      "added_uncertainty_um"}) {
    names.emplace_back(name);
  }
  return names;
}

std::string measurement_csv_header() {
  std::string out;
  for (const std::string& name : measurement_columns()) {
    if (!out.empty()) out += ',';
    out += name;
  }
  return out += "\r\n";
}

void append_measurement_csv(std::string& out, const app::Measurement& measurement) {
  CsvLine line(out);
  write_columns(measurement, line);
  out += "\r\n";
}

void write_verdict_counts(JsonWriter& json, std::int64_t good, std::int64_t rework,
                          std::int64_t reject, std::int64_t indeterminate) {
  json.key("verdicts")
      .begin_object()
      .member("good", good)
      .member("rework", rework)
      .member("reject", reject)
      .member("indeterminate", indeterminate)
      .end_object();
}

std::string summary_json(std::string_view group_by, std::span<const app::MeasurementGroup> groups) {
  std::string out;
  JsonWriter json(out);
  json.begin_object();
  write_formula(json, "stored_summary");
  json.key("groups").begin_array();
  for (const app::MeasurementGroup& group : groups) {
    json.begin_object().key(group_by);
    if (group.value) {
      json.value(*group.value);
    } else {
      json.null();
    }
    json.member("count", group.count);
    write_verdict_counts(json, group.good, group.rework, group.reject, group.indeterminate);
    json.key("mean_mm").raw(group.mean_mm);
    json.key("standard_deviation_mm").raw(group.standard_deviation_mm.value_or("null"));
    json.member_mm("min_mm", group.min).member_mm("max_mm", group.max).end_object();
  }
  json.end_array().end_object();
  return out;
}

}  // namespace fitgauge::api
