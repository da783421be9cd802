#include "api/measurements/measurement_qif.hpp"

#include "base/decimal.hpp"

namespace fitgauge::api {
namespace {

qif::Status status_of(gauging::Verdict verdict) {
  switch (verdict) {
    case gauging::Verdict::Good: return qif::Status::Pass;
    case gauging::Verdict::Rework: return qif::Status::Rework;
    case gauging::Verdict::Reject: return qif::Status::Fail;
    case gauging::Verdict::Indeterminate: break;
  }
  return qif::Status::Indeterminate;
}

/// What QIF has no place for.
std::vector<std::pair<std::string_view, std::string>> other_fields(const app::Measurement& m) {
  std::vector<std::pair<std::string_view, std::string>> fields;
  for (const auto& [name, text] : app::kMeasurementTexts) {
    const bool has_place = name == "part_id" || name == "characteristic";
    if (!has_place && m.texts.*text) fields.emplace_back(name, *(m.texts.*text));
  }
  if (m.rule.kind() != gauging::DecisionRule::Kind::Simple) {
    fields.emplace_back("rule", word(m.rule.kind()));
  }
  if (m.coverage_factor) fields.emplace_back("coverage_factor", format(*m.coverage_factor));
  if (m.conformance) fields.emplace_back("probability", format(m.rule.probability()));
  const auto decimal = [&](std::string_view name, const std::optional<std::int64_t>& value) {
    if (value) fields.emplace_back(name, format_decimal(*value, app::kTemperatureDecimals));
  };
  decimal("temperature_c", m.temperature);
  decimal("scale_temperature_c", m.expansions.scale_temperature);
  decimal("part_expansion_um_per_m_k", m.expansions.part);
  decimal("scale_expansion_um_per_m_k", m.expansions.scale);
  decimal("temperature_uncertainty_c", m.expansions.temperature_uncertainty);
  decimal("scale_temperature_uncertainty_c", m.expansions.scale_temperature_uncertainty);
  decimal("part_expansion_uncertainty_um_per_m_k", m.expansions.part_uncertainty);
  decimal("scale_expansion_uncertainty_um_per_m_k", m.expansions.scale_uncertainty);
  if (const auto& text = m.expansions.part_material) fields.emplace_back("part_material", *text);
  if (const auto& text = m.expansions.scale_material) fields.emplace_back("scale_material", *text);
  return fields;
}

}  // namespace

Result<void> add_to_qif(qif::QifWriter& writer, const app::Measurement& m) {
  if (m.source != app::Source::Gauge) {
    return Error{ErrorCode::FieldInvalid, "it is of a simulation, and no result of an inspection"};
  }
  qif::OutgoingValue value{.origin = m.origin, .number = m.id, .measured_at = m.measured_at};
  value.measured = m.measured;
  value.nominal = m.nominal_size;
  if (m.has_upper_limit()) value.upper = m.upper_limit();
  if (m.has_lower_limit()) value.lower = m.lower_limit();
  value.class_name = m.class_name.value_or("");
  value.is_hole = m.feature == iso286::Feature::Hole;
  value.status = status_of(m.result.verdict);
  value.uncertainty = m.standard_uncertainty;
  value.part_id = m.texts.part_id;
  value.characteristic = m.texts.characteristic;
  value.fields = other_fields(m);
  return writer.add(value);
}

}  // namespace fitgauge::api
