#include "gauging/decision_rule.hpp"

#include "base/decimal.hpp"

namespace fitgauge::gauging {
namespace {

constexpr int kFactorScale = 6;

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

std::string_view word(DecisionRule::Kind kind) {
  return kind == DecisionRule::Kind::Simple ? "simple" : "guard_band";
}

std::optional<DecisionRule::Kind> rule_from_word(std::string_view text) {
  for (const auto kind : {DecisionRule::Kind::Simple, DecisionRule::Kind::GuardBand}) {
    if (word(kind) == text) return kind;
  }
  return std::nullopt;
}

}  // namespace fitgauge::gauging
