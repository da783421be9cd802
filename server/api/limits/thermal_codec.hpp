#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "base/result.hpp"
#include "gauging/reference_temperature.hpp"

namespace fitgauge::api {

/// Temperatures and expansions as they are written, in the query as in a body: in millionths.
struct ThermalWords {
  std::optional<std::int64_t> temperature{};
  std::optional<std::int64_t> scale_temperature{};
  std::optional<std::int64_t> part_expansion{};
  std::optional<std::int64_t> scale_expansion{};
  std::optional<std::string_view> part_material{};
  std::optional<std::string_view> scale_material{};
};

/// What a reading is corrected to 20 °C with.
struct ThermalCorrection {
  gauging::ThermalBody part;
  gauging::ThermalBody scale;

  Length operator()(Length reading) const {
    return gauging::size_at_20_degrees(reading, part, scale);
  }
};

/// None where no expansion is given: a temperature alone corrects nothing.
/// @errors with the field in `where`: FieldConflict: material beside expansion; FieldInvalid: there
///   is no such material; FieldMissing: the part's expansion without temperature_c.
Result<std::optional<ThermalCorrection>> make_correction(const ThermalWords& words);

}  // namespace fitgauge::api
