#include "tables/iso286/limit_deviations.hpp"

#include "tables/iso286/tolerance_tables.hpp"

namespace fitgauge::iso286 {

std::optional<LimitDeviations> deviations_in_range(const ToleranceTables& tables, ClassId id,
                                                   const NominalSizeRange& range) {
  const NominalSize end = NominalSize::make(range.up_to).value();
  const auto deviations = tables.limit_deviations(end, id);
  if (!deviations || tables.basis(id) == Basis::Iso286) return deviations;
  const bool whole_range = tables.limits_of_size(end, id)->size_range.contains(range);
  return whole_range ? deviations : std::nullopt;
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
