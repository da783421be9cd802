#pragma once

#include <array>
#include <cstddef>
#include <string_view>

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
    MeasuredAt,
    Uncertainty,
    Coverage,
    Rule,
    Temperature,
    Count,
  };

  std::string_view name;
  std::size_t longest = 0;  ///< of a text, in bytes
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
    {"part_id", kLongestIdentifier},
    {"characteristic", kLongestIdentifier},
    {"order", kLongestIdentifier},
    {"operation", kLongestIdentifier},
    {"machine", kLongestIdentifier},
    {"operator", kLongestIdentifier},
    {"gauge", kLongestIdentifier},
    {"unit", kLongestIdentifier},
    {"comment", kLongestComment},
    {"measured_at", 64},
    {"uncertainty_um"},
    {"coverage_factor"},
    {"rule", 16},
    {"temperature_c"},
}};

}  // namespace fitgauge::api
