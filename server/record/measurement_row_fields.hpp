#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "record/fields.hpp"

namespace fitgauge::api {

/// A field of a measurement in a request, whichever format it comes in.
struct RowField {
  enum Index : std::size_t {
    Measured,
    Nominal,
    Class,
    Designation,
    Feature,
    Upper,
    Lower,
    Quantity,
    Labels,
    MeasuredAt = Labels + app::kLabels.size(),
    Uncertainty,
    Coverage,
    Rule,
    Probability,
    Thermal,
    DegreesOfFreedom = Thermal + app::kThermalFields.size(),
    Kept,  ///< decides nothing, as the labels, or only of a record
    Count = Thermal + app::kGivenFields.size() - app::kLabels.size(),
  };

  enum class Kind : std::uint8_t { Length, Decimal, Text, Time, Feature, Quantity, Rule, Truth };

  std::string_view name{};
  Kind kind = Kind::Text;
  std::size_t longest = 0;  ///< of a text, in bytes
  std::string_view meaning{};
  const app::MeasurementField* plain = nullptr;  ///< kept as it is; else the reader uses it
};

/// By RowField::Index: the fields that the readers accept and /openapi.json describes.
inline constexpr std::array<RowField, RowField::Count> kRowFields = [] {
  std::array<RowField, RowField::Count> fields = {{
      {"measured_mm", RowField::Kind::Length, 0,
       "Measured value, above 0 to 100000000; a position, distance or deviation from -100000000; "
       "rounded to 1 nm"},
      {"nominal_mm", RowField::Kind::Length, 0, "Nominal size"},
      {"tolerance_class", RowField::Kind::Text, 64, "H7, g6 or a custom tolerance class"},
      {"designation", RowField::Kind::Text, 64,
       "25 H7, 25 H7(E), M10-6H or 25 ISO 2768-m; a comma may mark decimals"},
      {"feature", RowField::Kind::Feature, 16,
       "Feature; required with explicit limits of a diameter, width or pitch diameter"},
      {"upper_um", RowField::Kind::Length, 0, "Upper deviation of explicit limits"},
      {"lower_um", RowField::Kind::Length, 0, "Lower deviation of explicit limits"},
      {"quantity", RowField::Kind::Quantity, 16,
       "Quantity; from the designation, else diameter. With it the limits are optional"},
  }};
  fields[RowField::MeasuredAt] = {
      "measured_at", RowField::Kind::Time, 64,
      "Time with an offset or Z, stored in UTC; time of receipt when absent"};
  fields[RowField::Uncertainty] = {"uncertainty_um", RowField::Kind::Length, 0,
                                   "Standard uncertainty u, from 0"};
  fields[RowField::Coverage] = {
      "coverage_factor", RowField::Kind::Decimal, 0,
      "k, above 0 to 100; t(0.9545, degrees_of_freedom) when absent, 2 without them"};
  fields[RowField::Rule] = {"rule", RowField::Kind::Rule, 16, "Decision rule; simple when absent"};
  fields[RowField::Probability] = {
      "probability", RowField::Kind::Decimal, 0,
      "Probability of conformance, from 0.5 to below 1; 0.95 when absent"};
  std::size_t at = RowField::Labels;
  for (const app::MeasurementField& field : app::kGivenFields) {
    if (at == RowField::MeasuredAt) at = RowField::Thermal;
    using Kind = RowField::Kind;
    const Kind of_number = field.accepted.is_truth ? Kind::Truth : Kind::Decimal;
    fields.at(at++) = {field.name, field.text != nullptr ? Kind::Text : of_number,
                       field.accepted.longest, field.meaning, &field};
  }
  return fields;
}();
static_assert(kRowFields[RowField::DegreesOfFreedom].name == "degrees_of_freedom");

}  // namespace fitgauge::api
