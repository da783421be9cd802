#include "record/record.hpp"

#include <tuple>

#include "record/record_text.hpp"

namespace fitgauge::app {
namespace {

/// More than the names of all members, the numbers, the words and the ids of a record take
/// together.
constexpr std::size_t kFixedRoom = 2688;

std::size_t room_for(const Measurement& m) {
  std::size_t texts =
      m.table_revision.size() + m.caller.value_or("").size() +
      m.correction_reason.value_or("").size() + 2 * m.class_name.value_or("").size() +
      m.expansions.part_material.value_or("").size() +
      m.expansions.scale_material.value_or("").size() + m.uncertainty_budget.value_or("").size() +
      m.calibration_due.value_or("").size();
  for (const auto& [name, field] : kMeasurementTexts) texts += (m.texts.*field).value_or("").size();
  return kFixedRoom + RecordText::kEscaped * texts;
}

bool same_times(const Measurement& a, const Measurement& b) {
  return a.measured_at == b.measured_at && a.received_at == b.received_at;
}

bool same_limits(const Measurement& a, const Measurement& b) {
  const auto limits = [](const Measurement& m) {
    return std::tie(m.nominal_size, m.class_name, m.deviations, m.size_range, m.basis);
  };
  return limits(a) == limits(b);
}

}  // namespace

template <class Write>
void RecordWriter::write_or_copy(RecordText& text, Part part, bool same, Write&& write) {
  Place& place = parts_.at(part);
  const std::size_t at = text.size();
  if (same) {
    text.raw(std::string_view(out_).substr(place.at, place.size));
  } else {
    write();
  }
  place = {.at = at, .size = text.size() - at};
}

void RecordWriter::append(const Measurement& m) {
  const bool times = before_ != nullptr && same_times(*before_, m);
  const bool limits = before_ != nullptr && same_limits(*before_, m);
  before_ = &m;
  RecordText text(out_, room_for(m));
  const auto given = [&text](std::string_view name, const std::optional<std::string_view>& value) {
    if (value) text.raw(",\"").raw(name).raw("\":").quoted(*value);
  };
  const auto millionths = [&text](std::string_view name, const std::optional<std::int64_t>& value) {
    if (value) text.raw(",\"").raw(name).raw("\":").decimal(*value, kTemperatureDecimals);
  };
  const MeasurementTexts& texts = m.texts;
  // Sorted by the names of the members; a test compares it with an RFC 8785 form made elsewhere.
  text.raw("{");
  if (m.added_uncertainty) {
    text.raw(R"("added_uncertainty_um":)")
        .decimal(*m.added_uncertainty, kPicometreDecimals)
        .raw(",");
  }
  text.raw(R"("basis":")").raw(word(m.basis)).raw("\"");
  if (m.calibration_due) {
    given("calibration_due", m.calibration_due);
    text.raw(R"(,"calibration_overdue":true)");
  }
  given("caller", m.caller);
  given("characteristic", texts.characteristic);
  given("comment", texts.comment);
  if (m.conflict) text.raw(R"(,"conflict":true)");
  if (m.conformance) {
    text.raw(R"(,"conformance_probability":)").billionths(m.conformance->probability);
  }
  if (m.corrected_by) {
    const std::string_view origin =
        m.corrected_by_origin.empty() ? m.origin : m.corrected_by_origin;
    given("corrected_by", measurement_id_text(*m.corrected_by, origin));
  }
  if (m.corrected) text.raw(R"(,"corrected_mm":)").mm(*m.corrected);
  if (m.correction_of) given("correction_of", corrected_id_text(m));
  if (m.coverage_factor) text.raw(R"(,"coverage_factor":)").raw(format(*m.coverage_factor));
  if (m.cycle) text.raw(R"(,"cycle":)").decimal(*m.cycle, 0);
  write_or_copy(text, Designation, limits, [&] {
    if (!m.class_name) return;
    if (m.basis == LimitsBasis::Standard) {
      std::string designation;
      standards::append_designation(designation, m.nominal_size, *m.class_name);
      text.raw(R"(,"designation":)").quoted(designation);
      return;
    }
    text.raw(R"(,"designation":")").mm(m.nominal_size).raw(" ").escaped(*m.class_name).raw("\"");
  });
  text.raw(R"(,"deviation_um":)").um(m.decisive() - m.nominal_size);
  text.raw(R"(,"excess_um":)").um(m.result.excess);
  text.raw(R"(,"feature":")").raw(word(m.feature)).raw("\"");
  given("gauge", texts.gauge);
  if (m.conformance) text.raw(R"(,"guard_band_um":)").billionths(m.conformance->guard_band);
  text.raw(R"(,"id":")").raw(measurement_id_text(m.id, m.origin)).raw("\"");
  write_or_copy(text, LowerLimit, limits, [&] {
    if (!m.has_lower_limit()) return;
    text.raw(R"(,"lower_deviation_um":)").um(m.deviations.lower);
    text.raw(R"(,"lower_limit_mm":)").mm(m.lower_limit());
  });
  given("machine", texts.machine);
  write_or_copy(text, MeasuredAt, times,
                [&] { text.raw(R"(,"measured_at":")").time(m.measured_at); });
  text.raw(R"(","measured_mm":)").mm(m.measured);
  write_or_copy(text, Nominal, limits, [&] { text.raw(R"(,"nominal_mm":)").mm(m.nominal_size); });
  given("operation", texts.operation);
  given("operator", texts.operator_id);
  given("order", texts.order);
  millionths("part_expansion_um_per_m_k", m.expansions.part);
  millionths("part_expansion_uncertainty_um_per_m_k", m.expansions.part_uncertainty);
  given("part_id", texts.part_id);
  given("part_material", m.expansions.part_material);
  if (m.conformance) text.raw(R"(,"probability":)").raw(format(m.rule.probability()));
  given("reason", m.correction_reason);
  write_or_copy(text, ReceivedAt, times,
                [&] { text.raw(R"(,"received_at":")").time(m.received_at); });
  text.raw(R"(","rule":")").raw(word(m.rule.kind())).raw("\"");
  if (m.run_id) given("run_id", run_id_text(*m.run_id, m.origin));
  millionths("scale_expansion_um_per_m_k", m.expansions.scale);
  millionths("scale_expansion_uncertainty_um_per_m_k", m.expansions.scale_uncertainty);
  given("scale_material", m.expansions.scale_material);
  millionths("scale_temperature_c", m.expansions.scale_temperature);
  millionths("scale_temperature_uncertainty_c", m.expansions.scale_temperature_uncertainty);
  write_or_copy(text, SizeRange, limits, [&] {
    if (!m.size_range) return;
    text.raw(R"(,"size_range_mm":{"over":)").mm(m.size_range->over);
    text.raw(R"(,"up_to":)").mm(m.size_range->up_to).raw("}");
  });
  text.raw(R"(,"source":")").raw(word(m.source)).raw("\"");
  given("subgroup", texts.subgroup);
  if (!m.table_revision.empty()) given("table_revision", m.table_revision);
  millionths("temperature_c", m.temperature);
  millionths("temperature_uncertainty_c", m.expansions.temperature_uncertainty);
  given("tolerance_class", m.class_name);
  if (m.has_upper_limit() && m.has_lower_limit()) {
    text.raw(R"(,"tolerance_um":)").um(m.deviations.upper - m.deviations.lower);
  }
  given("uncertainty", m.uncertainty_budget);
  if (m.standard_uncertainty) text.raw(R"(,"uncertainty_um":)").um(*m.standard_uncertainty);
  given("unit", texts.unit);
  write_or_copy(text, UpperLimit, limits, [&] {
    if (!m.has_upper_limit()) return;
    text.raw(R"(,"upper_deviation_um":)").um(m.deviations.upper);
    text.raw(R"(,"upper_limit_mm":)").mm(m.upper_limit());
  });
  text.raw(R"(,"verdict":")").raw(word(m.result.verdict)).raw("\"}");
}

void append_record(std::string& out, const Measurement& measurement) {
  RecordWriter(out).append(measurement);
}

}  // namespace fitgauge::app
