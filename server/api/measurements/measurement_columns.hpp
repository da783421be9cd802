#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "metrology/gauging/gauge.hpp"
#include "record/measurement.hpp"

namespace fitgauge::api {

/// The names of the columns of a table of measurements, in order.
std::vector<std::string> measurement_columns();

/// Tells a table the cells of a measurement, in the order of measurement_columns(): `table.word`,
/// `chosen` (a text that somebody chose), `time`, `mm`, `um`, `decimal` (a value and its scale),
/// and `none` for a cell without a value.
template <class Table>
void write_columns(const app::Measurement& m, Table& table) {
  const auto chosen = [&table](const std::optional<std::string_view>& text) {
    if (text) {
      table.chosen(*text);
    } else {
      table.none();
    }
  };
  const auto word = [&table](std::string_view text) { table.word(text); };
  const auto decimal = [&table](const std::optional<std::int64_t>& value, int scale) {
    if (value) {
      table.decimal(*value, scale);
    } else {
      table.none();
    }
  };
  constexpr int kMillionths = 6;
  constexpr int kBillionths = 9;
  word(app::measurement_id_text(m.id, m.origin));
  word(app::word(m.source));
  table.time(m.measured_at);
  table.time(m.received_at);
  table.mm(m.nominal_size);
  word(m.class_name.value_or(""));
  word(iso286::word(m.feature));
  m.has_upper_limit() ? table.um(m.deviations.upper) : table.none();
  m.has_lower_limit() ? table.um(m.deviations.lower) : table.none();
  m.has_upper_limit() ? table.mm(m.upper_limit()) : table.none();
  m.has_lower_limit() ? table.mm(m.lower_limit()) : table.none();
  word(app::word(m.basis));
  word(m.table_revision);
  table.mm(m.measured);
  table.um(m.decisive() - m.nominal_size);
  word(gauging::word(m.result.verdict));
  table.um(m.result.excess);
  word(gauging::word(m.rule.kind()));
  m.standard_uncertainty ? table.um(*m.standard_uncertainty) : table.none();
  decimal(m.coverage_factor ? std::optional(m.coverage_factor->millionths()) : std::nullopt,
          kMillionths);
  decimal(m.temperature, app::kTemperatureDecimals);
  for (const auto& [name, field] : app::kMeasurementTexts) chosen(m.texts.*field);
  chosen(m.caller);
  word(m.run_id ? app::run_id_text(*m.run_id, m.origin) : "");
  decimal(m.cycle, 0);
  word(m.correction_of ? corrected_id_text(m) : "");
  chosen(m.correction_reason);
  const auto& figures = m.conformance;
  decimal(figures ? std::optional(m.rule.probability().millionths()) : std::nullopt, kMillionths);
  decimal(figures ? std::optional(figures->probability) : std::nullopt, kBillionths);
  decimal(figures ? std::optional(figures->guard_band) : std::nullopt, kBillionths);
  m.corrected ? table.mm(*m.corrected) : table.none();
  decimal(m.expansions.scale_temperature, app::kTemperatureDecimals);
  decimal(m.expansions.part, app::kTemperatureDecimals);
  decimal(m.expansions.scale, app::kTemperatureDecimals);
  chosen(m.expansions.part_material);
  chosen(m.expansions.scale_material);
  chosen(m.uncertainty_budget);
  word(m.calibration_due.value_or(""));
  word(m.calibration_due ? "true" : "");
  decimal(m.expansions.temperature_uncertainty, app::kTemperatureDecimals);
  decimal(m.expansions.scale_temperature_uncertainty, app::kTemperatureDecimals);
  decimal(m.expansions.part_uncertainty, app::kTemperatureDecimals);
  decimal(m.expansions.scale_uncertainty, app::kTemperatureDecimals);
  decimal(m.added_uncertainty, app::kPicometreDecimals);
}

}  // namespace fitgauge::api
