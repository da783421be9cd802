#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string_view>

#include "app/measurements/measurement.hpp"

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
    Temperature,
    Count,
  };

  std::string_view name;
  std::size_t longest = 0;  ///< of a text, in bytes
  /// The text that is kept as it is; null where the reader makes something of it.
  std::optional<std::string_view> app::MeasurementTexts::*text = nullptr;
};

inline constexpr std::size_t kLongestIdentifier = 200;
inline constexpr std::size_t kLongestComment = 2000;

/// By RowField::Index.
inline constexpr std::array<RowField, RowField::Count> kRowFields = {{
    {"measured_mm"},
    {"nominal_mm"},
    {"tolerance_class", 64},
    {"designation", 64},
    {"feature", 16},
    {"upper_um"},
    {"lower_um"},
    {"part_id", kLongestIdentifier, &app::MeasurementTexts::part_id},
    {"characteristic", kLongestIdentifier, &app::MeasurementTexts::characteristic},
    {"order", kLongestIdentifier, &app::MeasurementTexts::order},
    {"operation", kLongestIdentifier, &app::MeasurementTexts::operation},
    {"machine", kLongestIdentifier, &app::MeasurementTexts::machine},
    {"operator", kLongestIdentifier, &app::MeasurementTexts::operator_id},
    {"gauge", kLongestIdentifier, &app::MeasurementTexts::gauge},
    {"unit", kLongestIdentifier, &app::MeasurementTexts::unit},
    {"comment", kLongestComment, &app::MeasurementTexts::comment},
    {"subgroup", kLongestIdentifier, &app::MeasurementTexts::subgroup},
    {"measured_at", 64},
    {"uncertainty_um"},
    {"coverage_factor"},
    {"rule", 16},
    {"temperature_c"},
}};

}  // namespace fitgauge::api
