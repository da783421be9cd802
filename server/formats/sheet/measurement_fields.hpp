#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <string_view>

#include "record/measurement_row_fields.hpp"

namespace fitgauge::sheet {

/// Names of the fields that a row of /v1/measurements may have, in the order of its description.
inline constexpr auto kMeasurementFields = [] {
  std::array<std::string_view, api::RowField::Count> names{};
  std::ranges::transform(api::kRowFields, names.begin(), &api::RowField::name);
  return names;
}();

}  // namespace fitgauge::sheet

namespace fitgauge::aqdef {

// Where the fields of a measurement stand in a row.

inline constexpr auto& kNames = sheet::kMeasurementFields;

constexpr std::size_t place_of(std::string_view name) {
  return static_cast<std::size_t>(std::find(kNames.begin(), kNames.end(), name) - kNames.begin());
}

inline constexpr std::size_t kMeasured = place_of("measured_mm");
inline constexpr std::size_t kNominal = place_of("nominal_mm");
inline constexpr std::size_t kClass = place_of("tolerance_class");
inline constexpr std::size_t kFeature = place_of("feature");
inline constexpr std::size_t kQuantity = place_of("quantity");
inline constexpr std::size_t kUpper = place_of("upper_um");
inline constexpr std::size_t kLower = place_of("lower_um");
inline constexpr std::size_t kPartId = place_of("part_id");
inline constexpr std::size_t kName = place_of("characteristic");
inline constexpr std::size_t kOrder = place_of("order");
inline constexpr std::size_t kOperation = place_of("operation");
inline constexpr std::size_t kMachine = place_of("machine");
inline constexpr std::size_t kOperator = place_of("operator");
inline constexpr std::size_t kGauge = place_of("gauge");
inline constexpr std::size_t kUnit = place_of("unit");
inline constexpr std::size_t kComment = place_of("comment");
inline constexpr std::size_t kSubgroup = place_of("subgroup");
inline constexpr std::size_t kMeasuredAt = place_of("measured_at");
static_assert(kMeasuredAt < kNames.size() && kPartId < kSubgroup);

}  // namespace fitgauge::aqdef
