#pragma once

#include <array>
#include <string_view>

namespace fitgauge::sheet {

/// The fields a row of /v1/measurements may have, in the order of its description.
inline constexpr std::array<std::string_view, 32> kMeasurementFields = {
    "measured_mm",
    "nominal_mm",
    "tolerance_class",
    "designation",
    "feature",
    "upper_um",
    "lower_um",
    "part_id",
    "characteristic",
    "order",
    "operation",
    "machine",
    "operator",
    "gauge",
    "unit",
    "comment",
    "subgroup",
    "measured_at",
    "uncertainty_um",
    "coverage_factor",
    "rule",
    "probability",
    "temperature_c",
    "scale_temperature_c",
    "part_expansion_um_per_m_k",
    "scale_expansion_um_per_m_k",
    "part_material",
    "scale_material",
    "temperature_uncertainty_c",
    "scale_temperature_uncertainty_c",
    "part_expansion_uncertainty_um_per_m_k",
    "scale_expansion_uncertainty_um_per_m_k",
};

}  // namespace fitgauge::sheet
