#pragma once

#include <cstdint>
#include <string_view>

#include "tables/iso286/limits_of_size.hpp"

namespace fitgauge::iso286 {

/// ISO 286-1, 3.3.
enum class FitKind : std::uint8_t { Clearance, Transition, Interference };

/// `clearance`, `transition` or `interference`.
std::string_view word(FitKind kind);

/// A hole and a shaft of one nominal size. Interference is negative clearance.
struct Fit {
  LimitsOfSize hole;
  LimitsOfSize shaft;

  Length max_clearance() const { return hole.deviations.upper - shaft.deviations.lower; }
  Length min_clearance() const { return hole.deviations.lower - shaft.deviations.upper; }

  /// EI - es = 0 is a clearance fit (3.3.4), ES - ei = 0 an interference fit (3.3.5).
  FitKind kind() const;
};

}  // namespace fitgauge::iso286
