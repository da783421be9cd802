#include "metrology/gauging/gauge.hpp"

#include <array>
#include <cassert>
#include <cstddef>

#include "base/decimal.hpp"
#include "metrology/gauging/conformance.hpp"

namespace fitgauge::gauging {
namespace {

constexpr int kFactorScale = 6;

constexpr std::array kRuleWords = {std::string_view("simple"), std::string_view("guard_band"),
                                   std::string_view("conformance")};

using iso286::Feature;

/// A guard band k·u in millionths of a nanometre needs more than 64 bits.
__extension__ using Wide = __int128;

constexpr Verdict above(Feature feature) {
  return feature == Feature::Hole ? Verdict::Reject : Verdict::Rework;
}

constexpr Verdict below(Feature feature) {
  return feature == Feature::Hole ? Verdict::Rework : Verdict::Reject;
}

/// Lengths and guard band in millionths of a nanometre.
Verdict verdict(Feature feature, Wide upper, Wide lower, Wide measured, Wide guard) {
  if (measured >= lower + guard && measured <= upper - guard) return Verdict::Good;
  if (measured > upper + guard) return above(feature);
  if (measured < lower - guard) return below(feature);
  return Verdict::Indeterminate;
}

/// By the probability of conformance; outside, the nearer limit tells rework from reject.
Verdict conformance_verdict(Feature feature, const ConformanceLimits& limits, Length measured,
                            const DecisionRule& rule) {
  const double wanted = rule.probability().value();
  const Length u = rule.standard_uncertainty();
  if (conformance_probability(limits, measured, u) >= wanted) return Verdict::Good;
  if (nonconformance_probability(limits, measured, u) < wanted) return Verdict::Indeterminate;
  const bool nearer_upper = limits.upper - measured < measured - limits.lower;
  return nearer_upper ? above(feature) : below(feature);
}

}  // namespace

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
                 "the probability of conformance is at least 0.5 and below 1; 0.95 is usual"};
  }
  return ConformanceProbability(millionths);
}

std::string format(ConformanceProbability probability) {
  return format_decimal(probability.millionths(), kFactorScale);
}

Result<DecisionRule> DecisionRule::conformance(Length standard_uncertainty,
                                               ConformanceProbability probability) {
  if (standard_uncertainty <= Length()) {
    return Error{ErrorCode::RuleInvalid,
                 "conformance needs a standard uncertainty above 0; without one use rule simple"};
  }
  DecisionRule rule;
  rule.kind_ = Kind::Conformance;
  rule.standard_uncertainty_ = standard_uncertainty;
  rule.probability_ = probability;
  return rule;
}

std::string_view word(DecisionRule::Kind kind) {
  return kRuleWords[static_cast<std::size_t>(kind)];
}

std::optional<DecisionRule::Kind> rule_from_word(std::string_view text) {
  for (std::size_t i = 0; i < kRuleWords.size(); ++i) {
    if (kRuleWords[i] == text) return static_cast<DecisionRule::Kind>(i);
  }
  return std::nullopt;
}

GaugingResult gauge(Feature feature, Length upper_limit, Length lower_limit, Length measured,
                    const DecisionRule& rule) {
  assert(lower_limit <= upper_limit);
  constexpr Wide kMillion = 1'000'000;
  const bool guarded = rule.kind() == DecisionRule::Kind::GuardBand;
  const Wide guard =
      guarded ? Wide{rule.standard_uncertainty().count()} * rule.coverage_factor().millionths()
              : Wide{0};
  GaugingResult result;
  if (measured > upper_limit) result.excess = measured - upper_limit;
  if (measured < lower_limit) result.excess = measured - lower_limit;
  if (rule.kind() == DecisionRule::Kind::Conformance) {
    result.verdict = conformance_verdict(feature, {upper_limit, lower_limit}, measured, rule);
    return result;
  }
  result.verdict = verdict(feature, upper_limit.count() * kMillion, lower_limit.count() * kMillion,
                           measured.count() * kMillion, guard);
  return result;
}

}  // namespace fitgauge::gauging
