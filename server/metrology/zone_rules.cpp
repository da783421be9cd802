#include "metrology/zone_rules.hpp"

#include <algorithm>
#include <bit>

namespace fitgauge::metrology {
namespace {

constexpr int kRun = 8;

}  // namespace

std::array<bool, ZoneRules::kCount> ZoneHistory::add(Point point, ZoneRules rules) {
  std::array<bool, ZoneRules::kCount> completed{};
  for (const int sign : {1, -1}) {
    Side& side = sides_[sign > 0 ? 0 : 1];
    const int zone = sign * point.zone;
    const bool beyond_2 = zone >= 2;
    const bool beyond_1 = zone >= 1;
    const bool on_side = point.side == sign;
    if (zone >= 3) completed[0] = true;
    if (beyond_2 && side.beyond_2 != 0) completed[1] = true;
    if (beyond_1 && std::popcount(side.beyond_1) >= 3) completed[2] = true;
    if (on_side && side.run + 1 >= kRun) completed[3] = true;
    side.beyond_2 =
        static_cast<std::uint8_t>((unsigned{side.beyond_2} << 1U | unsigned{beyond_2}) & 0b11U);
    side.beyond_1 =
        static_cast<std::uint8_t>((unsigned{side.beyond_1} << 1U | unsigned{beyond_1}) & 0b1111U);
    side.run = static_cast<std::uint8_t>(on_side ? std::min(side.run + 1, kRun - 1) : 0);
  }
  for (int rule = 1; rule <= ZoneRules::kCount; ++rule) {
    completed[static_cast<std::size_t>(rule - 1)] &= rules.has(rule);
  }
  return completed;
}

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
    const auto completed =
        history.add({zone, int{x > lines.centre} - int{x < lines.centre}}, rules);
    for (int rule = 1; rule <= ZoneRules::kCount; ++rule) {
      if (completed[static_cast<std::size_t>(rule - 1)]) violations.push_back({rule, i});
    }
  }
  return violations;
}

}  // namespace fitgauge::metrology
