#pragma once

#include <optional>

#include "tables/iso286/limit_deviations.hpp"
#include "tables/iso286/nominal_size.hpp"
#include "tables/iso286/tolerance_class.hpp"

namespace fitgauge::iso286 {

class ToleranceTables;

/// What the tables say for every size of one of their ranges: of a class of the standard, the
/// deviations at its end; of a custom column, those of the row that holds the whole range.
std::optional<LimitDeviations> deviations_in_range(const ToleranceTables& tables, ClassId id,
                                                   const NominalSizeRange& range);

}  // namespace fitgauge::iso286
