#include "metrology/gauging/decision_rule.hpp"

#include <array>
#include <cstddef>

#include "base/decimal.hpp"

namespace fitgauge::gauging {
namespace {

constexpr int kFactorScale = 6;

constexpr std::array kRuleWords = {std::string_view("simple"), std::string_view("guard_band"),
                                   std::string_view("conformance")};

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

}  // namespace fitgauge::gauging
