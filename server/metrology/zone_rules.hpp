#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace fitgauge::metrology {

/// The rules of the Western Electric handbook (1956) for a control chart, by number:
/// 1: a point beyond 3 standard deviations; 2: two of three beyond 2 on one side; 3: four of five
/// beyond 1 on one side; 4: eight in a row on one side. A point on a line is not beyond it.
class ZoneRules {
 public:
  static constexpr int kCount = 4;

  constexpr ZoneRules() = default;
  static constexpr ZoneRules all() { return ZoneRules(0b1111); }
  static constexpr ZoneRules only_first() { return ZoneRules(1); }
  /// Each of the four.
  static constexpr ZoneRules of(bool first, bool second, bool third, bool fourth) {
    return ZoneRules(static_cast<std::uint8_t>(unsigned{first} | unsigned{second} << 1U |
                                               unsigned{third} << 2U | unsigned{fourth} << 3U));
  }

  /// @pre 1 <= rule <= kCount, here and below
  constexpr void add(int rule) { bits_ = static_cast<std::uint8_t>(bits_ | (1U << (rule - 1))); }
  constexpr bool has(int rule) const { return ((bits_ >> (rule - 1)) & 1U) != 0; }
  constexpr bool empty() const { return bits_ == 0; }

  friend constexpr ZoneRules operator&(ZoneRules a, ZoneRules b) {
    return ZoneRules(static_cast<std::uint8_t>(a.bits_ & b.bits_));
  }

 private:
  explicit constexpr ZoneRules(std::uint8_t bits) : bits_(bits) {}

  std::uint8_t bits_ = 0;
};

/// What of the past of a chart decides about its next point; it never starts anew after a signal.
class ZoneHistory {
 public:
  /// How many whole standard deviations a point is beyond, at most 3, with its sign: 0 for a point
  /// between ±1, whose side `side` still tells (-1, 0 on the centre line, 1).
  struct Point {
    int zone = 0;
    int side = 0;
  };

  /// Takes the next point. @returns the rules whose pattern it completes, itself beyond the zone.
  ZoneRules add(Point point) {
    std::array<bool, ZoneRules::kCount> completed{};
    for (const int sign : {1, -1}) {
      Side& side = sides_[sign > 0 ? 0 : 1];
      const int zone = sign * point.zone;
      const bool on_side = point.side == sign;
      completed[0] |= zone >= 3;
      completed[1] |= zone >= 2 && side.beyond_2 != 0;
      completed[2] |= zone >= 1 && (kThreeOfFour >> side.beyond_1 & 1U) != 0;
      completed[3] |= on_side && side.run == kRun - 1;
      side.beyond_2 =
          static_cast<std::uint8_t>((unsigned{side.beyond_2} << 1U | (zone >= 2)) & 0b11U);
      side.beyond_1 =
          static_cast<std::uint8_t>((unsigned{side.beyond_1} << 1U | (zone >= 1)) & 0b1111U);
      side.run = static_cast<std::uint8_t>(on_side ? std::min(side.run + 1, kRun - 1) : 0);
    }
    return ZoneRules::of(completed[0], completed[1], completed[2], completed[3]);
  }

  /// Forgets what no later pattern of `rules` can need; histories that then are equal have one
  /// future.
  void reduce(ZoneRules rules);

  friend constexpr auto operator<=>(const ZoneHistory&, const ZoneHistory&) = default;

 private:
  static constexpr int kRun = 8;
  static constexpr unsigned kThreeOfFour = 0b1110'1000'1000'0000;  ///< the masks of three and four

  struct Side {
    std::uint8_t beyond_2 = 0;  ///< of the last two points, the newest in bit 0
    std::uint8_t beyond_1 = 0;  ///< of the last four
    std::uint8_t run = 0;       ///< points in a row on this side, at most 7

    friend constexpr auto operator<=>(const Side&, const Side&) = default;
  };
  std::array<Side, 2> sides_{};  ///< above, below
};

struct RuleViolation {
  int rule = 0;
  std::size_t index = 0;  ///< of the point that completes the pattern, from 0
};

/// The lines of a location chart, rounded as its points are: a point on a line is not beyond it.
struct ZoneLines {
  double centre = 0;
  std::array<double, 3> above{};  ///< 1, 2 and 3 standard deviations of a point from the centre
  std::array<double, 3> below{};
};

/// The violations of a whole chart, by point, then rule.
std::vector<RuleViolation> find_violations(std::span<const double> points, const ZoneLines& lines,
                                           ZoneRules rules);

}  // namespace fitgauge::metrology
