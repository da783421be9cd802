#include "api/measurement_codec.hpp"

#include <array>

#include "api/csv_reader.hpp"
#include "api/limits_codec.hpp"
#include "api/verdict_codec.hpp"
#include "base/decimal.hpp"

namespace fitgauge::api {
namespace {

using app::kMeasurementTexts;
using app::Measurement;

constexpr int kTemperatureScale = 6;

void write_limits_members(JsonWriter& json, const Measurement& m) {
  if (m.class_name) {
    json.member("designation", designation_text(m.nominal_size, *m.class_name));
  }
  json.member_mm("nominal_mm", m.nominal_size);
  if (m.class_name) json.member("tolerance_class", *m.class_name);
  json.member("feature", word(m.feature))
      .member_um("upper_deviation_um", m.deviations.upper)
      .member_um("lower_deviation_um", m.deviations.lower)
      .member_mm("upper_limit_mm", m.upper_limit())
      .member_mm("lower_limit_mm", m.lower_limit())
      .member_um("tolerance_um", m.deviations.upper - m.deviations.lower);
  if (m.size_range) {
    json.key("size_range_mm")
        .begin_object()
        .member_mm("over", m.size_range->over)
        .member_mm("up_to", m.size_range->up_to)
        .end_object();
  }
  json.member("basis", word(m.basis));
  if (!m.table_revision.empty()) json.member("table_revision", m.table_revision);
}

void write_given_members(JsonWriter& json, const Measurement& m) {
  for (const auto& [name, field] : kMeasurementTexts) {
    if (const auto& text = m.texts.*field) json.member(name, *text);
  }
  json.member("rule", word(m.rule.kind()));
  if (m.standard_uncertainty) json.member_um("uncertainty_um", *m.standard_uncertainty);
  if (m.coverage_factor) json.key("coverage_factor").raw(format(*m.coverage_factor));
  if (m.temperature) json.key("temperature_c").decimal(*m.temperature, kTemperatureScale);
  if (m.caller) json.member("caller", *m.caller);
  if (m.run_id) json.member("run_id", app::run_id_text(*m.run_id));
  if (m.cycle) json.member("cycle", *m.cycle);
  if (m.correction_of) {
    json.member("correction_of", app::measurement_id_text(*m.correction_of));
  }
  if (m.correction_reason) json.member("reason", *m.correction_reason);
  if (m.corrected_by) json.member("corrected_by", app::measurement_id_text(*m.corrected_by));
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

}  // namespace

void write_measurement(JsonWriter& json, const Measurement& m) {
  json.begin_object()
      .member("id", app::measurement_id_text(m.id))
      .member("source", word(m.source))
      .member("measured_at", format_rfc3339(m.measured_at))
      .member("received_at", format_rfc3339(m.received_at));
  write_limits_members(json, m);
  write_verdict_members(json, m.nominal_size, m.measured, m.result);
  write_given_members(json, m);
  json.end_object();
}

std::string measurement_csv_header() {
  std::string out =
      "id,source,measured_at,received_at,nominal_mm,tolerance_class,feature,upper_deviation_um,"
      "lower_deviation_um,upper_limit_mm,lower_limit_mm,basis,table_revision,measured_mm,"
      "deviation_um,verdict,excess_um,rule,uncertainty_um,coverage_factor,temperature_c";
  for (const auto& [name, field] : kMeasurementTexts) {
    out += ',';
    out += name;
  }
  return out += ",caller,run_id,cycle,correction_of,reason\r\n";
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
  text(app::measurement_id_text(m.id));
  text(word(m.source));
  text(format_rfc3339(m.measured_at));
  text(format_rfc3339(m.received_at));
  mm(m.nominal_size);
  text(m.class_name.value_or(""));
  text(word(m.feature));
  um(m.deviations.upper);
  um(m.deviations.lower);
  mm(m.upper_limit());
  mm(m.lower_limit());
  text(word(m.basis));
  text(m.table_revision);
  mm(m.measured);
  um(m.measured - m.nominal_size);
  text(word(m.result.verdict));
  um(m.result.excess);
  text(word(m.rule.kind()));
  text(m.standard_uncertainty ? format_um(*m.standard_uncertainty) : "");
  text(m.coverage_factor ? format(*m.coverage_factor) : "");
  text(m.temperature ? format_decimal(*m.temperature, kTemperatureScale) : "");
  for (const auto& [name, field] : kMeasurementTexts) text((m.texts.*field).value_or(""));
  text(m.caller.value_or(""));
  text(m.run_id ? app::run_id_text(*m.run_id) : "");
  text(m.cycle ? std::to_string(*m.cycle) : "");
  text(m.correction_of ? app::measurement_id_text(*m.correction_of) : "");
  append_csv_cell(out, m.correction_reason.value_or(""));
  out += "\r\n";
}

std::string accepted_json(std::span<const Measurement> measurements) {
  std::array<std::int64_t, 4> counts{};
  for (const Measurement& m : measurements) ++counts[static_cast<std::size_t>(m.result.verdict)];
  std::string out;
  JsonWriter json(out);
  json.begin_object()
      .member("accepted", std::uint64_t{measurements.size()})
      .member("first_id", app::measurement_id_text(measurements.front().id))
      .member("last_id", app::measurement_id_text(measurements.back().id));
  write_verdict_counts(json, counts[0], counts[1], counts[2], counts[3]);
  json.end_object();
  return out;
}

std::string representation_json(std::span<const Measurement> measurements) {
  std::string out;
  JsonWriter json(out);
  json.begin_object().key("measurements").begin_array();
  for (const Measurement& m : measurements) write_measurement(json, m);
  json.end_array().end_object();
  return out;
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
