#include "metrology/gauging/gauge.hpp"

#include <cassert>

#include "metrology/gauging/conformance.hpp"

namespace fitgauge::gauging {
namespace {

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
