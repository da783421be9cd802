#include "metrology/statistics/zone_rules.hpp"

#include <bit>

namespace fitgauge::metrology {

void ZoneHistory::reduce(ZoneRules rules) {
  unsigned reduced = 0;
  for (const unsigned shift : {0U, kSide}) {
    const unsigned side = past_ >> shift;
    unsigned beyond_1 = side >> kBeyond1 & 0b1111U;
    // A point is the oldest of a pattern of four in five only if the newer ones that are beyond and
    // the points still to come inside its five are three.
    for (int age = 4; age >= 1; --age) {
      const unsigned bit = 1U << static_cast<unsigned>(age - 1);
      const int newer = std::popcount(beyond_1 & (bit - 1U));
      if (newer + 5 - age < 3) beyond_1 &= ~bit;
    }
    const unsigned seen = side >> kRun & 0x7FU;
    const unsigned run = (1U << static_cast<unsigned>(std::countr_one(seen))) - 1U;
    unsigned kept = 0;
    if (rules.has(2)) kept |= side & 0b11U << kBeyond2;
    if (rules.has(3)) kept |= beyond_1 << kBeyond1;
    if (rules.has(4)) kept |= run << kRun;
    reduced |= kept << shift;
  }
  past_ = reduced;
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
