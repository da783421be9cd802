#pragma once

#include "base/allowance.hpp"
#include "nc/machine/tolerance.hpp"

namespace fitgauge::machine {

/// Step for a ball of `radius` in mm: an edge is rounded with at least this radius, so a dip within
/// one step is shallower than kSamePoint.
inline double least_step(double radius) {
  constexpr double kSmallest = 0.1;
  return std::sqrt(8 * std::max(radius, kSmallest) * tolerance::kSamePoint);
}

/// Returns the first zero of `value` on [0, longest], to a value of kContact.
/// @pre `value` changes no faster than its argument, a distance along a path: then a step of the
/// length of the value never passes a zero. Next to a wall or at a slant such steps become short.
/// They are lengthened to `step_at_least`, so the search may miss a narrower dip below zero.
/// @param allowance ends a search of too many steps, as along a wall. The result is then not
/// valid.
template <class Value>
std::optional<double> first_zero(const Value& value, double longest, double step_at_least,
                                 Allowance& allowance) {
  double low = 0;
  double at_low = value(low);
  if (at_low <= tolerance::kContact) return low;
  bool is_slow = false;
  for (unsigned steps = 1; low < longest; ++steps) {
    constexpr unsigned kBetweenLooks = 16;
    if (steps % kBetweenLooks == 0 && allowance.is_spent()) return std::nullopt;
    const double step = is_slow ? std::max(at_low, step_at_least) : at_low;
    double high = std::min(low + step, longest);
    double at_high = value(high);
    if (at_high > tolerance::kContact) {
      is_slow = at_high > at_low / 2;
      low = high;
      at_low = at_high;
      continue;
    }
    // Regula falsi with halved ends (Illinois): the zero is within one least step.
    constexpr int kSteps = 100;
    for (int round = 0; round < kSteps && at_high < -tolerance::kContact; ++round) {
      const double next = high - at_high * (high - low) / (at_high - at_low);
      const double at_next = value(next);
      if (std::abs(at_next) <= tolerance::kContact) return next;
      if (at_next > 0) {
        low = next;
        at_low = at_next;
        at_high /= 2;
      } else {
        high = next;
        at_high = at_next;
        at_low /= 2;
      }
      if (high - low < tolerance::kRounding) break;
    }
    return high;
  }
  return std::nullopt;
}

}  // namespace fitgauge::machine
