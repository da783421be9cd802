#pragma once

#include <compare>
#include <optional>

#include "base/length.hpp"
#include "tables/iso286/nominal_size.hpp"
#include "tables/iso286/tolerance_class.hpp"

namespace fitgauge::iso286 {

/// The limit deviations from the nominal size: ES and EI of a hole, es and ei of a shaft
/// (ISO 286-1, 3.2.6).
struct LimitDeviations {
  Length upper;
  Length lower;

  friend constexpr auto operator<=>(const LimitDeviations&, const LimitDeviations&) = default;
};

class ToleranceTables;

/// What the tables say for every size of one of their ranges: of a class of the standard, the
/// deviations at its end; of a custom column, those of the row that holds the whole range.
std::optional<LimitDeviations> deviations_in_range(const ToleranceTables& tables, ClassId id,
                                                   const NominalSizeRange& range);

}  // namespace fitgauge::iso286
