#include "metrology/zone_rules.hpp"

#include <algorithm>
#include <bit>

namespace fitgauge::metrology {
void ZoneHistory::reduce(ZoneRules rules) {
  for (Side& side : sides_) {
    if (!rules.has(2)) side.beyond_2 = 0;
    if (!rules.has(4)) side.run = 0;
    if (!rules.has(3)) side.beyond_1 = 0;
    // A point is the oldest of a pattern of four in five only if the newer ones that are beyond and
    // the points still to come inside its five are three.
    for (int age = 4; age >= 1; --age) {
      const auto bit = static_cast<std::uint8_t>(1U << static_cast<unsigned>(age - 1));
      const int newer = std::popcount(static_cast<std::uint8_t>(side.beyond_1 & (bit - 1U)));
      if (newer + 5 - age < 3) side.beyond_1 = static_cast<std::uint8_t>(side.beyond_1 & ~bit);
    }
  }
}

std::vector<RuleViolation> find_violations(std::span<const double> points, const ZoneLines& lines,
                                           ZoneRules rules) {
  std::vector<RuleViolation> violations;
  if (rules.empty()) return violations;
  ZoneHistory history;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double x = points[i];
    int zone = 0;
    for (std::size_t k = 0; k < lines.above.size(); ++k) {
      zone += int{x > lines.above[k]} - int{x < lines.below[k]};
    }
    const ZoneRules completed =
        history.add({zone, int{x > lines.centre} - int{x < lines.centre}}) & rules;
    if (completed.empty()) continue;
    for (int rule = 1; rule <= ZoneRules::kCount; ++rule) {
      if (completed.has(rule)) violations.push_back({rule, i});
    }
  }
  return violations;
}

}  // namespace fitgauge::metrology
