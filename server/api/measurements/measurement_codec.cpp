#include "api/measurements/measurement_codec.hpp"

#include <array>
#include <tuple>

#include "api/measurements/record_text.hpp"
#include "api/wire/csv_reader.hpp"
#include "base/decimal.hpp"

namespace fitgauge::api {
namespace {

using app::kMeasurementTexts;
using app::Measurement;

/// More than the names of all members, the numbers and the words of a record take together.
constexpr std::size_t kFixedRoom = 1536;

std::size_t room_for(const Measurement& m) {
  std::size_t texts = m.table_revision.size() + m.caller.value_or("").size() +
                      m.correction_reason.value_or("").size() +
                      2 * m.class_name.value_or("").size();
  for (const auto& [name, field] : kMeasurementTexts) texts += (m.texts.*field).value_or("").size();
  return kFixedRoom + RecordText::kEscaped * texts;
}

bool same_origin(const Measurement& a, const Measurement& b) {
  return a.source == b.source && a.measured_at == b.measured_at && a.received_at == b.received_at;
}

bool same_limits(const Measurement& a, const Measurement& b) {
  const auto limits = [](const Measurement& m) {
    return std::tie(m.nominal_size, m.class_name, m.feature, m.deviations, m.size_range, m.basis,
                    m.table_revision);
  };
  return limits(a) == limits(b);
}

void write_origin(RecordText& text, const Measurement& m) {
  text.raw(R"(","source":")").raw(word(m.source));
  text.raw(R"(","measured_at":")").time(m.measured_at);
  text.raw(R"(","received_at":")").time(m.received_at).raw("\"");
}

void write_limits(RecordText& text, const Measurement& m) {
  if (m.class_name) {
    text.raw(R"(,"designation":")").mm(m.nominal_size).raw(" ").escaped(*m.class_name).raw("\"");
  }
  text.raw(R"(,"nominal_mm":)").mm(m.nominal_size);
  if (m.class_name) text.raw(R"(,"tolerance_class":)").quoted(*m.class_name);
  text.raw(R"(,"feature":")").raw(word(m.feature));
  text.raw(R"(","upper_deviation_um":)").um(m.deviations.upper);
  text.raw(R"(,"lower_deviation_um":)").um(m.deviations.lower);
  text.raw(R"(,"upper_limit_mm":)").mm(m.upper_limit());
  text.raw(R"(,"lower_limit_mm":)").mm(m.lower_limit());
  text.raw(R"(,"tolerance_um":)").um(m.deviations.upper - m.deviations.lower);
  if (m.size_range) {
    text.raw(R"(,"size_range_mm":{"over":)").mm(m.size_range->over);
    text.raw(R"(,"up_to":)").mm(m.size_range->up_to).raw("}");
  }
  text.raw(R"(,"basis":")").raw(word(m.basis)).raw("\"");
  if (!m.table_revision.empty()) text.raw(R"(,"table_revision":)").quoted(m.table_revision);
}

void write_given(RecordText& text, const Measurement& m) {
  for (const auto& [name, field] : kMeasurementTexts) {
    if (const auto& given = m.texts.*field) text.raw(",\"").raw(name).raw("\":").quoted(*given);
  }
  text.raw(R"(,"rule":")").raw(word(m.rule.kind())).raw("\"");
  if (m.standard_uncertainty) text.raw(R"(,"uncertainty_um":)").um(*m.standard_uncertainty);
  if (m.coverage_factor) text.raw(R"(,"coverage_factor":)").raw(format(*m.coverage_factor));
  if (m.temperature)
    text.raw(R"(,"temperature_c":)").decimal(*m.temperature, app::kTemperatureDecimals);
  if (m.caller) text.raw(R"(,"caller":)").quoted(*m.caller);
  if (m.run_id) text.raw(R"(,"run_id":)").quoted(app::run_id_text(*m.run_id));
  if (m.cycle) text.raw(R"(,"cycle":)").decimal(*m.cycle, 0);
  if (m.correction_of) {
    text.raw(R"(,"correction_of":)").quoted(app::measurement_id_text(*m.correction_of));
  }
  if (m.correction_reason) text.raw(R"(,"reason":)").quoted(*m.correction_reason);
  if (m.corrected_by) {
    text.raw(R"(,"corrected_by":)").quoted(app::measurement_id_text(*m.corrected_by));
  }
}

}  // namespace

template <class Write>
void MeasurementWriter::write_or_copy(RecordText& text, Part& part, bool same, Write&& write) {
  const std::size_t at = text.size();
  if (same) {
    text.raw(std::string_view(out_).substr(part.at, part.size));
  } else {
    write();
  }
  part = {.at = at, .size = text.size() - at};
}

void MeasurementWriter::append(const Measurement& m) {
  RecordText text(out_, room_for(m));
  text.raw(R"({"id":")").raw(app::measurement_id_text(m.id));
  write_or_copy(text, origin_, before_ != nullptr && same_origin(*before_, m),
                [&] { write_origin(text, m); });
  write_or_copy(text, limits_, before_ != nullptr && same_limits(*before_, m),
                [&] { write_limits(text, m); });
  before_ = &m;
  text.raw(R"(,"measured_mm":)").mm(m.measured);
  text.raw(R"(,"deviation_um":)").um(m.measured - m.nominal_size);
  text.raw(R"(,"verdict":")").raw(word(m.result.verdict));
  text.raw(R"(","excess_um":)").um(m.result.excess);
  write_given(text, m);
  text.raw("}");
}

void append_measurement(std::string& out, const Measurement& m) {
  MeasurementWriter(out).append(m);
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
  text(m.temperature ? format_decimal(*m.temperature, app::kTemperatureDecimals) : "");
  const auto chosen_text = [&out](std::string_view cell) {
    append_csv_text(out, cell);
    out += ',';
  };
  for (const auto& [name, field] : kMeasurementTexts) chosen_text((m.texts.*field).value_or(""));
  chosen_text(m.caller.value_or(""));
  text(m.run_id ? app::run_id_text(*m.run_id) : "");
  text(m.cycle ? std::to_string(*m.cycle) : "");
  text(m.correction_of ? app::measurement_id_text(*m.correction_of) : "");
  append_csv_text(out, m.correction_reason.value_or(""));
  out += "\r\n";
}

void append_measurements(std::string& out, std::span<const Measurement> measurements) {
  MeasurementWriter writer(out);
  for (const Measurement& m : measurements) {
    if (&m != &measurements.front()) out += ',';
    writer.append(m);
  }
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
