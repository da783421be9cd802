#pragma once

#include "tables/iso286/tolerance_tables.hpp"
#include "tables/standards/standard.hpp"

namespace fitgauge::metrology {

/// The only published scheme: the tables of ISO 1938-1:2015 and 2026 are not public.
inline constexpr std::string_view kLimitGaugeScheme = "ISO/R 1938:1971";

/// Sizes of the gauges for one tolerance: a plug for a hole, a ring or snap gauge for a shaft.
struct LimitGauge {
  iso286::LimitDeviations go;  ///< upper and lower size of a new GO gauge, as lengths
  Length go_wear_limit;        ///< wear limit of a GO gauge
  iso286::LimitDeviations no_go;
};

/// The numbers of the scheme by size, as tables/data/standards describes them: `inset_7`, `wear_7`
/// and `safety_7` are deviations of gauges for IT7.
const standards::Table& limit_gauge_table();

/// @errors SizeOutOfRange over 500 mm; ClassUndefinedForSize for a grade without values (holes
///   IT6 to IT16, shafts IT5 to IT16), a custom tolerance class, and the one size step whose value
///   the sources disagree about (IT5 shafts, over 250 up to 315 mm).
Result<LimitGauge> limit_gauge(const iso286::LimitsOfSize& limits, std::string_view class_name);

}  // namespace fitgauge::metrology
