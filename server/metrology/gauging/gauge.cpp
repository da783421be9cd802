#include "metrology/gauging/gauge.hpp"

#include <cassert>

namespace fitgauge::gauging {
namespace {

constexpr std::string_view kWords[kVerdicts] = {"good", "rework", "reject", "indeterminate",
                                                "unjudged"};

constexpr int kFactorScale = 6;

constexpr std::string_view kRuleWords[] = {"simple", "guard_band", "conformance"};

/// A guard band k·u in millionths of a nanometre needs more than 64 bits.
__extension__ using Wide = __int128;

/// Lengths and guard band in millionths of a nanometre.
Verdict verdict(const Beyond& beyond, Wide upper, Wide lower, Wide measured, Wide guard) {
  if (measured >= lower + guard && measured <= upper - guard) return Verdict::Good;
  if (measured > upper + guard) return beyond.above;
  if (measured < lower - guard) return beyond.below;
  return Verdict::Indeterminate;
}

/// By the probability of conformance; outside, the nearer limit decides between rework and reject.
Verdict conformance_verdict(const Beyond& beyond, const ConformanceLimits& limits, Length measured,
                            const DecisionRule& rule) {
  const double wanted = rule.probability().value();
  const KnownUncertainty u = rule.uncertainty();
  if (conformance_probability(limits, measured, u) >= wanted) return Verdict::Good;
  if (nonconformance_probability(limits, measured, u) < wanted) return Verdict::Indeterminate;
  const bool nearer_upper = limits.upper - measured < measured - limits.lower;
  return nearer_upper ? beyond.above : beyond.below;
}

}  // namespace

std::string_view word(Verdict verdict) { return word_of(verdict, kWords); }

std::optional<Verdict> verdict_from_word(std::string_view text) {
  return enum_of<Verdict>(text, kWords);
}

Result<CoverageFactor> CoverageFactor::parse(std::string_view text, bool exponent) {
  const auto millionths = parse_decimal(text, {.scale = kFactorScale, .exponent = exponent});
  if (!millionths) {
    return Error{ErrorCode::RuleInvalid, "coverage factor: " + millionths.error().message};
  }
  return from_millionths(*millionths);
}

Result<CoverageFactor> CoverageFactor::from_millionths(std::int64_t millionths) {
  if (millionths <= 0) {
    return Error{ErrorCode::RuleInvalid, "the coverage factor must be above 0; 2 is usual"};
  }
  return CoverageFactor(millionths);
}

std::string format(CoverageFactor factor) {
  return format_decimal(factor.millionths(), kFactorScale);
}

Result<DecisionRule> DecisionRule::guard_band(Length standard_uncertainty, CoverageFactor factor) {
  if (standard_uncertainty < Length()) {
    return Error{ErrorCode::RuleInvalid, "the standard uncertainty must not be negative"};
  }
  DecisionRule rule;
  rule.kind_ = Kind::GuardBand;
  rule.standard_uncertainty_ = standard_uncertainty;
  rule.coverage_factor_ = factor;
  return rule;
}

Result<ConformanceProbability> ConformanceProbability::from_millionths(std::int64_t millionths) {
  if (millionths < 500'000 || millionths >= 1'000'000) {
    return Error{ErrorCode::RuleInvalid,
                 "the probability of conformance must be at least 0.5 and below 1; 0.95 is usual"};
  }
  return ConformanceProbability(millionths);
}

std::string format(ConformanceProbability probability) {
  return format_decimal(probability.millionths(), kFactorScale);
}

Result<DecisionRule> DecisionRule::conformance(const KnownUncertainty& uncertainty,
                                               ConformanceProbability probability) {
  if (uncertainty.u <= Length()) {
    return Error{ErrorCode::RuleInvalid,
                 "conformance needs a standard uncertainty above 0; without one use rule simple"};
  }
  DecisionRule rule;
  rule.kind_ = Kind::Conformance;
  rule.standard_uncertainty_ = uncertainty.u;
  rule.degrees_of_freedom_ = uncertainty.degrees_of_freedom;
  rule.probability_ = probability;
  return rule;
}

bool has_no_acceptance(const DecisionRule& rule, Length tolerance) {
  return rule.kind() == DecisionRule::Kind::GuardBand &&
         Wide{2} * rule.standard_uncertainty().count() * rule.coverage_factor().millionths() >
             Wide{tolerance.count()} * 1'000'000;
}

std::string_view word(DecisionRule::Kind kind) { return word_of(kind, kRuleWords); }

std::optional<DecisionRule::Kind> rule_from_word(std::string_view text) {
  return enum_of<DecisionRule::Kind>(text, kRuleWords);
}

GaugingResult gauge(const Beyond& beyond, Length upper_limit, Length lower_limit, Length measured,
                    const DecisionRule& rule) {
  assert(lower_limit <= upper_limit);
  GaugingResult result;
  if (measured > upper_limit) result.excess = measured - upper_limit;
  if (measured < lower_limit) result.excess = measured - lower_limit;
  if (rule.kind() == DecisionRule::Kind::Conformance) {
    result.verdict = conformance_verdict(beyond, {upper_limit, lower_limit}, measured, rule);
    return result;
  }
  constexpr Wide kMillion = 1'000'000;
  const bool guarded = rule.kind() == DecisionRule::Kind::GuardBand;
  const Wide guard =
      guarded ? Wide{rule.standard_uncertainty().count()} * rule.coverage_factor().millionths()
              : Wide{0};
  result.verdict = verdict(beyond, upper_limit.count() * kMillion, lower_limit.count() * kMillion,
                           measured.count() * kMillion, guard);
  return result;
}

}  // namespace fitgauge::gauging
