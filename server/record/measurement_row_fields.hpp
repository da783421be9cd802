#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

#include "record/measurement.hpp"

namespace fitgauge::api {

/// A field of a measurement, by whichever format it comes in.
struct RowField {
  enum Index : std::size_t {
    Measured,
    Nominal,
    Class,
    Designation,
    Feature,
    Upper,
    Lower,
    PartId,
    Characteristic,
    Order,
    Operation,
    Machine,
    Operator,
    Gauge,
    Unit,
    Comment,
    Subgroup,
    MeasuredAt,
    Uncertainty,
    Coverage,
    Rule,
    Probability,
    Temperature,
    ScaleTemperature,
    PartExpansion,
    ScaleExpansion,
    PartMaterial,
    ScaleMaterial,
    TemperatureUncertainty,
    ScaleTemperatureUncertainty,
    PartUncertainty,
    ScaleUncertainty,
    Count,
  };

  enum class Kind : std::uint8_t { Length, Decimal, Text, Time, Feature, Rule };

  std::string_view name;
  Kind kind;
  std::size_t longest;  ///< of a text, in bytes
  std::string_view meaning;
  /// The text that is kept as it is; null where the reader makes something of it.
  std::optional<std::string_view> app::MeasurementTexts::*text = nullptr;
};

inline constexpr std::size_t kLongestIdentifier = 200;
inline constexpr std::size_t kLongestComment = 2000;

/// By RowField::Index: what the readers take and what /openapi.json says of it.
inline constexpr std::array<RowField, RowField::Count> kRowFields = {{
    {"measured_mm", RowField::Kind::Length, 0,
     "Measured value, above 0 to 100000000; rounded to 1 nm"},
    {"nominal_mm", RowField::Kind::Length, 0, "Nominal size"},
    {"tolerance_class", RowField::Kind::Text, 64, "H7, g6 or a column of the shop's own"},
    {"designation", RowField::Kind::Text, 64,
     "25 H7, M10-6H or 25 ISO 2768-m; a comma may mark decimals"},
    {"feature", RowField::Kind::Feature, 16, "Of a drawing's own limits"},
    {"upper_um", RowField::Kind::Length, 0, "Upper deviation of a drawing's own limits"},
    {"lower_um", RowField::Kind::Length, 0, "Lower deviation of a drawing's own limits"},
    {"part_id", RowField::Kind::Text, kLongestIdentifier, "The part: a serial number",
     &app::MeasurementTexts::part_id},
    {"characteristic", RowField::Kind::Text, kLongestIdentifier, "What was measured at the part",
     &app::MeasurementTexts::characteristic},
    {"order", RowField::Kind::Text, kLongestIdentifier, "Work order",
     &app::MeasurementTexts::order},
    {"operation", RowField::Kind::Text, kLongestIdentifier, "Step of the routing",
     &app::MeasurementTexts::operation},
    {"machine", RowField::Kind::Text, kLongestIdentifier, "Where it was made",
     &app::MeasurementTexts::machine},
    {"operator", RowField::Kind::Text, kLongestIdentifier, "Who measured",
     &app::MeasurementTexts::operator_id},
    {"gauge", RowField::Kind::Text, kLongestIdentifier, "What it was measured with",
     &app::MeasurementTexts::gauge},
    {"unit", RowField::Kind::Text, kLongestIdentifier, "Line, cell or plant",
     &app::MeasurementTexts::unit},
    {"comment", RowField::Kind::Text, kLongestComment, "Anything else",
     &app::MeasurementTexts::comment},
    {"subgroup", RowField::Kind::Text, kLongestIdentifier, "Parts that were made together",
     &app::MeasurementTexts::subgroup},
    {"measured_at", RowField::Kind::Time, 64,
     "With an offset or Z, kept in UTC; when it was received, if absent"},
    {"uncertainty_um", RowField::Kind::Length, 0, "Standard uncertainty u, from 0"},
    {"coverage_factor", RowField::Kind::Decimal, 0, "k, above 0 to 100; 2 when absent"},
    {"rule", RowField::Kind::Rule, 16, "Decision rule; simple when absent"},
    {"probability", RowField::Kind::Decimal, 0,
     "Of conformance, from 0.5 to below 1; 0.95 when absent"},
    {"temperature_c", RowField::Kind::Decimal, 0,
     "Of the part, -273.15 to 10000; corrects with an expansion"},
    {"scale_temperature_c", RowField::Kind::Decimal, 0, "Of what it was read on; else 20"},
    {"part_expansion_um_per_m_k", RowField::Kind::Decimal, 0, "Of the part, 0 to 1000"},
    {"scale_expansion_um_per_m_k", RowField::Kind::Decimal, 0, "Of what it was read on"},
    {"part_material", RowField::Kind::Text, 64, "Instead of part_expansion_um_per_m_k: steel"},
    {"scale_material", RowField::Kind::Text, 64, "Instead of scale_expansion_um_per_m_k"},
    {"temperature_uncertainty_c", RowField::Kind::Decimal, 0,
     "Standard uncertainty of temperature_c, from 0: its part is added to uncertainty_um"},
    {"scale_temperature_uncertainty_c", RowField::Kind::Decimal, 0, "Of scale_temperature_c"},
    {"part_expansion_uncertainty_um_per_m_k", RowField::Kind::Decimal, 0,
     "Of the part's expansion; that of its material's source when absent"},
    {"scale_expansion_uncertainty_um_per_m_k", RowField::Kind::Decimal, 0,
     "Of the scale's expansion"},
}};

}  // namespace fitgauge::api
