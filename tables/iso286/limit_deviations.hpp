#pragma once

#include <compare>

#include "base/length.hpp"

namespace fitgauge::iso286 {

/// The limit deviations from the nominal size: ES and EI of a hole, es and ei of a shaft
/// (ISO 286-1, 3.2.6).
struct LimitDeviations {
  Length upper;
  Length lower;

  friend constexpr auto operator<=>(const LimitDeviations&, const LimitDeviations&) = default;
};

}  // namespace fitgauge::iso286
