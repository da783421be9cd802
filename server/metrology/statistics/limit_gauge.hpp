#pragma once

#include <string_view>

#include "base/result.hpp"
#include "tables/iso286/tolerance_tables.hpp"

namespace fitgauge::metrology {

/// The only published scheme: the tables of ISO 1938-1:2015 and 2026 are not public.
inline constexpr std::string_view kLimitGaugeScheme = "ISO/R 1938:1971";

/// Sizes of the gauges for one tolerance: a plug for a hole, a ring or snap gauge for a shaft.
struct LimitGauge {
  iso286::LimitDeviations go;  ///< upper and lower size of a new GO gauge, as lengths
  Length go_wear_limit;        ///< a GO gauge beyond this size is taken out of use
  iso286::LimitDeviations no_go;
};

/// @errors SizeOutOfRange over 500 mm; ClassUndefinedForSize for a grade without values (holes
///   IT6 to IT16, shafts IT5 to IT16), a class of the shop's own, and the one size step whose value
///   the sources disagree about (IT5 shafts, over 250 up to 315 mm).
Result<LimitGauge> limit_gauge(const iso286::LimitsOfSize& limits, std::string_view class_name);

}  // namespace fitgauge::metrology
