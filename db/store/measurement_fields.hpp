#pragma once

#include <string>
#include <string_view>

#include "db/store/measurement_row.hpp"

namespace fitgauge::store {

/// Calls `field(column, value)` for what a measurement says, all but its id and hash. The one place
/// where rows and columns meet.
template <class Row, class Field>
void for_each_field(Row&& row, Field&& field) {
  field("source", row.source);
  field("measured_at", row.measured_at_ns);
  field("received_at", row.received_at_ns);
  field("nominal_nm", row.nominal_nm);
  field("tolerance_class", row.tolerance_class);
  field("feature", row.feature);
  field("upper_deviation_nm", row.upper_deviation_nm);
  field("lower_deviation_nm", row.lower_deviation_nm);
  field("size_over_nm", row.size_over_nm);
  field("size_up_to_nm", row.size_up_to_nm);
  field("basis", row.basis);
  field("table_revision", row.table_revision);
  field("measured_nm", row.measured_nm);
  field("verdict", row.verdict);
  field("rule", row.rule);
  field("uncertainty_nm", row.uncertainty_nm);
  field("coverage_factor", row.coverage_factor);
  field("part_id", row.part_id);
  field("characteristic", row.characteristic);
  field("work_order", row.order);
  field("operation", row.operation);
  field("machine", row.machine);
  field("operator", row.operator_id);
  field("gauge", row.gauge);
  field("temperature", row.temperature);
  field("unit", row.unit);
  field("comment", row.comment);
  field("caller", row.caller);
  field("run_id", row.run_id);
  field("cycle", row.cycle);
  field("correction_of", row.correction_of);
  field("correction_reason", row.correction_reason);
  field("subgroup", row.subgroup);
  field("probability", row.probability);
  field("conformance", row.conformance);
  field("guard_band", row.guard_band);
  field("corrected_nm", row.corrected_nm);
  field("scale_temperature", row.scale_temperature);
  field("part_expansion", row.part_expansion);
  field("scale_expansion", row.scale_expansion);
  field("part_material", row.part_material);
  field("scale_material", row.scale_material);
  field("origin", row.origin);
  field("seq", row.seq);
  field("number", row.number);
  field("corrected_origin", row.corrected_origin);
  field("corrected_number", row.corrected_number);
  field("uncertainty_budget", row.uncertainty_budget);
  field("calibration_due", row.calibration_due);
  field("temperature_uncertainty", row.temperature_uncertainty);
  field("scale_temperature_uncertainty", row.scale_temperature_uncertainty);
  field("part_expansion_uncertainty", row.part_expansion_uncertainty);
  field("scale_expansion_uncertainty", row.scale_expansion_uncertainty);
  field("added_uncertainty", row.added_uncertainty);
}

/// `id, source, …, hash`
inline std::string measurement_columns() {
  std::string columns = "id";
  const MeasurementRow row;
  for_each_field(row, [&](std::string_view column, const auto&) {
    columns += ", ";
    columns += column;
  });
  return columns + ", hash";
}

}  // namespace fitgauge::store
