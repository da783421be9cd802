#pragma once

#include "tables/standards/designated_limits.hpp"

namespace fitgauge::standards {

/// The limits of the pitch diameter of a metric thread (ISO 965-1), as limits_of() says: the
/// nominal size is D2 = d2 = d - 3 sqrt(3) P / 8 to the micrometre, as ISO 724 has it.
Result<DesignatedLimits> thread_limits(std::string_view designation);

}  // namespace fitgauge::standards
