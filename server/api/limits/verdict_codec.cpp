#include "api/limits/verdict_codec.hpp"

#include <cmath>

namespace fitgauge::api {

Result<void> check_measured(Length measured) {
  if (measured > Length() && measured <= kLargestMeasured) return {};
  return Error{ErrorCode::LengthOutOfRange, "a measured value is above 0 and at most " +
                                                format_mm(kLargestMeasured) + " mm, not " +
                                                format_mm(measured)};
}

Result<gauging::DecisionRule> make_rule(const RuleWords& words) {
  using Kind = gauging::DecisionRule::Kind;
  gauging::CoverageFactor factor;
  if (words.coverage_millionths) {
    const auto given = gauging::CoverageFactor::from_millionths(*words.coverage_millionths);
    if (!given) return given.error();
    factor = *given;
  }
  gauging::ConformanceProbability probability;
  if (words.probability_millionths) {
    const auto given =
        gauging::ConformanceProbability::from_millionths(*words.probability_millionths);
    if (!given) return given.error();
    probability = *given;
  }
  if (words.kind == Kind::Simple) return gauging::DecisionRule();
  if (!words.standard_uncertainty) {
    return Error{ErrorCode::RuleInvalid, "rule " + std::string(word(words.kind)) +
                                             " needs uncertainty_um, the standard uncertainty"};
  }
  return words.kind == Kind::GuardBand
             ? gauging::DecisionRule::guard_band(*words.standard_uncertainty, factor)
             : gauging::DecisionRule::conformance(*words.standard_uncertainty, probability);
}

Result<void> check_acceptance(const gauging::DecisionRule& rule,
                              const gauging::ConformanceLimits& limits) {
  if (rule.kind() != gauging::DecisionRule::Kind::Conformance ||
      gauging::guard_band_factor(limits.upper - limits.lower, rule.standard_uncertainty(),
                                 rule.probability().value())) {
    return {};
  }
  return Error{ErrorCode::RuleNoAcceptance,
               "no value conforms with a probability of " + format(rule.probability()) +
                   ": the uncertainty of " + format_um(rule.standard_uncertainty()) +
                   " um is too large for the tolerance of " +
                   format_um(limits.upper - limits.lower) + " um"};
}

void write_verdict_members(JsonWriter& json, Length nominal_size, const MeasuredSize& measured,
                           const gauging::GaugingResult& result) {
  json.member_mm("measured_mm", measured.reading);
  if (measured.corrected) json.member_mm("corrected_mm", *measured.corrected);
  json.member_um("deviation_um", measured.decisive() - nominal_size)
      .member("verdict", word(result.verdict))
      .member_um("excess_um", result.excess);
}

void write_rule_members(JsonWriter& json, const gauging::DecisionRule& rule,
                        const gauging::ConformanceLimits& limits, Length measured) {
  using Kind = gauging::DecisionRule::Kind;
  if (rule.kind() == Kind::Simple) return;
  const Length u = rule.standard_uncertainty();
  json.member("rule", word(rule.kind())).member_um("uncertainty_um", u);
  if (rule.kind() == Kind::GuardBand) {
    json.key("coverage_factor").raw(format(rule.coverage_factor()));
    return;
  }
  const double probability = rule.probability().value();
  const auto factor = gauging::guard_band_factor(limits.upper - limits.lower, u, probability);
  constexpr double kNanometres = 1000;  // of a micrometre
  constexpr int kDigits = 9;
  json.key("probability").raw(format(rule.probability()));
  json.key("conformance_probability")
      .fixed(gauging::conformance_probability(limits, measured, u), kDigits);
  json.key("guard_band_um")
      .fixed(factor.value_or(NAN) * static_cast<double>(u.count()) / kNanometres, kDigits);
}

}  // namespace fitgauge::api
