#include "tables/iso286/limit_deviations.hpp"

#include "tables/iso286/tolerance_tables.hpp"

namespace fitgauge::iso286 {

std::optional<LimitDeviations> deviations_in_range(const ToleranceTables& tables, ClassId id,
                                                   const NominalSizeRange& range) {
  NominalSize size = NominalSize::make(range.up_to).value();
  const auto deviations = tables.limit_deviations(size, id);
  if (!deviations || tables.basis(id) == Basis::Iso286) return deviations;
  for (;;) {
    const Length over = tables.limits_of_size(size, id)->size_range.over;
    if (over <= range.over) return deviations;
    size = NominalSize::make(over).value();
    if (tables.limit_deviations(size, id) != deviations) return std::nullopt;
  }
}

std::string_view word(FitKind kind) {
  switch (kind) {
    case FitKind::Clearance: return "clearance";
    case FitKind::Transition: return "transition";
    case FitKind::Interference: break;
  }
  return "interference";
}

FitKind Fit::kind() const {
  if (min_clearance() >= Length()) return FitKind::Clearance;
  if (max_clearance() <= Length()) return FitKind::Interference;
  return FitKind::Transition;
}

}  // namespace fitgauge::iso286
