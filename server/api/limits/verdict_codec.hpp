#pragma once

#include <cstdint>
#include <optional>

#include "api/wire/json_writer.hpp"
#include "base/result.hpp"
#include "gauging/gauge.hpp"

namespace fitgauge::api {

/// The largest measured value, in mm: 100 m.
inline constexpr Length kLargestMeasured = Length::millimetres(100'000'000);

/// @errors LengthOutOfRange unless 0 < measured <= kLargestMeasured.
Result<void> check_measured(Length measured);

/// Makes the rule from its words, in the query as in a body.
/// @errors RuleInvalid when a guard band has no uncertainty.
Result<gauging::DecisionRule> make_rule(gauging::DecisionRule::Kind kind,
                                        std::optional<Length> standard_uncertainty,
                                        std::optional<std::int64_t> coverage_millionths);

/// Writes measured_mm, deviation_um, verdict and excess_um.
void write_verdict_members(JsonWriter& json, Length nominal_size, Length measured,
                           const gauging::GaugingResult& result);

/// Writes rule, uncertainty_um and coverage_factor of a guard band; nothing for the simple rule.
void write_rule_members(JsonWriter& json, const gauging::DecisionRule& rule);

}  // namespace fitgauge::api
