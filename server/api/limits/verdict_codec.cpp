#include "api/limits/verdict_codec.hpp"

namespace fitgauge::api {

Result<void> check_measured(Length measured) {
  if (measured > Length() && measured <= kLargestMeasured) return {};
  return Error{ErrorCode::LengthOutOfRange, "a measured value is above 0 and at most " +
                                                format_mm(kLargestMeasured) + " mm, not " +
                                                format_mm(measured)};
}

Result<gauging::DecisionRule> make_rule(gauging::DecisionRule::Kind kind,
                                        std::optional<Length> standard_uncertainty,
                                        std::optional<std::int64_t> coverage_millionths) {
  gauging::CoverageFactor factor;
  if (coverage_millionths) {
    const auto given = gauging::CoverageFactor::from_millionths(*coverage_millionths);
    if (!given) return given.error();
    factor = *given;
  }
  if (kind == gauging::DecisionRule::Kind::Simple) return gauging::DecisionRule();
  if (!standard_uncertainty) {
    return Error{ErrorCode::RuleInvalid,
                 "the guard band needs uncertainty_um, the standard uncertainty"};
  }
  return gauging::DecisionRule::guard_band(*standard_uncertainty, factor);
}

void write_verdict_members(JsonWriter& json, Length nominal_size, Length measured,
                           const gauging::GaugingResult& result) {
  json.member_mm("measured_mm", measured)
      .member_um("deviation_um", measured - nominal_size)
      .member("verdict", word(result.verdict))
      .member_um("excess_um", result.excess);
}

void write_rule_members(JsonWriter& json, const gauging::DecisionRule& rule) {
  if (rule.kind() == gauging::DecisionRule::Kind::Simple) return;
  json.member("rule", word(rule.kind()))
      .member_um("uncertainty_um", rule.standard_uncertainty())
      .key("coverage_factor")
      .raw(format(rule.coverage_factor()));
}

}  // namespace fitgauge::api
