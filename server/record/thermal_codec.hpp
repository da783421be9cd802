#pragma once

#include <cstdint>
#include <optional>

#include "base/result.hpp"
#include "metrology/gauging/reference_temperature.hpp"
#include "record/fields.hpp"

namespace fitgauge::api {

/// What a reading is corrected to 20 °C with.
struct ThermalCorrection {
  gauging::ThermalBody part;
  gauging::ThermalBody scale;
  bool has_uncertainties = false;  ///< some were given

  Length operator()(Length reading) const {
    return gauging::size_at_20_degrees(reading, part, scale);
  }
  /// Of a corrected size, in pm; none where no uncertainty was given.
  std::optional<std::int64_t> added_uncertainty(Length corrected) const {
    if (!has_uncertainties) return std::nullopt;
    return gauging::added_uncertainty(corrected, part, scale);
  }
};

/// None where no expansion is given: a temperature alone corrects nothing.
/// @errors with the field in `where`: FieldConflict: material beside expansion; FieldInvalid: there
///   is no such material; FieldMissing: the part's expansion without temperature_c, or an
///   uncertainty of a body without its expansion.
Result<std::optional<ThermalCorrection>> make_correction(const app::MeasurementFields& fields);

}  // namespace fitgauge::api
