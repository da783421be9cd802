#include "nc/probing/measuring_record.hpp"

#include <algorithm>

namespace fitgauge::probing {

using gauging::Verdict;

gauging::DecisionRule MeasuredSize::rule() const {
  return uncertainty ? gauging::DecisionRule::guard_band(*uncertainty).value()
                     : gauging::DecisionRule();
}

void judge_by_uncertainty(MeasuringRecord& record) {
  if (!record.form || !record.form->touch_uncertainty_um) return;
  const auto uncertainty =
      gauging::rounded_up(record.form->diameter_factor * *record.form->touch_uncertainty_um);
  for (MeasuredSize& size : record.sizes) {
    const gauging::Quantity quantity = quantity_of(record.cycle, size.is_position);
    if (!size.limits || quantity != gauging::Quantity::Diameter) continue;
    size.uncertainty = uncertainty;
    size.verdict = gauging::gauge(size.feature, size.limits->upper, size.limits->lower,
                                  size.measured, size.rule())
                       .verdict;
  }
  for (const Verdict verdict :
       {Verdict::Good, Verdict::Indeterminate, Verdict::Rework, Verdict::Reject}) {
    const bool is_there =
        std::ranges::find(record.sizes, verdict, &MeasuredSize::verdict) != record.sizes.end();
    if (is_there) record.verdict = verdict;
  }
}

}  // namespace fitgauge::probing
