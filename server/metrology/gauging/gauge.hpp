#pragma once

#include "base/length.hpp"
#include "metrology/gauging/decision_rule.hpp"
#include "metrology/gauging/verdict.hpp"
#include "tables/iso286/feature.hpp"

namespace fitgauge::gauging {

struct GaugingResult {
  Verdict verdict = Verdict::Good;
  /// measured - upper limit when above (positive), measured - lower limit when below (negative),
  /// 0 inside; the rule does not change it.
  Length excess;

  friend bool operator==(const GaugingResult&, const GaugingResult&) = default;
};

/// Judges a measured size. Limits are inclusive: a part exactly on a limit is good. With a guard
/// band g = k·u it is good from lower + g to upper - g inclusive, rework or reject beyond lower - g
/// or upper + g, and indeterminate between; all compared exactly. By conformance it is good where
/// the probability of conformance reaches the rule's, rework or reject where that of nonconformance
/// does, and indeterminate between.
/// @pre lower_limit <= upper_limit, and no length is beyond ±kLongest
GaugingResult gauge(iso286::Feature feature, Length upper_limit, Length lower_limit,
                    Length measured, const DecisionRule& rule = {});

}  // namespace fitgauge::gauging
