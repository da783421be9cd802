#pragma once

#include "tables/standards/designated_limits.hpp"

namespace fitgauge::standards {

inline constexpr std::string_view kGeneralTolerance = "ISO 2768";

/// ISO 2768-1 as limits_of() says. An outside dimension, unless the caller knows better.
Result<DesignatedLimits> general_tolerance(std::string_view designation);
Result<DesignatedLimits> general_tolerance(Length nominal, std::string_view tolerance_class);

}  // namespace fitgauge::standards
