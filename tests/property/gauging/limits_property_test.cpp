// Random sizes and classes: what holds for every part on, inside and outside its limits.
// FITGAUGE_SEED repeats a run.

#include <doctest/doctest.h>

#include <random>

#include "metrology/gauging/gauge.hpp"
#include "tables/iso286/tolerance_tables.hpp"

using namespace fitgauge;
using namespace fitgauge::iso286;
using namespace fitgauge::gauging;

namespace {

constexpr Length kOneNanometre = Length::nanometres(1);

std::uint64_t seed() {
  const char* given = std::getenv("FITGAUGE_SEED");
  const std::uint64_t value =
      given != nullptr ? std::strtoull(given, nullptr, 10) : std::random_device()();
  MESSAGE("FITGAUGE_SEED=", value);
  return value;
}

/// Limits of random sizes, in steps of 0.001 mm, and random classes that are defined for them.
class RandomLimits {
 public:
  LimitsOfSize next() {
    while (true) {
      const auto micrometres = static_cast<std::int64_t>(random_() % 3'150'000 + 1);
      const auto listed = tables_.classes(random_() % 2 == 0 ? Feature::Hole : Feature::Shaft);
      const ClassId id = listed[random_() % listed.size()];
      const auto size = NominalSize::make(Length::micrometres(micrometres)).value();
      if (!tables_.limit_deviations(size, id)) continue;
      return tables_.limits_of_size(size, id).value();
    }
  }

  Length up_to(Length most) {
    return Length::nanometres(
        static_cast<std::int64_t>(random_() % static_cast<std::uint64_t>(most.count() + 1)));
  }

 private:
  ToleranceTables tables_ = ToleranceTables::make(compiled_in_tables(), {}).value();
  std::mt19937_64 random_{seed()};
};

GaugingResult judge(const LimitsOfSize& limits, Length measured, const DecisionRule& rule = {}) {
  return gauge(limits.feature, limits.upper_limit(), limits.lower_limit(), measured, rule);
}

/// Of a growing measured value: 0 below, 1 near the lower limit, 2 good, 3 near the upper, 4 above.
int zone(const LimitsOfSize& limits, Length measured, Verdict verdict) {
  if (verdict == Verdict::Good) return 2;
  const bool high = measured - limits.lower_limit() > limits.upper_limit() - measured;
  if (verdict == Verdict::Indeterminate) return high ? 3 : 1;
  const bool above = (verdict == Verdict::Reject) == (limits.feature == Feature::Hole);
  return above ? 4 : 0;
}

}  // namespace

TEST_CASE("a part on a limit is good and one nanometre outside is rework or reject") {
  RandomLimits random;
  for (int i = 0; i < 100'000; ++i) {
    const LimitsOfSize limits = random.next();
    const bool hole = limits.feature == Feature::Hole;
    const Length inside = limits.lower_limit() + random.up_to(limits.tolerance());
    REQUIRE(limits.tolerance() > Length());
    REQUIRE(limits.lower_limit() > Length());
    REQUIRE(judge(limits, limits.upper_limit()) == GaugingResult{Verdict::Good, Length()});
    REQUIRE(judge(limits, limits.lower_limit()) == GaugingResult{Verdict::Good, Length()});
    REQUIRE(judge(limits, inside) == GaugingResult{Verdict::Good, Length()});
    REQUIRE(judge(limits, limits.upper_limit() + kOneNanometre) ==
            GaugingResult{hole ? Verdict::Reject : Verdict::Rework, kOneNanometre});
    REQUIRE(judge(limits, limits.lower_limit() - kOneNanometre) ==
            GaugingResult{hole ? Verdict::Rework : Verdict::Reject, -kOneNanometre});
  }
}

TEST_CASE("a growing measured value never goes back to an earlier verdict") {
  RandomLimits random;
  for (int i = 0; i < 2'000; ++i) {
    const LimitsOfSize limits = random.next();
    const Length uncertainty = random.up_to(limits.tolerance());
    for (const DecisionRule& rule :
         {DecisionRule(), DecisionRule::guard_band(uncertainty).value()}) {
      Length measured = limits.lower_limit() - limits.tolerance() * 3;
      int before = 0;
      while (measured < limits.upper_limit() + limits.tolerance() * 3) {
        const int now = zone(limits, measured, judge(limits, measured, rule).verdict);
        REQUIRE(now >= before);
        before = now;
        measured +=
            kOneNanometre + random.up_to(Length::nanometres(limits.tolerance().count() / 4));
      }
      REQUIRE(before == 4);
    }
  }
}

TEST_CASE("a guard band moves both limits by k u, and none at all is the simple rule") {
  RandomLimits random;
  for (int i = 0; i < 20'000; ++i) {
    const LimitsOfSize limits = random.next();
    const Length u = random.up_to(Length::nanometres(limits.tolerance().count() / 4));
    const Length g = u * 2;
    const auto rule = DecisionRule::guard_band(u).value();
    const auto verdict = [&](Length measured) { return judge(limits, measured, rule).verdict; };
    REQUIRE(verdict(limits.lower_limit() + g) == Verdict::Good);
    REQUIRE(verdict(limits.upper_limit() - g) == Verdict::Good);
    const Verdict on_limit = g > Length() ? Verdict::Indeterminate : Verdict::Good;
    REQUIRE(verdict(limits.lower_limit() - g) == on_limit);
    REQUIRE(verdict(limits.upper_limit() + g) == on_limit);
    const auto without = DecisionRule::guard_band(Length()).value();
    const Length measured = limits.lower_limit() - g + random.up_to(limits.tolerance() + g * 2);
    REQUIRE(judge(limits, measured, without) == judge(limits, measured));
    const Length outside = g + kOneNanometre;
    REQUIRE(verdict(limits.upper_limit() + outside) ==
            judge(limits, limits.upper_limit() + outside).verdict);
    REQUIRE(verdict(limits.lower_limit() - outside) ==
            judge(limits, limits.lower_limit() - outside).verdict);
  }
}
