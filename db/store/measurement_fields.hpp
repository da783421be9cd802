#pragma once

#include <string>
#include <string_view>

#include "db/store/measurement_row.hpp"

namespace fitgauge::store {

/// Calls `field(column, value)` for what a measurement says, all but its id and hash. The one place
/// where rows and columns meet.
template <class Row, class Field>
constexpr void for_each_field(Row&& row, Field&& field) {
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
  field("run_id", row.run_id);
  field("correction_of", row.correction_of);
  field("probability", row.probability);
  field("conformance", row.conformance);
  field("guard_band", row.guard_band);
  field("corrected_nm", row.corrected_nm);
  field("origin", row.origin);
  field("seq", row.seq);
  field("number", row.number);
  field("corrected_origin", row.corrected_origin);
  field("corrected_number", row.corrected_number);
  field("quantity", row.quantity);
  field("form_nm", row.form);
  app::for_each_plain(
      [&](const app::MeasurementField& plain, auto member) { field(plain.column, row.*member); });
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
