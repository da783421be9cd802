#pragma once

#include <string_view>

namespace fitgauge::iso286 {

/// The files of tables/data, byte for byte. Sizes are in mm, deviations and tolerances in µm.
extern const std::string_view kItGradesCsv;
extern const std::string_view kHoleFundamentalDeviationsCsv;
extern const std::string_view kShaftFundamentalDeviationsCsv;

}  // namespace fitgauge::iso286
