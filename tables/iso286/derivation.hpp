#pragma once

#include <optional>
#include <span>
#include <vector>

#include "tables/iso286/indexed_table.hpp"
#include "tables/iso286/limit_deviations.hpp"
#include "tables/iso286/tolerance_class.hpp"

namespace fitgauge::iso286 {

/// The ranges within which every class is defined for all sizes or for none: the steps of the
/// fundamental deviations, the first one parted at 1 mm.
std::vector<NominalSizeRange> derivation_ranges(const StandardTables& tables);

/// The standard tolerance of a grade, or nothing where the grade is not used.
std::optional<Length> standard_tolerance(const StandardTables& tables, StandardToleranceGrade grade,
                                         const NominalSizeRange& range);

/// The limit deviations of a class for each of `ranges`, by the rules of ISO 286-1; nothing where
/// the standard does not define the class.
std::vector<std::optional<LimitDeviations>> derive(const StandardTables& tables,
                                                   const ToleranceClass& tolerance_class,
                                                   std::span<const NominalSizeRange> ranges);

}  // namespace fitgauge::iso286
