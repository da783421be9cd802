#include "record/verdict_codec.hpp"

#include <array>

#include "base/json/applicable.hpp"

namespace fitgauge::api {
namespace {

/// A coverage factor stands in a record of the simple rule too, as the uncertainty does.
constexpr std::array<Applicable, 2> kRuleMembers = {{
    {"coverage_factor", "simple guard_band"},
    {"probability", "conformance"},
}};

}  // namespace

Result<void> check_measured(Length measured) {
  if (measured > Length() && measured <= kLargestMeasured) return {};
  return Error{ErrorCode::LengthOutOfRange, "a measured value is above 0 and at most " +
                                                format_mm(kLargestMeasured) + " mm, not " +
                                                format_mm(measured)};
}

Result<void> check_uncertainty(Length uncertainty) {
  if (uncertainty >= Length()) return {};
  return Error{ErrorCode::LengthOutOfRange, "an uncertainty is not negative", "uncertainty_um"};
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
  std::optional<Error> unused;
  refuse_not_applicable(
      kRuleMembers, "rule", word(words.kind),
      [&](const Applicable& row) {
        return row.member == "probability" ? words.probability_millionths.has_value()
                                           : words.coverage_millionths.has_value();
      },
      [&](std::string_view member, std::string message) {
        unused = Error{ErrorCode::RuleInvalid, std::move(message), std::string(member)};
      });
  if (unused) return *std::move(unused);
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
  if (measured.added_uncertainty) {
    json.key("added_uncertainty_um").decimal(*measured.added_uncertainty, 6);
  }
  json.member_um("deviation_um", measured.decisive() - nominal_size)
      .member("verdict", word(result.verdict))
      .member_um("excess_um", result.excess);
}

void write_rule_members(JsonWriter& json, const gauging::DecisionRule& rule,
                        std::optional<Length> given, const gauging::ConformanceLimits& limits,
                        Length measured) {
  using Kind = gauging::DecisionRule::Kind;
  if (rule.kind() == Kind::Simple) return;
  const Length u = rule.standard_uncertainty();
  json.member("rule", word(rule.kind())).member_um("uncertainty_um", given.value_or(u));
  if (rule.kind() == Kind::GuardBand) {
    json.key("coverage_factor").raw(format(rule.coverage_factor()));
    return;
  }
  json.key("probability").raw(format(rule.probability()));
  const auto figures =
      gauging::conformance_figures(limits, measured, u, rule.probability().value());
  if (!figures) return;  // check_acceptance has refused it
  json.key("conformance_probability").decimal(figures->probability, 9);
  json.key("guard_band_um").decimal(figures->guard_band, 9);
}

}  // namespace fitgauge::api
