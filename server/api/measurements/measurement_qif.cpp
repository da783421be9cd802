#include "api/measurements/measurement_qif.hpp"

#include "base/length.hpp"

namespace fitgauge::api {
namespace {

qif::Status status_of(gauging::Verdict verdict) {
  switch (verdict) {
    case gauging::Verdict::Good: return qif::Status::Pass;
    case gauging::Verdict::Rework: return qif::Status::Rework;
    case gauging::Verdict::Reject: return qif::Status::Fail;
    case gauging::Verdict::Unjudged: return qif::Status::Undefined;
    case gauging::Verdict::Indeterminate: break;
  }
  return qif::Status::Indeterminate;
}

/// What QIF has no place for.
std::vector<std::pair<std::string_view, std::string>> other_fields(const app::Measurement& m) {
  std::vector<std::pair<std::string_view, std::string>> fields;
  const auto add = [&](const app::MeasurementField& field) {
    if (field.text != nullptr) {
      if (m.*field.text) fields.emplace_back(field.name, *(m.*field.text));
    } else if (m.*field.number) {
      fields.emplace_back(field.name, app::number_text(field, *(m.*field.number)));
    }
  };
  for (const app::MeasurementField& field : app::kLabels) {
    if (field.name != "part_id" && field.name != "characteristic") add(field);
  }
  if (m.rule.kind() != gauging::DecisionRule::Kind::Simple) {
    fields.emplace_back("rule", word(m.rule.kind()));
  }
  if (m.coverage_factor) fields.emplace_back("coverage_factor", format(*m.coverage_factor));
  if (m.conformance) fields.emplace_back("probability", format(m.rule.probability()));
  for (const bool is_text : {false, true}) {
    for (const app::MeasurementField& field : app::kGivenFields.subspan(app::kLabels.size())) {
      if ((field.text != nullptr) == is_text) add(field);
    }
  }
  return fields;
}

}  // namespace

Result<void> add_to_qif(qif::QifWriter& writer, const app::Measurement& m) {
  if (m.source != app::Source::Gauge) {
    return Error{ErrorCode::FieldInvalid, "it is of a simulation, and no result of an inspection"};
  }
  qif::OutgoingValue value{.origin = m.origin, .number = m.id, .measured_at = m.measured_at};
  value.measured = m.measured;
  if (m.has_nominal) value.nominal = m.nominal_size;
  if (m.has_upper_limit()) value.upper = m.upper_limit();
  if (m.has_lower_limit()) value.lower = m.lower_limit();
  value.class_name = m.class_name.value_or("");
  value.quantity = m.quantity.value_or(gauging::Quantity::Diameter);
  if (m.has_feature()) value.feature = word(m.feature);
  value.status = status_of(m.result.verdict);
  value.uncertainty = m.standard_uncertainty;
  value.part_id = m.part_id;
  value.characteristic = m.characteristic;
  value.fields = other_fields(m);
  return writer.add(value);
}

}  // namespace fitgauge::api
