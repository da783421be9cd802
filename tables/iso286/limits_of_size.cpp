#include "tables/iso286/limits_of_size.hpp"

namespace fitgauge::iso286 {

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
