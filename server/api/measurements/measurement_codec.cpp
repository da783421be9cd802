#include "api/measurements/measurement_codec.hpp"

#include "api/wire/csv_reader.hpp"
#include "base/decimal.hpp"

namespace fitgauge::api {
using app::kMeasurementTexts;
using app::Measurement;

std::string measurement_csv_header() {
  std::string out =
      "id,source,measured_at,received_at,nominal_mm,tolerance_class,feature,upper_deviation_um,"
      "lower_deviation_um,upper_limit_mm,lower_limit_mm,basis,table_revision,measured_mm,"
      "deviation_um,verdict,excess_um,rule,uncertainty_um,coverage_factor,temperature_c";
  for (const auto& [name, field] : kMeasurementTexts) {
    out += ',';
    out += name;
  }
  return out +=
         ",caller,run_id,cycle,correction_of,reason,probability,conformance_probability,"
         "guard_band_um,corrected_mm,scale_temperature_c,part_expansion_um_per_m_k,"
         "scale_expansion_um_per_m_k,part_material,scale_material,uncertainty,calibration_due,"
         "calibration_overdue\r\n";
}

void append_measurement_csv(std::string& out, const Measurement& m) {
  const auto text = [&out](std::string_view cell) {
    append_csv_cell(out, cell);
    out += ',';
  };
  const auto mm = [&out](Length length) {
    append_mm(out, length);
    out += ',';
  };
  const auto um = [&out](Length length) {
    append_um(out, length);
    out += ',';
  };
  text(app::measurement_id_text(m.id, m.origin));
  text(word(m.source));
  text(format_rfc3339(m.measured_at));
  text(format_rfc3339(m.received_at));
  mm(m.nominal_size);
  text(m.class_name.value_or(""));
  text(word(m.feature));
  text(m.has_upper_limit() ? format_um(m.deviations.upper) : "");
  text(m.has_lower_limit() ? format_um(m.deviations.lower) : "");
  text(m.has_upper_limit() ? format_mm(m.upper_limit()) : "");
  text(m.has_lower_limit() ? format_mm(m.lower_limit()) : "");
  text(word(m.basis));
  text(m.table_revision);
  mm(m.measured);
  um(m.decisive() - m.nominal_size);
  text(word(m.result.verdict));
  um(m.result.excess);
  text(word(m.rule.kind()));
  text(m.standard_uncertainty ? format_um(*m.standard_uncertainty) : "");
  text(m.coverage_factor ? format(*m.coverage_factor) : "");
  text(m.temperature ? format_decimal(*m.temperature, app::kTemperatureDecimals) : "");
  const auto chosen_text = [&out](std::string_view cell) {
    append_csv_text(out, cell);
    out += ',';
  };
  for (const auto& [name, field] : kMeasurementTexts) chosen_text((m.texts.*field).value_or(""));
  chosen_text(m.caller.value_or(""));
  text(m.run_id ? app::run_id_text(*m.run_id, m.origin) : "");
  text(m.cycle ? std::to_string(*m.cycle) : "");
  text(m.correction_of ? corrected_id_text(m) : "");
  chosen_text(m.correction_reason.value_or(""));
  const auto decimal = [&text](const std::optional<std::int64_t>& value, int scale) {
    text(value ? format_decimal(*value, scale) : "");
  };
  text(m.conformance ? format(m.rule.probability()) : "");
  const auto& figures = m.conformance;
  decimal(figures ? std::optional(figures->probability) : std::nullopt, 9);
  decimal(figures ? std::optional(figures->guard_band) : std::nullopt, 9);
  text(m.corrected ? format_mm(*m.corrected) : "");
  decimal(m.expansions.scale_temperature, app::kTemperatureDecimals);
  decimal(m.expansions.part, app::kTemperatureDecimals);
  decimal(m.expansions.scale, app::kTemperatureDecimals);
  chosen_text(m.expansions.part_material.value_or(""));
  chosen_text(m.expansions.scale_material.value_or(""));
  chosen_text(m.uncertainty_budget.value_or(""));
  text(m.calibration_due.value_or(""));
  out += m.calibration_due ? "true\r\n" : "\r\n";
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
  json.begin_object().key("groups").begin_array();
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
