#include "api/measurements/measurement_dfq.hpp"

#include <fmt/format.h>

#include "base/length.hpp"
#include "metrology/gauging/conformance.hpp"

namespace fitgauge::api {
namespace {

/// How a record is judged, as far as that is not by its limits alone.
std::string rule_of(const app::Measurement& m) {
  std::string rule;
  const auto say = [&rule](std::string_view name, std::string_view text) {
    if (!rule.empty()) rule += ';';
    rule += fmt::format("{}={}", name, text);
  };
  if (m.rule.kind() != gauging::DecisionRule::Kind::Simple) say("rule", word(m.rule.kind()));
  if (m.standard_uncertainty) {
    // Of the size at 20 degrees, which is what is written.
    say("uncertainty_um", format_um(gauging::combined_uncertainty(
                              *m.standard_uncertainty, m.added_uncertainty.value_or(0))));
  }
  if (m.coverage_factor) say("coverage_factor", format(*m.coverage_factor));
  if (m.degrees_of_freedom) say("degrees_of_freedom", format_decimal(*m.degrees_of_freedom, 6));
  if (m.size_operator && m.size_operator != "LP") say("size_operator", *m.size_operator);
  if (m.envelope) say("envelope", *m.envelope);
  if (m.go_gauge) say("go_gauge", *m.go_gauge);
  if (m.conformance) say("probability", format(m.rule.probability()));
  return rule;
}

}  // namespace

Result<void> add_to_dfq(aqdef::DfqWriter& writer, const app::Measurement& m) {
  if (m.source != app::Source::Gauge) {
    return Error{ErrorCode::FieldInvalid, "it is of a simulation, which a DFQ cannot say"};
  }
  const std::string rule = rule_of(m);
  aqdef::OutgoingValue value{.origin = m.origin, .number = m.id, .measured_at = m.measured_at};
  value.measured = m.decisive();
  if (m.has_nominal) value.nominal = m.nominal_size;
  if (m.has_upper_limit()) value.limits.upper = m.upper_limit();
  if (m.has_lower_limit()) value.limits.lower = m.lower_limit();
  value.class_name = m.class_name.value_or("");
  if (m.has_feature()) value.feature = word(m.feature);
  if (m.quantity && (m.quantity != gauging::Quantity::Diameter || !m.is_judged())) {
    value.quantity = word(*m.quantity);
  }
  value.rule = rule;
  value.part_id = m.part_id.value_or("");
  value.characteristic = m.characteristic.value_or("");
  value.order = m.order.value_or("");
  value.operation = m.operation.value_or("");
  value.machine = m.machine.value_or("");
  value.operator_name = m.operator_id.value_or("");
  value.gauge = m.gauge.value_or("");
  value.unit = m.unit.value_or("");
  value.comment = m.comment.value_or("");
  value.subgroup = m.subgroup.value_or("");
  return writer.add(value);
}

}  // namespace fitgauge::api
