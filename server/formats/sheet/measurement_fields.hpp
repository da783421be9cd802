#pragma once

#include <algorithm>
#include <array>
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
