#include "metrology/gauging/gauge.hpp"

#include <doctest/doctest.h>

using namespace fitgauge;
using namespace fitgauge::gauging;
using iso286::Feature;

namespace {

Length mm(const char* text) { return *parse_length_mm(text); }
Length um(const char* text) { return *parse_length_um(text); }

/// 25 H7 is 25.000 to 25.021; 25 g6 is 24.980 to 24.993.
GaugingResult hole(const char* measured, const DecisionRule& rule = {}) {
  return gauge(Feature::Hole, mm("25.021"), mm("25"), mm(measured), rule);
}

GaugingResult shaft(const char* measured, const DecisionRule& rule = {}) {
  return gauge(Feature::Shaft, mm("24.993"), mm("24.98"), mm(measured), rule);
}

}  // namespace

TEST_CASE("limits are inclusive and one nanometre outside is not good") {
  CHECK(hole("25.013") == GaugingResult{Verdict::Good, Length()});
  CHECK(hole("25.021").verdict == Verdict::Good);
  CHECK(hole("25").verdict == Verdict::Good);
  CHECK(hole("25.021001") == GaugingResult{Verdict::Reject, um("0.001")});
  CHECK(hole("24.999999") == GaugingResult{Verdict::Rework, um("-0.001")});
  CHECK(shaft("24.993001") == GaugingResult{Verdict::Rework, um("0.001")});
  CHECK(shaft("24.979999") == GaugingResult{Verdict::Reject, um("-0.001")});
}

TEST_CASE("a guard band is good inside, indeterminate up to g outside, and bad beyond") {
  const DecisionRule rule = *DecisionRule::guard_band(um("0.8"));
  CHECK(hole("25.0016", rule).verdict == Verdict::Good);
  CHECK(hole("25.001599", rule).verdict == Verdict::Indeterminate);
  CHECK(hole("25.0194", rule).verdict == Verdict::Good);
  CHECK(hole("25.019401", rule) == GaugingResult{Verdict::Indeterminate, Length()});
  CHECK(hole("25.0226", rule) == GaugingResult{Verdict::Indeterminate, um("1.6")});
  CHECK(hole("25.022601", rule) == GaugingResult{Verdict::Reject, um("1.601")});
  CHECK(hole("24.9984", rule).verdict == Verdict::Indeterminate);
  CHECK(hole("24.998399", rule).verdict == Verdict::Rework);
  CHECK(shaft("24.994601", rule).verdict == Verdict::Rework);
  CHECK(shaft("24.978399", rule).verdict == Verdict::Reject);
}

TEST_CASE("a guard band wider than half the tolerance leaves nothing good") {
  const DecisionRule rule = *DecisionRule::guard_band(um("6"));
  for (int nm = 0; nm <= 21'000; nm += 500) {
    const Length measured = mm("25") + Length::nanometres(nm);
    CHECK(gauge(Feature::Hole, mm("25.021"), mm("25"), measured, rule).verdict ==
          Verdict::Indeterminate);
  }
}

TEST_CASE("the guard band is compared exactly between nanometres") {
  // g = 0.001 µm x 1.5 = 1.5 nm: 1 nm inside the limit is too near, 2 nm is not.
  const DecisionRule rule =
      *DecisionRule::guard_band(um("0.001"), *CoverageFactor::from_millionths(1'500'000));
  CHECK(hole("25.000001", rule).verdict == Verdict::Indeterminate);
  CHECK(hole("25.000002", rule).verdict == Verdict::Good);
  CHECK(hole("24.999999", rule).verdict == Verdict::Indeterminate);
  CHECK(hole("24.999998", rule).verdict == Verdict::Rework);
}

TEST_CASE("the largest lengths and factors do not overflow") {
  const DecisionRule rule =
      *DecisionRule::guard_band(kLongest, *CoverageFactor::from_millionths(1'000'000'000'000));
  CHECK(gauge(Feature::Hole, kLongest, -kLongest, Length(), rule).verdict ==
        Verdict::Indeterminate);
  CHECK(gauge(Feature::Shaft, -kLongest, -kLongest, kLongest).excess == kLongest * 2);
}

TEST_CASE("coverage factors and uncertainties that make no sense are refused") {
  for (const std::int64_t millionths : {0, -2'000'000}) {
    CHECK(CoverageFactor::from_millionths(millionths).error().code == ErrorCode::RuleInvalid);
  }
  CHECK(format(*CoverageFactor::from_millionths(1'960'000)) == "1.96");
  CHECK(CoverageFactor() == *CoverageFactor::from_millionths(2'000'000));
  CHECK(DecisionRule::guard_band(um("-0.1")).error().code == ErrorCode::RuleInvalid);
}

TEST_CASE("the words of verdicts and rules read back") {
  for (const auto verdict :
       {Verdict::Good, Verdict::Rework, Verdict::Reject, Verdict::Indeterminate}) {
    CHECK(verdict_from_word(word(verdict)) == verdict);
  }
  CHECK(word(Verdict::Good) == "good");
  CHECK_FALSE(verdict_from_word("Good"));
  CHECK(rule_from_word("guard_band") == DecisionRule::Kind::GuardBand);
  CHECK(rule_from_word(word(DecisionRule::Kind::Simple)) == DecisionRule::Kind::Simple);
  CHECK_FALSE(rule_from_word(""));
}

TEST_CASE("conformance is good, indeterminate or bad by the probability of the true value") {
  // 25 H7 with u = 2 um, one limit far away: g = 1.6448536 * 2 um (JCGM 106, table 1).
  const DecisionRule rule = *DecisionRule::conformance(um("2"));
  CHECK(hole("25.00329", rule).verdict == Verdict::Good);
  CHECK(hole("25.003289", rule).verdict == Verdict::Indeterminate);
  CHECK(hole("25.01771", rule).verdict == Verdict::Good);
  CHECK(hole("25.017711", rule).verdict == Verdict::Indeterminate);
  CHECK(hole("24.996711", rule).verdict == Verdict::Indeterminate);
  CHECK(hole("24.99671", rule).verdict == Verdict::Rework);
  CHECK(hole("25.02429", rule).verdict == Verdict::Reject);
  CHECK(hole("25.024289", rule) == GaugingResult{Verdict::Indeterminate, um("3.289")});
  CHECK(shaft("24.9968", rule).verdict == Verdict::Rework);

  const Limits limits{mm("25.021"), mm("25")};
  CHECK(*guard_band_factor(um("21"), um("2"), 0.95) == doctest::Approx(1.6448536).epsilon(1e-7));
  CHECK(conformance_probability(limits, mm("25"), um("2")) == doctest::Approx(0.5));
  // Both limits two standard uncertainties away.
  CHECK(conformance_probability(limits, mm("25.0105"), um("5.25")) ==
        doctest::Approx(0.9544997361));
}

TEST_CASE("an uncertainty that is not well known itself widens the guard band and the tails") {
  // t(0.9545, v), by mpmath at 30 digits.
  CHECK(coverage_millionths(2) == 4'526'551);
  CHECK(coverage_millionths(10) == 2'283'682);
  CHECK(coverage_millionths(1e6) == 2'000'005);
  CHECK(coverage_millionths(0.01) == 1'000'000'000'000);
  const Limits limits{mm("25.021"), mm("25")};
  const KnownUncertainty few(um("1"), 2);
  CHECK(conformance_probability(limits, mm("25.0189"), few) ==
        doctest::Approx(0.9133311790544391).epsilon(1e-12));
  const DecisionRule rule = *DecisionRule::conformance(few);
  CHECK(hole("25.0189", rule).verdict == Verdict::Indeterminate);
  CHECK(hole("25.0189", *DecisionRule::conformance(um("1"))).verdict == Verdict::Good);
  // Where the guard band ends, the probability is just the one asked for.
  const double factor = *guard_band_factor(um("21"), few, 0.95);
  CHECK(factor == doctest::Approx(2.9734607729).epsilon(1e-9));
}

TEST_CASE("a quantity says what becomes of a part beyond its limits") {
  const auto words = [](Quantity quantity, Feature feature) {
    const Beyond beyond(quantity, feature);
    return std::pair(beyond.below, beyond.above);
  };
  constexpr std::pair kWidened{Verdict::Rework, Verdict::Reject};
  constexpr std::pair kTurned{Verdict::Reject, Verdict::Rework};
  constexpr std::pair kLost{Verdict::Reject, Verdict::Reject};
  for (const Quantity size : {Quantity::Diameter, Quantity::Width, Quantity::PitchDiameter}) {
    CHECK(words(size, Feature::Hole) == kWidened);
    CHECK(words(size, Feature::Shaft) == kTurned);
  }
  for (const Quantity edge : {Quantity::Radius, Quantity::Chamfer}) {
    CHECK(words(edge, Feature::Shaft) == kWidened);
  }
  for (const Quantity place : {Quantity::Position, Quantity::Distance, Quantity::Deviation}) {
    CHECK(words(place, Feature::Hole) == kLost);
    CHECK(is_signed(place));
  }
  for (const std::string_view text : kQuantityWords) CHECK(word(*quantity_from_word(text)) == text);
  CHECK_FALSE(quantity_from_word("angle"));
}

TEST_CASE("a guard band that leaves nothing is told from one that leaves a point") {
  const DecisionRule rule = *DecisionRule::guard_band(um("5.25"));
  CHECK_FALSE(has_no_acceptance(rule, um("21")));
  CHECK(has_no_acceptance(rule, um("20.999")));
  CHECK_FALSE(has_no_acceptance({}, um("0")));
}

TEST_CASE("an uncertainty too large for the tolerance leaves no value good") {
  CHECK(guard_band_factor(um("21"), um("5.3"), 0.95));
  CHECK_FALSE(guard_band_factor(um("21"), um("5.4"), 0.95));  // 10.5 / 1.96 = 5.357
  CHECK(DecisionRule::conformance(Length()).error().code == ErrorCode::RuleInvalid);
  for (const std::int64_t millionths : {0, 499'999, 1'000'000}) {
    CHECK(ConformanceProbability::from_millionths(millionths).error().code ==
          ErrorCode::RuleInvalid);
  }
  CHECK(*guard_band_factor(um("21"), um("2"), 0.5) == doctest::Approx(0).epsilon(1e-6));
}
